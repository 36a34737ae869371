// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_equilibrium_curve_h
#define nacre_analysis_equilibrium_curve_h

#include <nacre/analysis/arc_length_step.h>
#include <nacre/analysis/path_state.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * Follows the curve of equilibria r(u, t) = 0, along which t rises and falls,
   * by steps of a length, or by steps of a quantity that is controlled; finds
   * the points where its stability changes, and follows the branches there.
   */
  class EquilibriumCurve
  {
  public:
    using Vector = ShellSystem::Vector;

    /** Everything must live as long. */
    EquilibriumCurve(const PathParameters &parameters, ShellSystem &system);

    /**
     * With Type = displacement control: the @p quantity that is controlled.
     */
    void
    control(const ControlledQuantity &quantity)
    {
      control_ = quantity;
    }

    /**
     * Go on from @p state to the end, or to a step where a callback says so.
     * Returns "", or, if a step can't be made small enough, why; @p state is
     * then the last good one.
     */
    std::string
    follow(PathState &state, const PathCallbacks &callbacks);

    /**
     * Bring a @p state that is close to equilibrium to the curve, in the plane
     * normal to its direction, or at its time if it has none. Returns "" or
     * why that failed; @p state is unchanged then.
     * @param max_iterations in the plane, if not as many as a step may take
     */
    std::string
    settle(PathState                         &state,
           const std::optional<unsigned int> &max_iterations = {});

    /**
     * settle() after another mesh or longer cuts; if a quantity is controlled,
     * where it has the value PathState::controlled.
     */
    std::string
    resume(PathState &state);

    /**
     * Move @p state along the curve by a step of @p size (time, as
     * PathState::next_step), backward if that is negative, or by less if that
     * doesn't converge: @p size is then what it has become. Neither is that a
     * step of the path, nor are points looked for. Returns "" or why it failed;
     * @p state is unchanged then.
     */
    std::string
    move(PathState &state, double &size);

    /**
     * Make @p state, that of a bifurcation point, the start of the branch
     * @p number, whose sign is that of the mode along which it begins.
     */
    void
    begin_branch(const int number, PathState &state) const;

  private:
    /** Whether the path ends by the parameters. */
    bool
    is_end(const PathState &state) const;

    /** Whether the @p time is at or beyond the End time. */
    bool
    is_beyond_end(const double time) const;

    /** The state's value of the controlled quantity, from its last one. */
    void
    follow_control(PathState &state) const;

    /** Count the values of the controlled quantity that were reached. */
    void
    count_controls(PathState &state) const;

    /**
     * A step; its end is @p end.
     */
    PathAttempt
    try_step(const PathState &state, double &end);

    /** Its plane. */
    void
    set_plane(const PathState &state, ArcLengthStep &step) const;

    /** try_step() that ends at the End time if that is passed. */
    PathAttempt
    try_step_to_end(const PathState &state, double &end);

    /** Make @p attempt the end of the step from @p state to @p end. */
    void
    accept(PathAttempt &&attempt, const double end, PathState &state) const;

    /** A step has failed: reduce its size; returns why the path ends, or "". */
    std::string
    reject(const PathAttempt   &attempt,
           const PathCallbacks &callbacks,
           PathState           &state) const;

    /**
     * Tell of the points between @p before and @p after, if there are any, and
     * count them in @p after, which becomes the start of a branch if the
     * callback says so; returns whether it does.
     * @param turn of t in the step between them: PathAttempt::turn
     */
    bool
    look_for_point(const PathState     &before,
                   const int            turn,
                   const PathCallbacks &callbacks,
                   PathState           &after);

    /** Two states with a point between them. */
    struct Bracket
    {
      PathState low;
      PathState high;
      /** Of t, where the point is one of a turn; else 0. */
      int turn = 0;
      /** Of the share of the step between them. */
      double size = 1.;
      /**
       * What is zero at the point, if known: the tangents' smallest
       * eigenvalues, or dt/ds where t turns.
       */
      std::optional<double> low_value  = {};
      std::optional<double> high_value = {};
      /** Of a turn: a state whose stability is another than that of both. */
      std::optional<PathState> between = {};

      /**
       * The share of the way from low to high where that crosses zero by
       * interpolation, if it has changed its sign.
       */
      std::optional<double>
      crossing() const;
    };

    /**
     * The points at which stability changes within the step from @p before to
     * @p after: to 1e-6 of t or of the time step. Or that at which t turns; or
     * the two at which stability changes and changes back.
     */
    std::vector<PathPoint>
    find_points(const PathState &before,
                const PathState &after,
                const int        turn);

    /**
     * Narrow down the first point in @p bracket, set the state of @p point,
     * with the mode there, and tell its kind.
     *
     * The eigenvalue's crossing of zero is interpolated from states on both
     * sides: a mesh that lacks the shell's symmetry a little makes another
     * curve of a bifurcation point, with a gap at the point itself, into which
     * no bisection leads.
     *
     * Where t turns but stability stays, the smallest eigenvalue touches zero,
     * and dt/ds crosses it. If there is a state of another stability in
     * between, it enters bracket.between, and the point is not set.
     */
    void
    narrow(Bracket &bracket, PathPoint &point);

    /**
     * Replace an end of the @p bracket by a state about @p share of the way
     * from low to high. Returns whether one was found.
     * @param mode a guess of the smallest eigenvalue's, which is improved
     */
    bool
    halve(const double     share,
          const Vector    &normal,
          Bracket         &bracket,
          const MassTerms &mass,
          Vector          &mode);

    /** settle(), and dt/ds at the state. */
    std::string
    settle(PathState                         &state,
           const std::optional<unsigned int> &max_iterations,
           double                            &rate);

    /** Solve @p step for @p state; returns "" or why that failed. */
    std::string
    solve(const unsigned int max_iterations,
          ArcLengthStep     &step,
          PathState         &state);

    /** Take the state at the @p crossing as that of the @p point. */
    void
    place(const Bracket &bracket,
          const double   crossing,
          const Vector  &normal,
          PathPoint     &point);

    /** Between two states, with the @p normal of a plane as direction. */
    PathState
    interpolate(const PathState &low,
                const PathState &high,
                const double     share,
                const Vector    &normal) const;

    /** A displacement that has a part of each mode. */
    Vector
    any_mode() const;

    /** Whether t rises along @p direction at @p state. */
    bool
    rises(const PathState &state, const Vector &direction);

    /** The @p mode with a largest entry of 1. */
    Vector
    scaled_mode(const Vector &mode) const;

    const PathParameters &parameters_;
    ShellSystem          &system_;
    const StepControl     step_control_;

    std::optional<ControlledQuantity> control_;
  };
} // namespace Nacre

#endif
