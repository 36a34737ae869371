// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_run_h
#define nacre_simulation_path_run_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/checkpoint.h>

#include <optional>

namespace Nacre
{
  class DiscreteShell;

  /**
   * A load path or a motion on one mesh, with files of its own: a row for each
   * step, fields, checkpoints. The study's table holds the last state.
   */
  class PathRun : public Analysis
  {
  public:
    PathRun(const MPI_Comm communicator, const ShellProblem &problem, Log &log);

    std::string
    name() const override
    {
      return "path";
    }

    bool
    can_restart() const override
    {
      return true;
    }

    void
    check(const Recorder &recorder, const bool restart) override;

    void
    run(Recorder &recorder, const bool restart) override;

  private:
    class SolvedState;

    /**
     * The state that a path begins with other than the undeformed shell: that
     * of the @p checkpoint at a restart, or the last one of another run.
     */
    std::optional<CheckpointData>
    load_state(const DiscreteShell &shell,
               const ProblemRecord &record,
               const std::string   &base,
               const bool           restart,
               Checkpoint          &checkpoint) const;

    /** Warn, once, if a motion has gained more than 1 % of its energy. */
    void
    warn_of_energy(const PathState &state);

    const MPI_Comm      communicator_;
    const ShellProblem &problem_;
    Log                &log_;
    bool                has_warned_of_energy_ = false;
  };
} // namespace Nacre

#endif
