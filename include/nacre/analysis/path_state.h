// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_path_state_h
#define nacre_analysis_path_state_h

#include <nacre/analysis/energy_ledger.h>
#include <nacre/analysis/path_parameters.h>
#include <nacre/analysis/shell_system.h>
#include <nacre/analysis/step_control.h>

#include <functional>
#include <string>

namespace Nacre
{
  /** Everything that a path goes on from, and what its last step took. */
  struct PathState : StepSize
  {
    unsigned int step = 0;
    double       time = 0.;
    /**
     * With arc length v is the tangent of the path (length/time), so scaled
     * that next_step times |v| is the length of the next step; a is the mode
     * (length) that a branch begins with, or else zero.
     */
    MotionState motion;
    /** Of a dynamic path. */
    EnergyBalance balance;

    /** @name Of a curve of equilibria */
    //@{
    /** Points and bifurcation points found so far. */
    unsigned int n_points       = 0;
    unsigned int n_bifurcations = 0;
    /** The signed number of the branch; 0: the primary path. */
    int branch = 0;
    /** Whether the next step leaves a bifurcation point along motion.a. */
    bool begins_branch = false;
    /** Values of the controlled quantity that have been reached. */
    unsigned int n_controls = 0;
    /** That quantity: of an angle with all turns since the start. */
    double controlled = 0.;
    //@}

    /** @name The last step */
    //@{
    double       load_factor       = 0.;
    unsigned int iterations        = 0;
    double       residual          = 0.;
    unsigned int n_negative_pivots = 0;
    //@}
  };

  /**
   * A point of a curve of equilibria at which its stability changes, or at
   * which t turns and it doesn't: the curve is a branch there that passes
   * through the path that it leaves.
   */
  struct PathPoint
  {
    /**
     * "limit", "bifurcation", "limit and bifurcation", or "bifurcation of
     * another path", where t turns but stability stays; "(not pinpointed)"
     * follows where the state is that after the whole step.
     */
    std::string kind;
    /** Negative eigenvalues of the tangent before and after it. */
    unsigned int n_before = 0;
    unsigned int n_after  = 0;
    /**
     * A state just after it, whose motion.a is the mode of the tangent's
     * smallest eigenvalue, its largest entry 1.
     */
    PathState state;

    /** Whether a branch leaves along the mode. */
    bool
    is_bifurcation() const
    {
      return n_before != n_after &&
             kind.find("bifurcation") != std::string::npos;
    }
  };

  /** Whom a path tells what it does; all are called on all ranks. */
  struct PathCallbacks
  {
    /** Called for the start and after each step. */
    std::function<void(const PathState &)> observe;
    /**
     * Called for each point of a curve. Returns 0 to stay on the path, or 1 or
     * -1 to go on along the branch that leaves there, by the sign of its mode.
     */
    std::function<int(const PathPoint &)> observe_point;
    /** Words for the user, as of a step that is tried again. */
    std::function<void(const std::string &)> tell;
    /** Whether to pause at a step, before it is observed; may be empty. */
    std::function<bool(const PathState &)> pauses = {};
    /** Whether the path ends at a step, after it was observed; may be empty. */
    std::function<bool(const PathState &)> ends = {};
  };

  /** The end of a step, if it has converged. */
  struct PathAttempt
  {
    NewtonSolver::Result result;
    MotionState          motion;
    EnergyBalance        balance = {};
    /** ArcLengthStep::turn() */
    int turn = 0;

    /** Make it the end of @p state, at the time that @p system has. */
    void
    accept(const ShellSystem &system, PathState &state) &&;

    /**
     * Fail if the deformation is impossible.
     * @param before the state that the step has begun with; null if it has
     *   jumped
     */
    void
    check(const ShellSystem &system,
          const bool         is_dynamic,
          const PathState   *before);
  };

  /**
   * The equilibrium of @p system at @p time by Newton's method from the
   * displacement of @p guess. Collective.
   */
  PathAttempt
  find_equilibrium(const PathParameters &parameters,
                   ShellSystem          &system,
                   const PathState      &guess,
                   const double          time,
                   const bool            line_search);
} // namespace Nacre

#endif
