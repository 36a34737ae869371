// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// When Newton's method stops: a spring r(u) = k (u + u^2) - f, the residual of
// which has an error that never vanishes.

#include "../tests_common.h"
#include <nacre/solvers/newton_solver.h>

using namespace Tests;

constexpr double k        = 1e6;
constexpr double solution = 0.1;
/** The error of the residual, and the work that it does on its answer. */
constexpr double noise          = 1e-9;
constexpr double round_off_work = 10. * noise * noise / k;

/** Iterate from @p u, which it changes; the error has a new sign each time. */
NewtonSolver::Result
solve(double &u, const double known_round_off_work)
{
  TrilinosVector vector(complete_index_set(1), MPI_COMM_SELF);
  vector          = u;
  double     sign = 1.;
  const auto step = [&](const TrilinosVector &at, TrilinosVector &du) {
    sign           = -sign;
    const double x = at(0);
    const double r =
      k * (x + x * x) - k * (solution + solution * solution) + sign * noise;
    du = -r / (k * (1. + 2. * x));
    return NewtonSolver::Step{std::abs(r),
                              -r * du(0),
                              known_round_off_work,
                              0,
                              {}};
  };
  const auto result =
    NewtonSolver(NewtonSolver::Parameters()).solve(vector, step);
  u = vector(0);
  return result;
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  double                                 u = solution;
  check_below("held: iterations", solve(u, round_off_work).iterations, 2);
  check_below("held: error", std::abs(u - solution), 2. * noise / k);
  u = solution;
  check_below("round-off unknown: convergence", solve(u, 0.).converged, 1);
  // As small as these, a step is still a step.
  for (const double change : {1e-2, 1e-6, 1e-10, 1e-14})
    {
      u                 = solution + change;
      const auto result = solve(u, round_off_work);
      check_above("small step: convergence", result.converged, 0);
      check_above("small step: iterations", result.iterations, 1);
      check_below("small step: error", std::abs(u - solution), 2. * noise / k);
    }
  return n_failures == 0 ? 0 : 1;
}
