// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_growth_monitor_h
#define nacre_simulation_growth_monitor_h

#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/crack_growth.h>
#include <nacre/simulation/output_options.h>

#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * What is told and written of the states between which cuts grow: a row of
   * `NAME_growth.csv` with the tips, the lengths of the cuts and all
   * quantities, and a line on the terminal. Rows before a crack starts have
   * empty fields in its columns.
   */
  class GrowthMonitor
  {
  public:
    /** @param options with the name of the files */
    GrowthMonitor(const MPI_Comm              communicator,
                  const OutputOptions        &options,
                  const ShellProblem         &problem,
                  const QuantitiesOfInterest &quantities,
                  Log                        &log);

    /**
     * Take up the table of the run that @p data was saved by; other quantities
     * begin a new one, as PathMonitor::resume() does.
     */
    void
    resume(const CheckpointData &data, const ProblemRecord &problem);

    /**
     * A state, of whose tips @p growth knows. Collective.
     * @param time along a path; in linear analyses the step
     */
    void
    observe(const CrackGrowth &growth,
            const double       time,
            const SolvedShell &shell);

    /** Of the table. */
    unsigned int
    n_rows() const
    {
      return n_rows_;
    }

    /** What has been written, for the end of the run. */
    std::string
    summary() const;

  private:
    /** Names of columns, and what stands there. */
    using Row = std::vector<std::pair<std::string, double>>;

    Row
    make_row(const CrackGrowth &growth,
             const double       time,
             const SolvedShell &shell) const;

    static void
    add_tip(const GrowingTip &tip, const Growth &growth, Row &row);

    /** Append a @p row, or write all if there are new columns. */
    void
    write_row(const Row &row);

    const MPI_Comm              communicator_;
    const std::string           csv_;
    const ShellProblem         &problem_;
    const QuantitiesOfInterest &quantities_;
    Log                        &log_;
    /** Of the table so far; on rank 0. */
    std::string  header_;
    unsigned int n_rows_  = 0;
    unsigned int n_steps_ = 0;
  };
} // namespace Nacre

#endif
