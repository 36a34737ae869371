// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/analysis/path_analysis.h>
#include <nacre/analysis/path_failure.h>
#include <nacre/base/mpi_errors.h>

#include <algorithm>
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
  {
    if (parameters.type == AnalysisType::dynamic)
      mass_.emplace(system.discretization(), section);
    else if (parameters.type == AnalysisType::relaxation)
      mass_.emplace(system.discretization());
  }

  PathState
  PathAnalysis::initial_state() const
  {
    PathState state;
    state.next_step = parameters_.time_step;
    system_.set_time(0.);
    state.load_factor   = system_.load_factor();
    MotionState &motion = state.motion;
    motion.u            = system_.owned_vector();
    motion.v            = motion.u;
    motion.a            = motion.u;
    if (parameters_.type != AnalysisType::dynamic)
      return state;

    motion.u = system_.interpolate(parameters_.initial_displacement);
    motion.v = system_.interpolate(parameters_.initial_velocity);
    system_.constraints().distribute(motion.u);
    motion.a = system_.acceleration(motion.u,
                                    motion.v,
                                    parameters_.mass_damping,
                                    *mass_);
    return state;
  }

  std::string
  PathAnalysis::run(PathState       &state,
                    const Observer  &observer,
                    const Messenger &messenger)
  {
    if (state.step == 0)
      observer(state);
    const double end       = parameters_.end_time;
    const double tolerance = 1e-10 * parameters_.time_step;
    while (state.time < end - tolerance)
      {
        // The last two steps share what is left.
        const double left = end - state.time;
        double       dt   = std::min(state.next_step, left);
        if (dt < left && left - dt < 1e-3 * dt)
          dt = left;
        std::ostringstream text, kept;
        text << "step " << state.step + 1 << " to t = " << state.time + dt
             << ": ";
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
            state.next_step    = 0.5 * dt;
            state.n_good_steps = 0;
            text << attempt.result.reason;
            if (state.next_step < parameters_.minimum_time_step)
              return text.str() + "." + kept.str() + " " +
                     remedy(attempt.result.kind, parameters_.type);
            messenger(text.str() + "; trying half the step");
            continue;
          }
        ++state.step;
        state.time   = std::abs(left - dt) <= tolerance ? end : state.time + dt;
        state.motion = std::move(attempt.motion);
        state.load_factor       = system_.load_factor();
        state.iterations        = attempt.result.iterations;
        state.residual          = attempt.result.last.residual;
        state.n_negative_pivots = attempt.result.last.n_negative_pivots;
        adapt_step(state, attempt);
        observer(state);
      }
    return "";
  }

  void
  PathAnalysis::adapt_step(PathState &state, const Attempt &attempt) const
  {
    const double growth = 2.;
    if (attempt.result.iterations > parameters_.newton.max_iterations / 2)
      state.n_good_steps = 0;
    else
      ++state.n_good_steps;
    if (state.n_good_steps >= 2 &&
        state.next_step < parameters_.maximum_time_step)
      {
        state.next_step =
          std::min(growth * state.next_step, parameters_.maximum_time_step);
        state.n_good_steps = 0;
      }
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
    Attempt attempt = parameters_.type == AnalysisType::dynamic ?
                        dynamic_step(state, dt, line_search) :
                        static_step(state, dt, line_search);
    if (attempt.result.converged)
      {
        if (parameters_.type == AnalysisType::dynamic)
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
    reason =
      before != nullptr ?
        find_impossible_deformation(discretization,
                                    system_.with_ghosts(before->motion.u),
                                    u) :
        find_impossible_state(discretization, u);
    if (reason.empty())
      reason = find_torn_edge(system_.shell_operator(), u);
    attempt.result.converged = reason.empty();
    attempt.result.kind      = FailureKind::impossible_deformation;
  }

  PathAnalysis::Attempt
  PathAnalysis::static_step(const PathState &state,
                            const double     dt,
                            const bool       search)
  {
    system_.set_time(state.time + dt);
    system_.keep_tangent(parameters_.keeps_tangent);
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
    const MotionState &start = state.motion;
    system_.set_time(state.time + dt);
    system_.keep_tangent(parameters_.keeps_tangent);
    auto parameters          = parameters_.newton;
    parameters.max_increment = 100. * system_.size();
    const NewtonSolver newton(parameters);
    // The loads are those of t_f, the constraints those of the end.
    system_.set_load_time(integrator_.force_time(state.time, dt));

    const auto inertia = [&](const Vector &u_f) {
      return system_.with_ghosts(integrator_.inertia(start, u_f, dt));
    };
    const double factor    = integrator_.inertia_factor(dt);
    const auto   linearise = [&](const Vector &u_f, Vector &du) {
      const Vector  w = inertia(u_f);
      const Inertia terms{*mass_, w, factor};
      return system_.solve_linearised(u_f,
                                      integrator_.end_displacement(start, u_f),
                                      du,
                                      &terms,
                                      integrator_.share());
    };
    NewtonSolver::Work work;
    if (search)
      work = [&](const Vector &u_f, const Vector &du) {
        const Vector  w = inertia(u_f);
        const Inertia terms{*mass_, w, factor};
        return system_.work(u_f, du, &terms);
      };
    // Start where a constant velocity would lead.
    Vector u_f = start.u;
    u_f.add(integrator_.share() * dt, start.v);
    Attempt attempt{newton.solve(u_f, linearise, work), {}};
    attempt.motion = integrator_.end_state(start, u_f, dt);
    return attempt;
  }

  PathAnalysis::Attempt
  PathAnalysis::relax(const PathState &state, const double dt)
  {
    system_.set_time(state.time + dt);
    system_.keep_tangent(false);
    const unsigned int max_iterations = 40 * parameters_.newton.max_iterations;
    const double       softest =
      1e-10 * system_.stiffness_to_mass(state.motion.u, *mass_);

    Attempt      attempt{{}, state.motion};
    Vector      &u     = attempt.motion.u;
    Vector       du    = system_.owned_vector();
    const Vector rest  = system_.with_ghosts(du);
    double       sigma = 0., largest_change = 0.;
    bool         rejected   = false;
    auto        &iterations = attempt.result.iterations;
    auto        &step       = attempt.result.last;
    for (iterations = 0; iterations < max_iterations;)
      {
        const Inertia inertia{*mass_, rest, sigma};
        step = system_.solve_linearised(u, u, du, &inertia, 1.);
        ++iterations;
        // The first increment brings the prescribed displacements.
        const bool first  = (iterations == 1);
        const bool solved = (step.failure.kind == FailureKind::none);
        if (step.failure.kind == FailureKind::not_finite)
          break;
        bool   good  = solved && (first || step.n_negative_pivots == 0);
        double share = 1.;
        if (good && !first)
          {
            Vector trial(u);
            trial += du;
            share = system_.work(trial, du) / step.work;
            good  = std::isfinite(share) && share > -0.5 &&
                   du.linfty_norm() < system_.size();
          }
        if (!good)
          {
            sigma    = std::max(4. * sigma, softest);
            rejected = true;
            continue;
          }
        u += du;
        largest_change = std::max(largest_change, du.linfty_norm());
        // Changes of a whole path: a step's tolerance would be too tight.
        attempt.result.converged =
          !first && sigma == 0. &&
          du.linfty_norm() <=
            100. * parameters_.newton.increment_tolerance * largest_change;
        if (attempt.result.converged)
          break;
        // Longer steps, carefully where a longer one has just failed.
        sigma *= rejected ? 0.7 : 0.25;
        rejected = false;
        if (sigma < softest)
          sigma = 0.;
      }
    attempt.result.kind   = FailureKind::no_stable_state;
    attempt.result.reason = "the dynamic relaxation found no stable state in " +
                            std::to_string(iterations) + " iterations";
    if (!step.failure.text.empty())
      attempt.result.reason += ", as " + step.failure.text;
    return attempt;
  }
} // namespace Nacre
