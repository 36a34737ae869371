// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_run_h
#define nacre_simulation_path_run_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/crack_growth.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  class AdaptiveRefinement;
  class DiscreteShell;
  class GrowthMonitor;
  class PathMonitor;
  struct SteppedShell;

  /**
   * A load path or a motion, with files of its own: a row for each step,
   * fields, checkpoints. Cuts may grow on the way; a static path, or one whose
   * t is unknown, may refine its mesh.
   *
   * A curve of equilibria may have several branches, which are paths with files
   * of their own, followed one after the other. The study's table holds the
   * last state of the last one.
   */
  class PathRun : public Analysis
  {
  public:
    /** @p problem, whose cuts may grow, and @p adaptive must live as long. */
    PathRun(const MPI_Comm            communicator,
            ShellProblem             &problem,
            const AdaptiveRefinement &adaptive,
            Log                      &log);

    ~PathRun() override;

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
    /**
     * The shell that a path begins with: at a restart with the cuts and the
     * mesh of the checkpoint. Collective.
     */
    std::unique_ptr<SteppedShell>
    first_shell(const Recorder &recorder, const bool restart);

    /**
     * Begin with the cuts of the checkpoint @p base; returns its mesh, or null
     * if that is the problem's. Collective.
     */
    std::unique_ptr<MeshRecord::Mesh>
    take_cuts_and_mesh(const std::string &base);

    /** Add to @p data what is known of the shell of now. */
    void
    complete(CheckpointData &data) const;

    /** The end of a path, and why it failed, or "". */
    struct PathEnd
    {
      PathState   state;
      std::string failure;
    };

    /**
     * Follow the primary path, @p branch = 0, or a branch, with all its files.
     * @param restart whether it goes on from a checkpoint of its own
     */
    PathEnd
    follow_path(const int branch, const bool restart, Recorder &recorder);

    /** The state that a path begins with, and the start of its files. */
    PathState
    begin(const int            branch,
          const bool           restart,
          const OutputOptions &options,
          Checkpoint          &checkpoint,
          PathMonitor         &monitor,
          const Recorder      &recorder);

    /** From @p state to the end, or to the failure that is returned. */
    std::string
    follow(PathState &state, PathMonitor &monitor, const Recorder &recorder);

    /** Whether the path ends at @p state; tells why. */
    bool
    ends(const PathState &state, const QuantitiesOfInterest &quantities);

    /**
     * Take note of a point of a curve.
     * @return PathCallbacks::observe_point
     */
    int
    take_point(const PathPoint &point, PathMonitor &monitor);

    /** The branches to follow if the primary path has @p n_found. */
    std::vector<int>
    branches(const unsigned int n_found) const;

    /** The start of the branch @p number at its point. */
    PathState
    branch_start(const int number, const OutputOptions &primary);

    /**
     * Refine the mesh where the error of @p state is large, and bring the state
     * to equilibrium there; or leave all as it is if the mesh is good enough.
     */
    void
    refine(const QuantitiesOfInterest &quantities, PathState &state);

    /**
     * Whether tips may advance, or be in the table of growth, at @p state: in
     * dynamics not while lips are being released, whose forces G doesn't know.
     */
    bool
    watches_tips(const PathState &state) const;

    /** The tips as growth finds them at @p state. */
    void
    look_at_tips(const PathState &state);

    /** A row for @p state, at which growth has looked, in growth's table. */
    void
    record_growth(const PathState &state);

    /**
     * Whether tips advance at equilibria with G = G_c h that are looked for
     * along the curve, or when the strength is just reached.
     */
    bool
    seeks_critical_state() const
    {
      return problem_.path.type == AnalysisType::arc_length &&
             !problem_.growth.is_prescribed();
    }

    /**
     * Move @p state, at which growth has looked, along the curve to where the
     * first one is about to: |CrackGrowth::critical_factor() - 1| <= 1e-7.
     * Returns "", or why there is none. Growth looks at the last one tried.
     */
    std::string
    find_critical_state(PathState &state);

    /**
     * Let the cuts grow at the @p state for as long as tips advance, each step
     * with a new equilibrium at the same time; in dynamics by one step. Returns
     * "", or why the last step has none: @p state is then the one before it.
     */
    std::string
    grow(const QuantitiesOfInterest &quantities, PathState &state);

    /**
     * Make @p state the critical one, if tips would advance there; or, if it is
     * critical, let the cuts grow by a step and make it that of the longer
     * cuts. If that lies nowhere up to the End time, the state is the one near
     * the last, from which the path goes on. Returns as grow().
     */
    std::string
    grow_along_curve(const QuantitiesOfInterest &quantities, PathState &state);

    /**
     * Lengthen the cuts by a step. In dynamics returns how long the new lips
     * are held (time), a time step at least if at all.
     */
    double
    advance_tips(PathState &state);

    /** A step of that. */
    std::string
    grow_by_a_step(const QuantitiesOfInterest &quantities, PathState &state);

    /** The row of the last @p state. */
    void
    add_row(const PathState &state, SolveRecord &record, Recorder &recorder);

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
    CrackGrowth               growth_;
    /** Where cuts grow. */
    std::unique_ptr<GrowthMonitor> growth_monitor_;
    /** On the mesh of now. */
    std::unique_ptr<SteppedShell> stepped_;
    /** States of the primary path's bifurcation points, by their numbers. */
    std::map<unsigned int, PathState> bifurcations_;
    double       assembly_seconds_     = 0.; // of the meshes before
    unsigned int n_refinements_        = 0;
    bool         has_warned_of_energy_ = false;
    /** GrowthRecord::is_critical */
    bool is_critical_ = false;
  };
} // namespace Nacre

#endif
