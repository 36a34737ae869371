// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/equilibrium_curve.h>
#include <nacre/analysis/path_failure.h>
#include <nacre/base/mpi_errors.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace Nacre
{
  EquilibriumCurve::EquilibriumCurve(const PathParameters &parameters,
                                     ShellSystem          &system)
    : parameters_(parameters)
    , system_(system)
    , step_control_(parameters.step_of(parameters.minimum_time_step),
                    parameters.step_of(parameters.maximum_time_step),
                    parameters.newton.max_iterations)
  {}

  bool
  EquilibriumCurve::is_beyond_end(const double time) const
  {
    const double end = parameters_.end_time;
    return end > 0. ? time >= end : time <= end;
  }

  bool
  EquilibriumCurve::is_end(const PathState &state) const
  {
    if (state.step >= parameters_.maximum_steps)
      return true;
    return control_ ? state.n_controls >= parameters_.control_values.size() :
                      is_beyond_end(state.time);
  }

  std::string
  EquilibriumCurve::follow(PathState &state, const PathCallbacks &callbacks)
  {
    Assert(control_.has_value() == parameters_.controls_displacement(),
           ExcInternalError());
    while (true)
      {
        count_controls(state);
        if (is_end(state))
          return "";
        double      end = state.time;
        PathAttempt attempt;
        try
          {
            attempt = try_step_to_end(state, end);
          }
        // The user's own expression, on all ranks: smaller steps don't help.
        catch (const ExcUndefinedValue &undefined)
          {
            return "step " + std::to_string(state.step + 1) + ": " +
                   error_text(undefined) + " The last good state is kept.";
          }
        if (!attempt.result.converged)
          {
            const std::string failure = reject(attempt, callbacks, state);
            if (!failure.empty())
              return failure;
            continue;
          }
        const PathState before(state);
        const int       turn = attempt.turn;
        accept(std::move(attempt), end, state);
        const bool switches = look_for_point(before, turn, callbacks, state);
        // Only now: points lie within the step.
        system_.accept_step(state.motion.u, state.time);
        if (!switches && callbacks.pauses && callbacks.pauses(state))
          return "";
        system_.set_time(state.time);
        callbacks.observe(state);
        if (callbacks.ends && callbacks.ends(state))
          return "";
      }
  }

  void
  EquilibriumCurve::follow_control(PathState &state) const
  {
    if (control_)
      state.controlled +=
        control_->change(state.controlled,
                         control_->evaluate(state.motion.u, state.time).value);
  }

  void
  EquilibriumCurve::count_controls(PathState &state) const
  {
    if (!control_)
      return;
    follow_control(state);
    if (state.begins_branch)
      return;
    const auto  &values = parameters_.control_values;
    const double found  = state.controlled;
    while (state.n_controls < values.size() &&
           std::abs(values[state.n_controls] - found) <=
             control_->accuracy * parameters_.control_step +
               1e-14 * std::abs(found))
      ++state.n_controls;
  }

  void
  EquilibriumCurve::accept(PathAttempt &&attempt,
                           const double  end,
                           PathState    &state) const
  {
    ++state.step;
    state.time = end;
    std::move(attempt).accept(system_, state);
    step_control_.accept(state, state.iterations);
    state.begins_branch = false;
    state.motion.a      = 0.;
    follow_control(state);
  }

  std::string
  EquilibriumCurve::reject(const PathAttempt   &attempt,
                           const PathCallbacks &callbacks,
                           PathState           &state) const
  {
    std::ostringstream text;
    text << "step " << state.step + 1 << " from t = " << state.time << ": "
         << attempt.result.reason;
    // The branch is too near to the point that it leaves.
    const bool is_near = state.begins_branch &&
                         attempt.result.kind == FailureKind::singular_tangent;
    const bool may_go_on =
      attempt.result.kind != FailureKind::constant_quantity &&
      step_control_.reject(state,
                           is_near ? 4. * state.next_step : state.next_step);
    if (!may_go_on ||
        (is_near && state.next_step > 100. * parameters_.first_step()))
      return text.str() + ". The last good state is kept. " +
             remedy(attempt.result.kind, parameters_);
    callbacks.tell(text.str() + "; trying " + (is_near ? "twice" : "half") +
                   " the step");
    return "";
  }

  bool
  EquilibriumCurve::look_for_point(const PathState     &before,
                                   const int            turn,
                                   const PathCallbacks &callbacks,
                                   PathState           &after)
  {
    // On a new branch the number changes at the point that it leaves.
    if (before.begins_branch ||
        (before.n_negative_pivots == after.n_negative_pivots && turn == 0))
      return false;
    for (PathPoint &point : find_points(before, after, turn))
      {
        ++after.n_points;
        if (point.is_bifurcation())
          ++after.n_bifurcations;
        point.state.n_points       = after.n_points;
        point.state.n_bifurcations = after.n_bifurcations;
        const int sign             = callbacks.observe_point(point);
        if (sign == 0)
          continue;
        after                   = point.state;
        after.n_negative_pivots = point.n_after;
        begin_branch(sign * static_cast<int>(after.n_bifurcations), after);
        return true;
      }
    return false;
  }

  void
  EquilibriumCurve::begin_branch(const int number, PathState &state) const
  {
    state.branch        = number;
    state.begins_branch = true;
    state.motion.a *= (number > 0 ? 0.5 : -0.5) * system_.thickness();
    // Lengths on the branch have another unit.
    state.motion.v     = 0.;
    state.next_step    = parameters_.first_step();
    state.n_good_steps = 0;
  }

  std::string
  EquilibriumCurve::settle(PathState                         &state,
                           const std::optional<unsigned int> &max_iterations)
  {
    double rate = 0.;
    return settle(state, max_iterations, rate);
  }

  std::string
  EquilibriumCurve::settle(PathState                         &state,
                           const std::optional<unsigned int> &max_iterations,
                           double                            &rate)
  {
    if (state.motion.v.l2_norm() == 0.)
      {
        PathAttempt attempt =
          find_equilibrium(parameters_, system_, state, state.time, false);
        if (!attempt.result.converged)
          return attempt.result.reason;
        std::move(attempt).accept(system_, state);
        return "";
      }
    ArcLengthStep step(system_,
                       state.motion.u,
                       state.time,
                       parameters_.rate_step());
    step.go_to_plane(state.motion.v, 0.);
    const std::string failure =
      solve(max_iterations.value_or(parameters_.newton.max_iterations),
            step,
            state);
    rate = step.end_rate();
    return failure;
  }

  std::string
  EquilibriumCurve::resume(PathState &state)
  {
    if (!control_)
      return settle(state);
    ArcLengthStep step(system_,
                       state.motion.u,
                       state.time,
                       parameters_.rate_step());
    step.go_to_value(*control_, state.controlled);
    return solve(parameters_.newton.max_iterations, step, state);
  }

  std::string
  EquilibriumCurve::solve(const unsigned int max_iterations,
                          ArcLengthStep     &step,
                          PathState         &state)
  {
    auto newton           = parameters_.newton;
    newton.max_increment  = 100. * system_.size();
    newton.max_iterations = max_iterations;
    PathAttempt attempt{step.solve(newton), state.motion};
    if (!attempt.result.converged)
      return attempt.result.reason;
    attempt.motion.u = step.displacement();
    state.time       = step.time();
    std::move(attempt).accept(system_, state);
    return "";
  }

  std::string
  EquilibriumCurve::move(PathState &state, double &size)
  {
    PathState start(state);
    start.next_step = std::abs(size);
    if (size < 0.)
      start.motion.v *= -1.;
    double      time    = state.time;
    PathAttempt attempt = try_step(start, time);
    while (!attempt.result.converged)
      {
        if (!step_control_.reject(start, start.next_step))
          return attempt.result.reason;
        attempt = try_step(start, time);
      }
    if (size < 0.)
      attempt.motion.v *= -1.;
    size       = std::copysign(start.next_step, size);
    state.time = time;
    std::move(attempt).accept(system_, state);
    return "";
  }

  PathAttempt
  EquilibriumCurve::try_step_to_end(const PathState &state, double &end)
  {
    PathAttempt attempt = try_step(state, end);
    if (control_ || !attempt.result.converged || end == parameters_.end_time ||
        !is_beyond_end(end))
      return attempt;
    end = parameters_.end_time;
    PathState guess(state);
    // Between both states, nearer than either.
    guess.motion.u.sadd(0.5, 0.5, attempt.motion.u);
    guess.motion.v = attempt.motion.v;
    return find_equilibrium(parameters_, system_, guess, end, false);
  }

  void
  EquilibriumCurve::set_plane(const PathState &state, ArcLengthStep &step) const
  {
    const double share = state.next_step / parameters_.first_step();
    if (state.begins_branch)
      {
        Vector mode(state.motion.a);
        mode *= share;
        step.go_along_mode(mode);
      }
    else if (control_)
      {
        const double distance =
          parameters_.control_values[state.n_controls] - state.controlled;
        // The shortest way must be the right one.
        const double size = control_->period > 0. ?
                              std::min(state.next_step, control_->period / 4.) :
                              state.next_step;
        // No rest is left that isn't worth a step.
        const bool arrives = std::abs(distance) <= 1.001 * size;
        step.go_to_value(*control_,
                         state.controlled + (arrives ?
                                               distance :
                                               std::copysign(size, distance)));
      }
    else
      {
        const double speed = state.motion.v.l2_norm();
        step.go_along_tangent(state.motion.v,
                              speed > 0. ? state.next_step * speed :
                              parameters_.begins_downward ? -state.next_step :
                                                            state.next_step);
      }
  }

  PathAttempt
  EquilibriumCurve::try_step(const PathState &state, double &end)
  {
    auto newton          = parameters_.newton;
    newton.max_increment = 100. * system_.size();
    ArcLengthStep step(system_,
                       state.motion.u,
                       state.time,
                       parameters_.rate_step());
    set_plane(state, step);
    PathAttempt attempt{step.solve(newton), state.motion};
    if (!attempt.result.converged)
      return attempt;
    attempt.motion.u = step.displacement();
    // The secant tells the side of the next step.
    const double speed = state.motion.v.l2_norm();
    Vector      &next  = attempt.motion.v;
    next               = step.displacement();
    next -= state.motion.u;
    next *=
      (speed > 0. ? speed : step.predictor().l2_norm() / state.next_step) /
      next.l2_norm();
    end          = step.time();
    attempt.turn = step.turn();
    attempt.check(system_, false, &state);
    return attempt;
  }

  PathState
  EquilibriumCurve::interpolate(const PathState &low,
                                const PathState &high,
                                const double     share,
                                const Vector    &normal) const
  {
    PathState state(low);
    state.motion.u.sadd(1. - share, share, high.motion.u);
    state.motion.v = normal;
    state.time     = (1. - share) * low.time + share * high.time;
    return state;
  }

  std::optional<double>
  EquilibriumCurve::Bracket::crossing() const
  {
    if (!low_value || !high_value || !(*low_value * *high_value < 0.))
      return {};
    return *low_value / (*low_value - *high_value);
  }

  bool
  EquilibriumCurve::halve(const double     share,
                          const Vector    &normal,
                          Bracket         &bracket,
                          const MassTerms &mass,
                          Vector          &mode)
  {
    // At the point itself the tangent may be singular, and the meshes' own
    // imperfection may leave a gap in the path.
    for (const double place : {share, 0.5 * share, 0.5 + 0.5 * share})
      {
        PathState trial = interpolate(bracket.low, bracket.high, place, normal);
        double    value = 0.;
        if (!settle(trial, 8, value).empty())
          continue;
        if (bracket.turn == 0)
          value = system_.improve_mode(mass, 6, mode);
        // Near the point itself pivots are round-off.
        else if (bracket.size > 0.02 &&
                 trial.n_negative_pivots != bracket.low.n_negative_pivots)
          {
            bracket.between = trial;
            return false;
          }
        const bool is_before =
          bracket.turn == 0 ?
            trial.n_negative_pivots == bracket.low.n_negative_pivots :
            bracket.turn * value > 0.;
        (is_before ? bracket.low : bracket.high)             = trial;
        (is_before ? bracket.low_value : bracket.high_value) = value;
        bracket.size *= is_before ? 1. - place : place;
        return true;
      }
    return false;
  }

  void
  EquilibriumCurve::narrow(Bracket &bracket, PathPoint &point)
  {
    // All planes are normal to the step, so that states don't overtake.
    Vector normal(bracket.high.motion.u);
    normal -= bracket.low.motion.u;
    const MassTerms       mass(system_.discretization());
    const int             turn = bracket.turn;
    Vector                mode = any_mode();
    std::optional<double> crossing, time;
    bool                  is_found = false;
    for (unsigned int k = 0; k < 40 && !is_found; ++k)
      {
        // To both sides of where the eigenvalue crosses zero.
        const double side = k % 2 == 0 ? 0.15 : -0.15;
        const double share =
          crossing ? std::clamp(*crossing + side, 0.05, 0.95) : 0.5;
        if (!halve(share, normal, bracket, mass, mode))
          break;
        const PathState &low = bracket.low, &high = bracket.high;
        const double     scale =
          std::max(std::abs(low.time), parameters_.time_step);
        is_found = std::abs(high.time - low.time) <= 1e-6 * scale &&
                   bracket.size <= 1e-4;
        crossing = bracket.crossing();
        if (!crossing)
          continue;
        const double last = time.value_or(high.time + scale);
        time              = (1. - *crossing) * low.time + *crossing * high.time;
        is_found = is_found || (std::abs(*time - last) <= 2e-7 * scale &&
                                bracket.size <= 1e-2);
      }
    if (bracket.between)
      return;
    // Not at the crossing itself, where the tangent would be singular.
    place(bracket, std::min(crossing.value_or(1.) + 1e-4, 1.), normal, point);
    const bool is_limit =
      turn == 0 && rises(bracket.low, normal) != rises(bracket.high, normal);
    if (!crossing || turn != 0)
      system_.improve_mode(mass, 10, mode);
    const unsigned int n_changes = std::max(point.n_before, point.n_after) -
                                   std::min(point.n_before, point.n_after);
    point.kind = turn != 0      ? "bifurcation of another path" :
                 !is_limit      ? "bifurcation" :
                 n_changes == 1 ? "limit" :
                                  "limit and bifurcation";
    if (!is_found)
      point.kind += " (not pinpointed)";
    point.state.motion.a = scaled_mode(mode);
  }

  void
  EquilibriumCurve::place(const Bracket &bracket,
                          const double   crossing,
                          const Vector  &normal,
                          PathPoint     &point)
  {
    PathState state = interpolate(bracket.low, bracket.high, crossing, normal);
    PathState exact(state);
    const double scale = std::max(std::abs(state.time), parameters_.time_step);
    if (settle(exact, 5).empty() &&
        std::abs(exact.time - state.time) <=
          std::max(1e-5 * scale,
                   std::abs(bracket.high.time - bracket.low.time)))
      state = exact;
    system_.set_time(state.time);
    point.n_after           = bracket.high.n_negative_pivots;
    point.state.motion      = state.motion;
    point.state.time        = state.time;
    point.state.load_factor = system_.load_factor();
  }

  std::vector<PathPoint>
  EquilibriumCurve::find_points(const PathState &before,
                                const PathState &after,
                                const int        turn)
  {
    PathPoint point;
    point.n_before = before.n_negative_pivots;
    point.n_after  = after.n_negative_pivots;
    point.state    = after;
    // The point lies before what the step has reached.
    point.state.n_controls = before.n_controls;
    Bracket bracket{before, after, point.n_before == point.n_after ? turn : 0};
    narrow(bracket, point);
    std::vector<PathPoint> points = {point};
    if (bracket.between)
      points = find_points(before, *bracket.between, 0);
    // The rest of the step may have points as well.
    const PathState &rest = bracket.between ? *bracket.between : bracket.high;
    if (rest.n_negative_pivots != after.n_negative_pivots)
      for (const PathPoint &other : find_points(rest, after, 0))
        points.push_back(other);
    return points;
  }

  EquilibriumCurve::Vector
  EquilibriumCurve::any_mode() const
  {
    return system_.interpolate([this](const Point<spacedim> &x) {
      Tensor<1, spacedim> value;
      for (unsigned int c = 0; c < spacedim; ++c)
        value[c] =
          std::sin((7.3 * x[0] + 5.1 * x[1] + 6.7 * x[2]) / system_.size() + c);
      return value;
    });
  }

  EquilibriumCurve::Vector
  EquilibriumCurve::scaled_mode(const Vector &mode) const
  {
    double largest = 0.;
    for (const double entry : mode)
      if (std::abs(entry) > std::abs(largest))
        largest = entry;
    for (const double other :
         Utilities::MPI::all_gather(system_.discretization().communicator(),
                                    largest))
      if (std::abs(other) > std::abs(largest))
        largest = other;
    Vector result(mode);
    result /= largest;
    return result;
  }

  bool
  EquilibriumCurve::rises(const PathState &state, const Vector &direction)
  {
    system_.set_time(state.time);
    Vector     du   = system_.owned_vector();
    const auto step = system_.solve_linearised(state.motion.u, du);
    return step.failure.kind != FailureKind::none ||
           system_.rate(state.motion.u, state.time, parameters_.rate_step())
                 .velocity *
               direction >
             0.;
  }
} // namespace Nacre
