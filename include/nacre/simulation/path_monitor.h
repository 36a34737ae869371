// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_monitor_h
#define nacre_simulation_path_monitor_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/output_options.h>

#include <deal.II/base/timer.h>

#include <functional>
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
    /** Adds what only the run knows to the data of a checkpoint. */
    using Completion = std::function<void(CheckpointData &)>;

    /**
     * @param options with the name of the path's own files
     * @param points_csv the table of the points of all paths
     * @param branch the number of this one; 0: the primary path
     * @param completion of what is saved
     */
    PathMonitor(const MPI_Comm              communicator,
                const OutputOptions        &options,
                const std::string          &points_csv,
                const int                   branch,
                const PathParameters       &path,
                const QuantitiesOfInterest &quantities,
                Checkpoint                 &checkpoint,
                const Completion           &completion,
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

    /**
     * A row in the table of points and a line for the user; the state with its
     * mode as fields, `NAME_pointNUMBER.vtu`, and as a checkpoint of that name.
     * @param mode of the point, ghosted
     */
    void
    observe_point(const PathPoint                     &point,
                  const SolvedShell                   &shell,
                  const TrilinosWrappers::MPI::Vector &mode);

    /** Folder and name of the files of the point @p number, but the ending. */
    static std::string
    point_file(const OutputOptions &options, const unsigned int number);

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

    /** Keep the rows in the table of points up to this path's @p state. */
    void
    resume_points(const PathState &state);

    /** A row of the table of points and the line that says the same. */
    void
    write_point(const PathPoint &point, const SolvedShell &shell);

    /** About how many steps are left, if that is known. */
    std::optional<double>
    n_steps_left(const PathState &state) const;

    void
    write_fields(const PathState &state, const SolvedShell &shell);

    void
    save(const PathState &state, const SolvedShell &shell);

    const MPI_Comm              communicator_;
    const OutputOptions         options_;
    const std::string           points_csv_;
    const int                   branch_;
    const PathParameters       &path_;
    const TimeGrid              grid_;
    const QuantitiesOfInterest &quantities_;
    Checkpoint                 &checkpoint_;
    const Completion            completion_;
    /** 0: never. */
    const unsigned int checkpoint_steps_;
    Log               &log_;
    VtuOutput          vtu_output_;
    VtuOutput          point_output_;
    CheckpointData     written_;
    bool               has_saved_ = false;
    Timer              timer_;
    /** t of the step before. */
    double last_time_ = 0.;
    /** The step where the timer started. */
    unsigned int start_step_ = 0;
    /** The rows before a restart with other quantities, if there was one. */
    std::string earlier_rows_;
  };
} // namespace Nacre

#endif
