// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_monitor_h
#define nacre_simulation_path_monitor_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/output_options.h>

#include <deal.II/base/timer.h>

#include <optional>
#include <string>

namespace Nacre
{
  class Log;

  /**
   * What is told and written of each step of a path: a line on the terminal, a
   * row of `NAME_path.csv`, fields, checkpoints.
   */
  class PathMonitor
  {
  public:
    /**
     * @param options with the name of the path's own files
     * @param saves whether the state may be saved: not where the mesh changes
     */
    PathMonitor(const MPI_Comm              communicator,
                const OutputOptions        &options,
                const PathParameters       &path,
                const QuantitiesOfInterest &quantities,
                Checkpoint                 &checkpoint,
                const bool                  saves,
                Log                        &log);

    /** Begin with the parameters @p problem, which checkpoints remember. */
    void
    start(const ProblemRecord &problem);

    /**
     * Take up the files of the run that @p data was saved by. If this run has
     * other quantities, `NAME_path.csv` begins anew, and the rows so far are
     * kept in `NAME_path_until_STEP.csv`.
     */
    void
    resume(const CheckpointData &data, const ProblemRecord &problem);

    /** A step is done; collective. */
    void
    observe(const PathState &state, const SolvedShell &shell);

    /**
     * The run ends, well or not: write the fields and the checkpoint of the
     * last state seen if that hasn't been done. @p shell is that state's.
     */
    void
    finish(const PathState &state, const SolvedShell &shell);

    /** A row of NAME_points.csv and a line for the user. */
    void
    observe_point(const PathPoint &point, const SolvedShell &shell);

    /** What has been written, for the end of the run. */
    std::string
    summary() const;

  private:
    std::string
    csv_header() const;

    void
    write_row(const PathState &state, const std::vector<double> &values);

    void
    print_line(const PathState &state, const std::vector<double> &values);

    void
    write_fields(const PathState &state, const SolvedShell &shell);

    void
    save(const PathState &state);

    const MPI_Comm              communicator_;
    const OutputOptions         options_;
    const PathParameters       &path_;
    const TimeGrid              grid_;
    const QuantitiesOfInterest &quantities_;
    Checkpoint                 &checkpoint_;
    /** 0: never. */
    const unsigned int checkpoint_steps_;
    Log               &log_;
    VtuOutput          vtu_output_;
    CheckpointData     written_;
    bool               has_saved_ = false;
    Timer              timer_;
    /** The step where the timer started. */
    unsigned int start_step_ = 0;
    /** The rows before a restart with other quantities, if there was one. */
    std::string earlier_rows_;
  };
} // namespace Nacre

#endif
