// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_growth_monitor_h
#define nacre_simulation_growth_monitor_h

#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/crack_growth.h>
#include <nacre/simulation/output_options.h>

#include <string>

namespace Nacre
{
  /**
   * What is told and written of the states between which cuts grow: a row of
   * `NAME_growth.csv` with the tips, the lengths of the cuts and all
   * quantities, and a line on the terminal.
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
     * A state, of whose tips @p growth knows. Collective.
     * @param time along a path; in linear analyses the step
     */
    void
    observe(const CrackGrowth &growth,
            const double       time,
            const SolvedShell &shell);

    /** What has been written, for the end of the run. */
    std::string
    summary() const;

  private:
    std::string
    header(const CrackGrowth &growth) const;

    const MPI_Comm              communicator_;
    const std::string           csv_;
    const ShellProblem         &problem_;
    const QuantitiesOfInterest &quantities_;
    Log                        &log_;
    unsigned int                n_rows_  = 0;
    unsigned int                n_steps_ = 0;
  };
} // namespace Nacre

#endif
