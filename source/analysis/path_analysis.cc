// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/analysis/dynamic_step.h>
#include <nacre/analysis/path_analysis.h>
#include <nacre/analysis/path_failure.h>
#include <nacre/analysis/relaxation.h>
#include <nacre/base/mpi_errors.h>

#include <algorithm>
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
  PathAnalysis::run(PathState       &state,
                    const Observer  &observer,
                    const Messenger &messenger)
  {
    if (state.step == 0)
      observer(state);
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
            messenger(text.str() + "; trying half the step");
            continue;
          }
        const std::string gain = find_energy_gain(attempt.balance);
        if (!gain.empty())
          return text.str() + gain;
        ++state.step;
        state.time              = end;
        state.motion            = std::move(attempt.motion);
        state.balance           = attempt.balance;
        state.load_factor       = system_.load_factor();
        state.iterations        = attempt.result.iterations;
        state.residual          = attempt.result.last.residual;
        state.n_negative_pivots = attempt.result.last.n_negative_pivots;
        step_control_.accept(state, state.iterations);
        observer(state);
      }
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
      reason = find_torn_edge(system_.shell_operator(),
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
