// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/arc_length_step.h>
#include <nacre/analysis/deformation_check.h>
#include <nacre/analysis/dynamic_step.h>
#include <nacre/analysis/path_analysis.h>
#include <nacre/analysis/path_failure.h>
#include <nacre/analysis/relaxation.h>
#include <nacre/base/mpi_errors.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  PathAnalysis::PathAnalysis(const PathParameters &parameters,
                             ShellSystem          &system,
                             const SectionLaw     &section)
    : parameters_(parameters)
    , system_(system)
    , integrator_(parameters.scheme,
                  parameters.spectral_radius,
                  parameters.mass_damping)
    , step_control_(parameters.minimum_time_step,
                    parameters.maximum_time_step,
                    parameters.newton.max_iterations)
  {
    if (parameters.is_dynamic())
      {
        mass_.emplace(system.discretization(), section);
        ledger_.emplace(system, *mass_, parameters.mass_damping);
      }
    else if (parameters.type == AnalysisType::relaxation)
      mass_.emplace(system.discretization());
  }

  PathState
  PathAnalysis::initial_state(const MotionState *start) const
  {
    PathState state;
    state.next_step = parameters_.time_step;
    system_.set_time(0.);
    state.load_factor   = system_.load_factor();
    MotionState &motion = state.motion;
    motion.u            = system_.owned_vector();
    motion.v            = motion.u;
    motion.a            = motion.u;
    if (start != nullptr)
      motion.u = start->u;
    if (!parameters_.is_dynamic())
      return state;

    motion.u +=
      system_.interpolate(std::cref(parameters_.initial_displacement));
    if (start != nullptr)
      motion.v = start->v;
    motion.v += system_.interpolate(std::cref(parameters_.initial_velocity));
    system_.constraints().distribute(motion.u);
    motion.a      = system_.acceleration(motion.u,
                                    motion.v,
                                    parameters_.mass_damping,
                                    *mass_);
    state.balance = ledger_->start(motion, parameters_.time_step);
    return state;
  }

  std::string
  PathAnalysis::run(PathState &state, const Callbacks &callbacks)
  {
    if (state.step == 0)
      callbacks.observe(state);
    if (parameters_.type == AnalysisType::arc_length)
      return follow_arc(state, callbacks);
    const TimeGrid grid = parameters_.time_grid();
    while (!grid.is_end(state.time))
      {
        const double       end = grid.next(state.time, state.next_step);
        const double       dt  = end - state.time;
        std::ostringstream text, kept;
        text << "step " << state.step + 1 << " to t = " << end << ": ";
        kept << " The last good state, at t = " << state.time << ", is kept.";
        Attempt attempt;
        try
          {
            attempt = try_searches(state, dt);
          }
        // The user's own expression, on all ranks: smaller steps don't help.
        catch (const ExcUndefinedValue &undefined)
          {
            return text.str() + error_text(undefined) + kept.str();
          }
        if (!attempt.result.converged)
          {
            text << attempt.result.reason;
            if (!step_control_.reject(state, dt))
              return text.str() + "." + kept.str() + " " +
                     remedy(attempt.result.kind, parameters_);
            callbacks.tell(text.str() + "; trying half the step");
            continue;
          }
        const std::string gain = find_energy_gain(attempt.balance);
        if (!gain.empty())
          return text.str() + gain;
        ++state.step;
        state.time = end;
        accept(state, std::move(attempt));
        step_control_.accept(state, state.iterations);
        if (callbacks.pauses && callbacks.pauses(state))
          return "";
        callbacks.observe(state);
      }
    return "";
  }

  std::string
  PathAnalysis::settle(PathState &state)
  {
    Assert(!parameters_.is_dynamic(), ExcInternalError());
    Attempt attempt = try_searches(state, 0.);
    if (!attempt.result.converged)
      return attempt.result.reason;
    accept(state, std::move(attempt));
    return "";
  }

  void
  PathAnalysis::accept(PathState &state, Attempt &&attempt) const
  {
    state.motion            = std::move(attempt.motion);
    state.balance           = attempt.balance;
    state.load_factor       = system_.load_factor();
    state.iterations        = attempt.result.iterations;
    state.residual          = attempt.result.last.residual;
    state.n_negative_pivots = attempt.result.last.n_negative_pivots;
  }

  std::string
  PathAnalysis::follow_arc(PathState &state, const Callbacks &callbacks)
  {
    const TimeGrid     grid           = parameters_.time_grid();
    const unsigned int switches_at    = std::abs(parameters_.switch_branch);
    unsigned int       n_bifurcations = 0;
    Vector             mode;
    bool               switches = false;
    while (!grid.is_end(state.time) && state.step < parameters_.maximum_steps)
      {
        double  end = state.time;
        Attempt attempt;
        try
          {
            attempt = arc_step(state, end, switches ? &mode : nullptr);
            if (attempt.result.converged && end > parameters_.end_time)
              {
                end     = parameters_.end_time;
                attempt = last_arc_step(state, attempt, end);
              }
          }
        // As in run().
        catch (const ExcUndefinedValue &undefined)
          {
            return "step " + std::to_string(state.step + 1) + ": " +
                   error_text(undefined) + " The last good state is kept.";
          }
        if (attempt.result.converged)
          {
            const PathState before(state);
            ++state.step;
            state.time = end;
            accept(state, std::move(attempt));
            step_control_.accept(state, state.iterations);
            // The undeformed shell's stability isn't known.
            if (before.step > 0 && !switches &&
                before.n_negative_pivots != state.n_negative_pivots)
              {
                const PathPoint point = find_point(before, state);
                callbacks.observe_point(point);
                if (point.kind.find("bifurcation") != std::string::npos &&
                    ++n_bifurcations == switches_at)
                  {
                    callbacks.tell(
                      "the path goes on along the branch that leaves "
                      "this point");
                    mode = lowest_mode(point.state);
                    mode *= (parameters_.switch_branch > 0 ? 0.5 : -0.5) *
                            system_.thickness();
                    switches = true;
                    state    = point.state;
                    // Lengths on the branch have another unit.
                    state.motion.v  = 0.;
                    state.next_step = parameters_.time_step;
                    continue;
                  }
              }
            switches = false;
            system_.set_time(state.time);
            callbacks.observe(state);
            continue;
          }
        std::ostringstream text;
        text << "step " << state.step + 1 << " from t = " << state.time << ": "
             << attempt.result.reason;
        // The branch is too near to the point that it leaves.
        const bool is_near =
          switches && attempt.result.kind == FailureKind::singular_tangent;
        const bool may_go_on =
          step_control_.reject(state,
                               is_near ? 4. * state.next_step :
                                         state.next_step);
        if (!may_go_on ||
            (is_near && state.next_step > 100. * parameters_.time_step))
          return text.str() + ". The last good state is kept. " +
                 remedy(attempt.result.kind, parameters_);
        callbacks.tell(text.str() + "; trying " + (is_near ? "twice" : "half") +
                       " the step");
      }
    return "";
  }

  PathPoint
  PathAnalysis::find_point(const PathState &before, const PathState &after)
  {
    PathPoint point;
    point.n_before = before.n_negative_pivots;
    point.n_after  = after.n_negative_pivots;
    point.state    = after;
    PathState trial(before);
    // In units of the step's length; the length of the last step of a path is
    // that to the End time.
    double    low = 0., high = before.next_step, low_time = before.time;
    const int n_halvings = 40;
    bool      is_found   = false;
    for (int k = 0; k < n_halvings; ++k)
      {
        double  end = before.time;
        Attempt attempt;
        // At the point itself the tangent may be singular.
        for (const double share : {0.5, 0.45, 0.6})
          if (!attempt.result.converged)
            {
              trial.next_step = (1. - share) * low + share * high;
              attempt         = arc_step(trial, end);
            }
        if (!attempt.result.converged)
          break;
        const unsigned int n = attempt.result.last.n_negative_pivots;
        if (n == point.n_before)
          {
            low      = trial.next_step;
            low_time = end;
          }
        else
          {
            high                    = trial.next_step;
            point.n_after           = n;
            point.state.motion      = std::move(attempt.motion);
            point.state.time        = end;
            point.state.load_factor = system_.load_factor();
          }
        is_found =
          std::abs(point.state.time - low_time) <= 1e-6 * std::abs(low_time) &&
          high - low <= 1e-4 * before.next_step;
        if (is_found)
          break;
      }
    const bool         is_limit  = rises(before) != rises(point.state);
    const unsigned int n_changes = std::max(point.n_before, point.n_after) -
                                   std::min(point.n_before, point.n_after);
    point.kind = !is_limit      ? "bifurcation" :
                 n_changes == 1 ? "limit" :
                                  "limit and bifurcation";
    if (!is_found)
      point.kind += " (not pinpointed)";
    return point;
  }

  PathAnalysis::Vector
  PathAnalysis::lowest_mode(const PathState &state)
  {
    const MassTerms mass(system_.discretization());
    Vector          du = system_.owned_vector();
    system_.set_time(state.time);
    const auto step = system_.solve_linearised(state.motion.u, du);
    AssertThrow(step.failure.kind == FailureKind::none,
                ExcMessage(step.failure.text));
    // Any vector that has a part of each mode.
    Vector mode = system_.interpolate([this](const Point<spacedim> &x) {
      Tensor<1, spacedim> value;
      for (unsigned int c = 0; c < spacedim; ++c)
        value[c] =
          std::sin((7.3 * x[0] + 5.1 * x[1] + 6.7 * x[2]) / system_.size() + c);
      return value;
    });
    system_.improve_mode(mass, 10, mode);
    double largest = 0.;
    for (const double entry : mode)
      if (std::abs(entry) > std::abs(largest))
        largest = entry;
    for (const double other :
         Utilities::MPI::all_gather(system_.discretization().communicator(),
                                    largest))
      if (std::abs(other) > std::abs(largest))
        largest = other;
    mode /= largest;
    return mode;
  }

  bool
  PathAnalysis::rises(const PathState &state)
  {
    system_.set_time(state.time);
    Vector     du   = system_.owned_vector();
    const auto step = system_.solve_linearised(state.motion.u, du);
    return step.failure.kind != FailureKind::none ||
           system_.rate(state.motion.u, state.time, rate_step()).velocity *
               state.motion.v >
             0.;
  }

  PathAnalysis::Attempt
  PathAnalysis::arc_step(const PathState &state,
                         double          &end,
                         const Vector    *mode)
  {
    const Vector &tangent    = state.motion.v;
    const double  speed      = tangent.l2_norm();
    auto          parameters = parameters_.newton;
    parameters.max_increment = 100. * system_.size();
    ArcLengthStep step(system_,
                       state.motion.u,
                       state.time,
                       tangent,
                       speed > 0. ? state.next_step * speed : state.next_step,
                       rate_step());
    if (mode != nullptr)
      {
        Vector predictor(*mode);
        predictor *= state.next_step / parameters_.time_step;
        step.set_predictor(predictor);
      }
    Attempt attempt{step.solve(parameters), state.motion};
    if (!attempt.result.converged)
      return attempt;
    attempt.motion.u = step.displacement();
    // The secant tells the side of the next step.
    Vector &next = attempt.motion.v;
    next         = step.displacement();
    next -= state.motion.u;
    next *=
      (speed > 0. ? speed : step.predictor().l2_norm() / state.next_step) /
      next.l2_norm();
    end = step.time();
    check_state(attempt, &state);
    return attempt;
  }

  PathAnalysis::Attempt
  PathAnalysis::last_arc_step(const PathState &state,
                              const Attempt   &attempt,
                              const double     end)
  {
    PathState guess(state);
    // Between both states, nearer than either.
    guess.motion.u.sadd(0.5, 0.5, attempt.motion.u);
    guess.motion.v = attempt.motion.v;
    return static_step(guess, end - state.time, false);
  }

  PathAnalysis::Attempt
  PathAnalysis::try_searches(const PathState &state, const double dt)
  {
    const bool search  = (parameters_.line_search == LineSearch::always);
    Attempt    attempt = try_step(state, dt, search);
    if (!attempt.result.converged &&
        parameters_.line_search == LineSearch::automatic)
      {
        Attempt again = try_step(state, dt, true);
        if (again.result.converged)
          attempt = std::move(again);
      }
    return attempt;
  }

  PathAnalysis::Attempt
  PathAnalysis::try_step(const PathState &state,
                         const double     dt,
                         const bool       line_search)
  {
    Attempt attempt = parameters_.is_dynamic() ?
                        dynamic_step(state, dt, line_search) :
                        static_step(state, dt, line_search);
    if (attempt.result.converged)
      {
        if (parameters_.is_dynamic())
          {
            // Not a time of the step's equation, but of its results: loads
            // must be defined there.
            system_.set_load_time(state.time + dt);
            system_.work(attempt.motion.u, attempt.motion.u);
          }
        check_state(attempt, &state);
      }
    const bool unstable =
      !attempt.result.converged || attempt.result.last.n_negative_pivots > 0;
    if (parameters_.type == AnalysisType::relaxation && unstable)
      {
        attempt = relax(state, dt);
        // It jumps: only the state itself can be impossible.
        if (attempt.result.converged)
          check_state(attempt, nullptr);
      }
    if (!attempt.result.converged &&
        (attempt.result.kind == FailureKind::no_convergence ||
         attempt.result.kind == FailureKind::no_stable_state))
      {
        std::ostringstream where;
        where << attempt.result.reason << "; the last increment is largest at ("
              << system_.position_of_last_increment()
              << ") of the undeformed surface";
        attempt.result.reason = where.str();
      }
    return attempt;
  }

  void
  PathAnalysis::check_state(Attempt &attempt, const PathState *before) const
  {
    const Vector u              = system_.with_ghosts(attempt.motion.u);
    auto        &reason         = attempt.result.reason;
    const auto  &discretization = system_.discretization();
    const double allowed_bend =
      parameters_.is_dynamic() ? largest_bend_in_motions : largest_bend;
    reason =
      before != nullptr ?
        find_impossible_deformation(discretization,
                                    system_.with_ghosts(before->motion.u),
                                    u,
                                    allowed_bend) :
        find_impossible_state(discretization, u, allowed_bend);
    const double allowed_gap =
      parameters_.is_dynamic() ? 0.75 * numbers::PI : 0.5 * numbers::PI;
    if (reason.empty())
      reason = find_torn_edge(system_.assembly(),
                              u,
                              system_.actions().rotations,
                              allowed_gap);
    attempt.result.converged = reason.empty();
    attempt.result.kind      = FailureKind::impossible_deformation;
  }

  PathAnalysis::Attempt
  PathAnalysis::static_step(const PathState &state,
                            const double     dt,
                            const bool       search)
  {
    system_.set_time(state.time + dt);
    system_.keep_tangent(parameters_.keeps_tangent());
    auto parameters          = parameters_.newton;
    parameters.max_increment = 100. * system_.size();
    const NewtonSolver newton(parameters);
    Attempt            attempt{{}, state.motion};
    const auto         linearise = [&](const Vector &u, Vector &du) {
      return system_.solve_linearised(u, du);
    };
    NewtonSolver::Work work;
    if (search)
      work = [&](const Vector &u, const Vector &du) {
        return system_.work(u, du);
      };
    attempt.result = newton.solve(attempt.motion.u, linearise, work);
    return attempt;
  }

  PathAnalysis::Attempt
  PathAnalysis::dynamic_step(const PathState &state,
                             const double     dt,
                             const bool       search)
  {
    DynamicStep step(system_,
                     *mass_,
                     integrator_,
                     parameters_,
                     state.motion,
                     state.time,
                     dt);
    Attempt     attempt{step.solve(search), step.end()};
    if (attempt.result.converged)
      attempt.balance = step.balance(*ledger_, state.balance, attempt.motion);
    return attempt;
  }

  std::string
  PathAnalysis::find_energy_gain(const EnergyBalance &balance) const
  {
    const double gain = balance.relative_gain();
    if (!balance.is_kept || gain <= 0.1)
      return "";
    std::ostringstream text;
    text << std::setprecision(3)
         << "the motion has gained an energy that nothing has put in, "
         << balance.gain() << " or " << 100. * gain
         << " % of the largest energy so far; 10 % are allowed. The state "
            "before is kept. Choose 'Analysis/Scheme = energy momentum', which "
            "conserves energy, or a smaller 'Analysis/Time step'.";
    return text.str();
  }

  PathAnalysis::Attempt
  PathAnalysis::relax(const PathState &state, const double dt)
  {
    system_.set_time(state.time + dt);
    system_.keep_tangent(false);
    Attempt    attempt{{}, state.motion};
    Relaxation relaxation(system_, *mass_, parameters_.newton);
    attempt.result = relaxation.run(attempt.motion.u);
    return attempt;
  }
} // namespace Nacre
