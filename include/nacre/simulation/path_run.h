// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_run_h
#define nacre_simulation_path_run_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/checkpoint.h>

#include <memory>
#include <optional>
#include <string>

namespace Nacre
{
  class AdaptiveRefinement;
  class DiscreteShell;
  class PathMonitor;

  /**
   * A load path or a motion, with files of its own: a row for each step,
   * fields, checkpoints. The study's table holds the last state. A static path
   * may refine its mesh on the way, and then has no checkpoints.
   */
  class PathRun : public Analysis
  {
  public:
    /** @p problem and @p adaptive must live as long. */
    PathRun(const MPI_Comm            communicator,
            const ShellProblem       &problem,
            const AdaptiveRefinement &adaptive,
            Log                      &log);

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
    struct SteppedShell;

    /** Refuse a restart of what has no checkpoints. */
    void
    check_restart(const bool restart) const;

    /** From @p state to the end, or to the failure that is returned. */
    std::string
    follow(std::unique_ptr<SteppedShell> &stepped,
           PathState                     &state,
           PathMonitor                   &monitor);

    /**
     * Refine the mesh of @p stepped where the error of @p state is large, and
     * bring the state to equilibrium there, at the same load; or leave all as
     * it is if the mesh is good enough.
     */
    void
    refine(std::unique_ptr<SteppedShell> &stepped, PathState &state);

    /** Write what is left to write; throws the @p failure, if there is one. */
    void
    finish(SteppedShell      &stepped,
           const PathState   &state,
           const std::string &failure,
           SolveRecord       &record,
           PathMonitor       &monitor,
           Recorder          &recorder);

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

    const MPI_Comm            communicator_;
    const ShellProblem       &problem_;
    const AdaptiveRefinement &adaptive_;
    Log                      &log_;
    double                    assembly_seconds_ = 0.; // of the meshes before
    unsigned int              n_refinements_    = 0;
    bool                      has_warned_of_energy_ = false;
  };
} // namespace Nacre

#endif
