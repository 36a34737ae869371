// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

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
    if (parameters.follows_curve())
      curve_.emplace(parameters, system);
  }

  PathState
  PathAnalysis::initial_state(const MotionState *start) const
  {
    PathState state;
    state.next_step = parameters_.first_step();
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
    const Vector w =
      system_.with_ghosts(inertial_acceleration(motion)); // a is zero
    motion.a = system_.acceleration(motion.u, Inertia(*mass_, w, 0.), *mass_);
    state.balance = ledger_->start(motion, parameters_.time_step);
    return state;
  }

  std::string
  PathAnalysis::run(PathState &state, const PathCallbacks &callbacks)
  {
    if (state.step == 0)
      {
        const std::string failure =
          curve_ && state.branch == 0 ? curve_->settle(state) : "";
        if (!failure.empty())
          return "the start has no equilibrium nearby at t = 0: " + failure +
                 ". " + remedy(FailureKind::no_convergence, parameters_);
        system_.accept_step(state.motion.u, state.time);
        callbacks.observe(state);
      }
    if (curve_)
      return curve_->follow(state, callbacks);
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
        std::move(attempt).accept(system_, state);
        system_.accept_step(state.motion.u, state.time);
        step_control_.accept(state, state.iterations);
        if (callbacks.pauses && callbacks.pauses(state))
          return "";
        callbacks.observe(state);
        if (callbacks.ends && callbacks.ends(state))
          return "";
      }
    return "";
  }

  std::string
  PathAnalysis::settle(PathState &state)
  {
    Assert(!parameters_.is_dynamic(), ExcInternalError());
    std::string failure;
    if (curve_)
      failure = curve_->resume(state);
    else if (Attempt attempt = try_searches(state, 0.);
             attempt.result.converged)
      std::move(attempt).accept(system_, state);
    else
      failure = attempt.result.reason;
    if (failure.empty())
      system_.accept_step(state.motion.u, state.time);
    return failure;
  }

  PathAnalysis::Vector
  PathAnalysis::inertial_acceleration(const MotionState &motion) const
  {
    Vector w(motion.a);
    w.add(parameters_.mass_damping, motion.v);
    return w;
  }

  Inertia
  PathAnalysis::inertia_at(const Vector &w, const StepStart &start) const
  {
    const bool conserves = (parameters_.scheme == TimeScheme::energy_momentum);
    return {*mass_, w, 0., conserves ? &start : nullptr};
  }

  void
  PathAnalysis::balance_acceleration(PathState &state)
  {
    MotionState &motion = state.motion;
    system_.set_time(state.time);
    // What is out of balance alone: supports may have accelerations.
    const Vector    w     = system_.with_ghosts(inertial_acceleration(motion));
    const StepStart start = system_.step_start(motion.u);
    motion.a += system_.acceleration(motion.u, inertia_at(w, start), *mass_);
  }

  std::string
  PathAnalysis::resume(PathState &state, const double duration)
  {
    if (!parameters_.is_dynamic())
      return settle(state);
    system_.set_time(state.time);
    if (duration > 0.)
      {
        const Vector w =
          system_.with_ghosts(inertial_acceleration(state.motion));
        const StepStart start = system_.step_start(state.motion.u);
        system_.hold(state.motion.u, inertia_at(w, start), duration);
      }
    state.balance =
      ledger_->after_cut(state.balance, state.motion, parameters_.time_step);
    return "";
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
                        find_equilibrium(parameters_,
                                         system_,
                                         state,
                                         state.time + dt,
                                         line_search);
    if (attempt.result.converged)
      {
        if (parameters_.is_dynamic())
          {
            // Not a time of the step's equation, but of its results: loads
            // must be defined there.
            system_.set_load_time(state.time + dt);
            const double work =
              system_.work(attempt.motion.u, attempt.motion.u);
            attempt.result.converged = std::isfinite(work);
          }
        if (attempt.result.converged)
          attempt.check(system_, parameters_.is_dynamic(), &state);
        else
          {
            attempt.result.kind = FailureKind::not_finite;
            attempt.result.reason =
              "the internal forces at its end are infinite or not a number";
          }
      }
    const bool unstable =
      !attempt.result.converged || attempt.result.last.n_negative_pivots > 0;
    if (parameters_.type == AnalysisType::relaxation && unstable)
      {
        attempt = relax(state, dt);
        // It jumps: only the state itself can be impossible.
        if (attempt.result.converged)
          attempt.check(system_, false, nullptr);
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
