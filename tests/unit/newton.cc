// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Newton's method on one equation: convergence, line search, failures.

#include "unit_test.h"
#include <nacre/solvers/newton_solver.h>

#include <deal.II/base/index_set.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace Nacre;
using namespace dealii;

namespace
{
  using Function = std::function<double(double)>;

  /** r(u) = 0 with the derivative k(u). */
  struct Equation
  {
    Function r, k;
    /** Of all steps. */
    double round_off_work = 0.;

    NewtonSolver::Step
    linearise(const NewtonSolver::Vector &u, NewtonSolver::Vector &du) const
    {
      NewtonSolver::Step step;
      du(0)               = -r(u(0)) / k(u(0));
      step.residual       = std::abs(r(u(0)));
      step.work           = -r(u(0)) * du(0);
      step.round_off_work = round_off_work;
      return step;
    }

    double
    work(const NewtonSolver::Vector &u, const NewtonSolver::Vector &du) const
    {
      return -r(u(0)) * du(0);
    }
  };

  NewtonSolver::Vector
  start_at(const double u)
  {
    NewtonSolver::Vector start(complete_index_set(1), MPI_COMM_WORLD);
    start(0) = u;
    return start;
  }

  NewtonSolver::Result
  solve(const Equation                 &equation,
        NewtonSolver::Vector           &u,
        const bool                      with_search,
        const NewtonSolver::Parameters &parameters = {})
  {
    const auto linearise = [&](const auto &v, auto &dv) {
      return equation.linearise(v, dv);
    };
    NewtonSolver::Work work;
    if (with_search)
      work = [&](const auto &v, const auto &dv) {
        return equation.work(v, dv);
      };
    return NewtonSolver(parameters).solve(u, linearise, work);
  }

  const Equation cubic{[](double u) { return u * u * u - 8.; },
                       [](double u) { return 3. * u * u; }};
  /** Newton's method alone diverges from |u| > 1.39. */
  const Equation arctangent{[](double u) { return std::atan(u); },
                            [](double u) { return 1. / (1. + u * u); }};
} // namespace

BOOST_AUTO_TEST_SUITE(newton)

BOOST_AUTO_TEST_CASE(converges_quadratically)
{
  auto       u      = start_at(3.);
  const auto result = solve(cubic, u, false);
  BOOST_TEST(result.converged);
  BOOST_TEST(result.iterations <= 7);
  BOOST_TEST(std::abs(u(0) - 2.) < 1e-14);
  BOOST_TEST(result.first_residual == 19.);
}

BOOST_AUTO_TEST_CASE(line_search_saves_the_arctangent)
{
  auto alone = start_at(3.);
  BOOST_TEST(!solve(arctangent, alone, false).converged);
  auto       searched = start_at(3.);
  const auto result   = solve(arctangent, searched, true);
  BOOST_TEST(result.converged);
  BOOST_TEST(std::abs(searched(0)) < 1e-8);
}

BOOST_AUTO_TEST_CASE(damping_shortens_increments)
{
  NewtonSolver::Parameters parameters;
  parameters.damping        = 0.5;
  parameters.max_iterations = 1;
  auto u                    = start_at(3.);
  solve(cubic, u, false, parameters);
  BOOST_TEST(std::abs(u(0) - (3. - 0.5 * 19. / 27.)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(failures_have_reasons)
{
  NewtonSolver::Parameters parameters;
  parameters.max_increment = 0.5;
  auto       u             = start_at(3.);
  const auto diverged      = solve(cubic, u, false, parameters);
  BOOST_TEST(!diverged.converged);
  BOOST_TEST(UnitTests::holds(diverged.reason, "iteration 1"));

  parameters                = {};
  parameters.max_iterations = 2;
  u                         = start_at(3.);
  const auto slow           = solve(cubic, u, false, parameters);
  BOOST_TEST(!slow.converged);
  BOOST_TEST(UnitTests::holds(slow.reason, "no convergence in 2"));

  const Equation broken{[](double) {
                          return std::numeric_limits<double>::quiet_NaN();
                        },
                        [](double) { return 1.; }};
  u = start_at(3.);
  BOOST_TEST(!solve(broken, u, false).converged);
}

BOOST_AUTO_TEST_CASE(round_off_ends_the_iteration)
{
  // Residuals of 1e-12 that no increment removes.
  Equation noise{[](double u) { return u > 0. ? 1e-12 : -1e-12; },
                 [](double) { return 1.; }};
  auto     u = start_at(1e-12);
  BOOST_TEST(!solve(noise, u, true).converged);
  noise.round_off_work = 1e-23;
  u                    = start_at(1e-12);
  BOOST_TEST(solve(noise, u, true).converged);
}

BOOST_AUTO_TEST_SUITE_END()
