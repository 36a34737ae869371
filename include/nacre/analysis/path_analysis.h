// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_analysis_h
#define nacre_analysis_path_analysis_h

#include <nacre/analysis/energy_ledger.h>
#include <nacre/analysis/path_parameters.h>
#include <nacre/analysis/shell_system.h>
#include <nacre/analysis/step_control.h>

#include <functional>
#include <memory>
#include <optional>

namespace Nacre
{
  /** Everything that a path goes on from, and what its last step took. */
  struct PathState : StepSize
  {
    unsigned int step = 0;
    double       time = 0.;
    /**
     * With arc length v is the tangent of the path (length/time), so scaled
     * that next_step times |v| is the length of the next step.
     */
    MotionState motion;
    /** Of a dynamic path. */
    EnergyBalance balance;

    /** @name The last step */
    //@{
    double       load_factor       = 0.;
    unsigned int iterations        = 0;
    double       residual          = 0.;
    unsigned int n_negative_pivots = 0;
    //@}
  };

  /** A point of a path with arc length at which its stability changes. */
  struct PathPoint
  {
    /**
     * "limit", "bifurcation", or "limit and bifurcation"; "(not pinpointed)"
     * follows where the state is that after the whole step.
     */
    std::string kind;
    /** Negative eigenvalues of the tangent before and after it. */
    unsigned int n_before = 0;
    unsigned int n_after  = 0;
    /** A state just after it. */
    PathState state;
  };

  /**
   * Follows a shell along a load path or in time, with steps that are halved
   * where one fails.
   */
  class PathAnalysis
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    /** Called for the start and after each step. */
    using Observer = std::function<void(const PathState &)>;
    /** Called for each point of a path with arc length. */
    using PointObserver = std::function<void(const PathPoint &)>;
    /** Whether to pause at a step, before the observer sees it. */
    using Pause = std::function<bool(const PathState &)>;
    /** Words for the user, as of a step that is tried again. */
    using Messenger = std::function<void(const std::string &)>;

    /**
     * @param section gives the mass; not used in statics
     */
    PathAnalysis(const PathParameters &parameters,
                 ShellSystem          &system,
                 const SectionLaw     &section);

    /**
     * The state at t = 0: at rest and undeformed, or with the displacement and
     * in dynamics the velocity of @p start, if there is one; in dynamics what
     * the parameters say is added. Collective.
     */
    PathState
    initial_state(const MotionState *start = nullptr) const;

    /** Whom a path tells what it does; all are called on all ranks. */
    struct Callbacks
    {
      Observer      observe;
      PointObserver observe_point;
      Messenger     tell;
      /** May be empty. */
      Pause pauses = {};
    };

    /**
     * Go on from @p state to the end time, or to a step where pauses() says
     * so. Returns "", or, if a step can't be made small enough, why; @p state
     * is then the last good one.
     */
    std::string
    run(PathState &state, const Callbacks &callbacks);

    /**
     * Bring a static @p state that is close to equilibrium, as one that comes
     * from another mesh, to equilibrium at its own time. Returns "" or why that
     * failed; @p state is unchanged then. Collective.
     */
    std::string
    settle(PathState &state);

    /** The mass of the shell in motion; null in statics. */
    const MassTerms *
    dynamic_mass() const
    {
      return parameters_.is_dynamic() ? &*mass_ : nullptr;
    }

  private:
    struct Attempt
    {
      NewtonSolver::Result result;
      MotionState          motion;
      EnergyBalance        balance = {};
    };

    /** run() with arc length; the time may fall. */
    std::string
    follow_arc(PathState &state, const Callbacks &callbacks);

    /**
     * The point at which stability changes within the step from @p before to
     * @p after, by bisection of its length: to a relative 1e-6 of t.
     */
    PathPoint
    find_point(const PathState &before, const PathState &after);

    /** Whether t rises along the direction of the path at @p state. */
    bool
    rises(const PathState &state);

    /**
     * A step of length state.next_step times |state.motion.v|.
     * @param mode if given, the step begins along it, on another branch
     */
    Attempt
    arc_step(const PathState &state, double &end, const Vector *mode = nullptr);

    /** Of derivatives with respect to the time. */
    double
    rate_step() const
    {
      return 0.01 * parameters_.time_step;
    }

    /** The mode of the tangent's smallest eigenvalue, its largest entry 1. */
    Vector
    lowest_mode(const PathState &state);

    /** The equilibrium at the End time between @p state and @p attempt. */
    Attempt
    last_arc_step(const PathState &state,
                  const Attempt   &attempt,
                  const double     end);

    /** try_step() as the parameters say: with a line search, without, both. */
    Attempt
    try_searches(const PathState &state, const double dt);

    Attempt
    try_step(const PathState &state, const double dt, const bool line_search);

    /**
     * Let an attempt that has converged fail if its deformation is impossible.
     * @param before the state that the step has begun with; null if the attempt
     *   has jumped
     */
    void
    check_state(Attempt &attempt, const PathState *before) const;

    Attempt
    static_step(const PathState &state, const double dt, const bool search);

    Attempt
    dynamic_step(const PathState &state, const double dt, const bool search);

    /** Why a dynamic path must not go on with this balance; or "". */
    std::string
    find_energy_gain(const EnergyBalance &balance) const;

    /** Dynamic relaxation from the last good state. */
    Attempt
    relax(const PathState &state, const double dt);

    /** Make the attempt's end the state's, at the time that the system has. */
    void
    accept(PathState &state, Attempt &&attempt) const;

    const PathParameters    &parameters_;
    ShellSystem             &system_;
    const TimeIntegrator     integrator_;
    const StepControl        step_control_;
    std::optional<MassTerms> mass_;
    /** In dynamics only. */
    std::optional<EnergyLedger> ledger_;
  };
} // namespace Nacre

#endif
