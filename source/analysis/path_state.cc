// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/analysis/path_state.h>

#include <utility>

namespace Nacre
{
  void
  PathAttempt::accept(const ShellSystem &system, PathState &state) &&
  {
    state.motion            = std::move(motion);
    state.balance           = balance;
    state.load_factor       = system.load_factor();
    state.iterations        = result.iterations;
    state.residual          = result.last.residual;
    state.n_negative_pivots = result.last.n_negative_pivots;
  }

  void
  PathAttempt::check(const ShellSystem &system,
                     const bool         is_dynamic,
                     const PathState   *before)
  {
    const auto   u              = system.with_ghosts(motion.u);
    const auto  &discretization = system.discretization();
    const double allowed_bend =
      is_dynamic ? largest_bend_in_motions : largest_bend;
    result.reason =
      before != nullptr ?
        find_impossible_deformation(discretization,
                                    system.with_ghosts(before->motion.u),
                                    u,
                                    allowed_bend) :
        find_impossible_state(discretization, u, allowed_bend);
    const double allowed_gap =
      is_dynamic ? 0.75 * numbers::PI : 0.5 * numbers::PI;
    if (result.reason.empty())
      result.reason = find_torn_edge(system.assembly(),
                                     u,
                                     system.actions().rotations,
                                     allowed_gap);
    result.converged = result.reason.empty();
    result.kind      = FailureKind::impossible_deformation;
  }

  PathAttempt
  find_equilibrium(const PathParameters &parameters,
                   ShellSystem          &system,
                   const PathState      &guess,
                   const double          time,
                   const bool            line_search)
  {
    using Vector = ShellSystem::Vector;
    system.set_time(time);
    system.keep_tangent(parameters.keeps_tangent());
    auto newton          = parameters.newton;
    newton.max_increment = 100. * system.size();
    PathAttempt        attempt{{}, guess.motion};
    NewtonSolver::Work work;
    if (line_search)
      work = [&](const Vector &u, const Vector &du) {
        return system.work(u, du);
      };
    attempt.result = NewtonSolver(newton).solve(
      attempt.motion.u,
      [&](const Vector &u, Vector &du) {
        auto step = system.solve_linearised(u, du);
        // The energy isn't convex here: a minimum is for the relaxation to
        // find, and Newton's method would wander, or end in a saddle.
        if (parameters.type == AnalysisType::relaxation &&
            step.n_negative_pivots > 0)
          step.failure = {FailureKind::no_stable_state,
                          "the tangent has negative eigenvalues"};
        return step;
      },
      work);
    system.count_negative_eigenvalues(attempt.result);
    return attempt;
  }
} // namespace Nacre
