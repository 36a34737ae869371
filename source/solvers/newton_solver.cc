// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/newton_solver.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Nacre
{
  NewtonSolver::NewtonSolver(const Parameters &parameters)
    : parameters_(parameters)
  {}

  namespace
  {
    /** Whether there are forces at u + du. */
    bool
    is_possible(const NewtonSolver::Vector &u,
                const NewtonSolver::Vector &du,
                const NewtonSolver::Work   &work)
    {
      NewtonSolver::Vector trial(u);
      trial += du;
      return std::isfinite(work(trial, du));
    }
  } // namespace

  double
  NewtonSolver::search(const Vector &u,
                       const Vector &du,
                       const double  initial_work,
                       const Work   &work)
  {
    // Bracket and bisect the zero of g(s) = -r(u + s du) . du, loosely.
    double low = 0., high = 1., g_low = initial_work;
    double best = 1.;
    Vector trial(u);
    for (unsigned int k = 0; k < 8; ++k)
      {
        trial = u;
        trial.add(best, du);
        const double g = work(trial, du);
        if (std::isfinite(g) && std::abs(g) <= 0.8 * std::abs(initial_work))
          return best;
        if (std::isfinite(g) && g * g_low > 0.)
          {
            if (best >= 1.)
              return 1.; // Still descending: a longer step is not taken.
            low   = best;
            g_low = g;
          }
        else
          high = best;
        best = 0.5 * (low + high);
      }
    return best;
  }

  NewtonSolver::Result
  NewtonSolver::solve(Vector          &u,
                      const Linearise &linearise,
                      const Work      &work) const
  {
    Result       result;
    const Vector start(u);
    Vector       du(u);
    double       largest_change = 0., largest_work = 0.;
    for (unsigned int k = 0; k < parameters_.max_iterations; ++k)
      {
        result.last = linearise(u, du);
        if (k == 0)
          result.first_residual = result.last.residual;
        ++result.iterations;
        if (result.last.failure.kind != FailureKind::none)
          {
            result.kind   = result.last.failure.kind;
            result.reason = result.last.failure.text;
            return result;
          }
        const double increment = du.linfty_norm();
        const double energy    = std::abs(result.last.work);
        if (!std::isfinite(increment + energy) ||
            increment > parameters_.max_increment)
          {
            std::ostringstream reason;
            reason << "diverged in iteration " << result.iterations
                   << ": an increment of " << increment;
            result.reason = reason.str();
            return result;
          }
        double factor = parameters_.damping;
        if (work && energy > result.last.round_off_work &&
            (k > 0 || !is_possible(u, du, work)))
          factor *= search(u, du, result.last.work, work);
        u.add(factor, du);

        Vector change(u);
        change -= start;
        largest_change = std::max(
          {largest_change, change.linfty_norm(), k == 0 ? increment : 0.});
        largest_work = std::max(largest_work, energy);
        if (factor * increment <=
              parameters_.increment_tolerance * factor * largest_change ||
            energy <= parameters_.energy_tolerance * largest_work ||
            energy <= result.last.round_off_work)
          {
            result.converged = true;
            return result;
          }
      }
    std::ostringstream reason;
    reason << "no convergence in " << result.iterations
           << " iterations (last increment " << du.linfty_norm() << ")";
    result.reason = reason.str();
    return result;
  }
} // namespace Nacre
