// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/relaxation.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  Relaxation::Relaxation(ShellSystem                    &system,
                         const MassTerms                &mass,
                         const NewtonSolver::Parameters &newton)
    : system_(system)
    , mass_(mass)
    , newton_(newton)
  {}

  NewtonSolver::Result
  Relaxation::run(Vector &u)
  {
    const unsigned int max_iterations = 40 * newton_.max_iterations;
    const double       softest = 1e-10 * system_.stiffness_to_mass(u, mass_);

    NewtonSolver::Result result;
    Vector               du    = system_.owned_vector();
    const Vector         rest  = system_.with_ghosts(du);
    double               sigma = 0., largest_change = 0.;
    bool                 rejected   = false;
    auto                &iterations = result.iterations;
    auto                &step       = result.last;
    for (iterations = 0; iterations < max_iterations;)
      {
        const Inertia inertia{mass_, rest, sigma};
        step = system_.solve_linearised(u, u, du, &inertia, 1.);
        ++iterations;
        // The first increment brings the prescribed displacements.
        const bool first = (iterations == 1);
        bool       good  = first || step.n_negative_pivots == 0;
        double     share = 1.;
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
        result.converged =
          !first && sigma == 0. &&
          du.linfty_norm() <=
            100. * newton_.increment_tolerance * largest_change;
        if (result.converged)
          break;
        // Longer steps, carefully where a longer one has just failed.
        sigma *= rejected ? 0.7 : 0.25;
        rejected = false;
        if (sigma < softest)
          sigma = 0.;
      }
    result.reason = "the dynamic relaxation found no stable state in " +
                    std::to_string(iterations) + " iterations";
    return result;
  }
} // namespace Nacre
