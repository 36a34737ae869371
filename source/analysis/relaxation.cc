// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/relaxation.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  namespace
  {
    /** How far the shift stays above the lowest eigenvalue's opposite. */
    constexpr double margin = 1.2;
    /** A push is as long as the energy falls by this share of its curvature. */
    constexpr double least_slope = 0.5;

    /** What a @p result says if it hasn't converged. */
    void
    describe_failure(NewtonSolver::Result &result)
    {
      result.kind   = FailureKind::no_stable_state;
      result.reason = "the dynamic relaxation found no stable state in " +
                      std::to_string(result.iterations) + " iterations";
      if (!result.last.failure.text.empty())
        result.reason += ", as " + result.last.failure.text;
    }
  } // namespace

  Relaxation::Relaxation(ShellSystem                    &system,
                         const MassTerms                &mass,
                         const NewtonSolver::Parameters &newton)
    : system_(system)
    , mass_(mass)
    , newton_(newton)
    , mode_(start_mode())
    , amplitude_(1e-3 * system.size())
  {}

  Relaxation::Vector
  Relaxation::start_mode() const
  {
    return system_.interpolate([this](const Point<spacedim> &x) {
      const Tensor<1, spacedim> k_1({7.3, 5.1, 6.7}), k_2({-13.9, 17.3, 21.1});
      const double              phase_1 = k_1 * x / system_.size();
      const double              phase_2 = k_2 * x / system_.size();
      Tensor<1, spacedim>       value;
      for (unsigned int c = 0; c < spacedim; ++c)
        value[c] = std::sin(phase_1 + c) + std::sin(phase_2 + 2. * c);
      return value;
    });
  }

  NewtonSolver::Result
  Relaxation::run(Vector &u)
  {
    const unsigned int max_iterations = 40 * newton_.max_iterations;
    least_shift_ = 1e-10 * system_.stiffness_to_mass(u, mass_);

    NewtonSolver::Result result;
    Vector               du             = system_.owned_vector();
    const Vector         rest           = system_.with_ghosts(du);
    double               largest_change = 0.;
    bool                 has_begun      = false;
    const auto          &step           = result.last;
    while (result.iterations < max_iterations)
      {
        const Inertia inertia{mass_, rest, shift_};
        system_.require_definite(has_begun && shift_ > 0.);
        result.last = system_.solve_linearised(u, u, du, &inertia, 1.);
        system_.require_definite(false);
        ++result.iterations;
        if (step.failure.kind == FailureKind::not_finite)
          break;
        const bool is_regular = (step.failure.kind == FailureKind::none);
        if (is_regular && !has_begun)
          {
            // It brings the prescribed displacements, whatever that takes.
            u += du;
            largest_change = du.linfty_norm();
            has_begun      = true;
            continue;
          }
        if (!is_regular || step.n_negative_pivots > 0)
          {
            raise_shift(du, step);
            continue;
          }
        const Part   part   = take_increment(u, du, step);
        const double change = part.factor * du.linfty_norm();
        largest_change      = std::max(largest_change, change);
        // Changes of a whole path: a step's tolerance would be too tight.
        const bool is_small =
          change <= 100. * newton_.increment_tolerance * largest_change ||
          std::abs(step.work) <= step.round_off_work;
        result.converged = part.factor == 1. && shift_ == 0. && is_small;
        system_.count_negative_eigenvalues(result);
        result.converged = result.converged && step.n_negative_pivots == 0;
        if (result.converged)
          break;
        if (shift_ == 0.)
          eigenvalue_ = 0.; // not known, and not needed
        else if (part.factor > 0.)
          push_along_mode(u, step);
        // What the linearisation says: (K du) . du = r . du - shift du . M du.
        adapt_shift(part,
                    shift_ == 0. ?
                      0. :
                      shift_ * system_.product(mass_, du, du) / step.work);
      }
    describe_failure(result);
    return result;
  }

  Relaxation::Part
  Relaxation::take_increment(Vector                   &u,
                             const Vector             &du,
                             const NewtonSolver::Step &step)
  {
    Part part;
    if (std::abs(step.work) <= step.round_off_work)
      {
        // The force at its end is noise: nothing can be told from it.
        u += du;
        return part;
      }
    const Vector start(u);
    if (du.linfty_norm() < system_.size())
      for (unsigned int trial = 0; trial < 5; ++trial)
        {
          u = start;
          u.add(part.factor, du);
          part.share = system_.work(u, du) / step.work;
          // Somewhat beyond the minimum the energy is still lower.
          if (std::isfinite(part.share) && part.share > -0.5)
            return part;
          const double to_minimum =
            std::isfinite(part.share) ? 1. / (1. - part.share) : 0.;
          part.factor *= std::min(0.5, std::max(0.1, to_minimum));
        }
    u           = start;
    part.factor = 0.;
    return part;
  }

  void
  Relaxation::raise_shift(const Vector &du, const NewtonSolver::Step &step)
  {
    double first = least_shift_;
    if (shift_ == 0. && std::abs(step.work) > step.round_off_work)
      first =
        std::max(first, std::abs(step.work) / system_.product(mass_, du, du));
    shift_      = std::max(4. * shift_, first);
    is_careful_ = true;
  }

  void
  Relaxation::adapt_shift(const Part &part, const double expected_share)
  {
    if (part.factor == 0.)
      shift_ = std::max(4. * shift_, least_shift_);
    else if (part.factor < 1.)
      shift_ = std::max((part.factor < 0.3 ? 4. : 1.) * shift_, least_shift_);
    else if (is_careful_)
      shift_ *= 0.7;
    else
      shift_ *= std::abs(part.share - expected_share) < 0.3 ? 0.25 : 0.5;
    shift_ = std::max(shift_, -margin * eigenvalue_);
    if (shift_ < least_shift_)
      shift_ = 0.;
    is_careful_ = part.factor < 1.;
  }

  void
  Relaxation::push_along_mode(Vector &u, const NewtonSolver::Step &step)
  {
    const double lowest = system_.improve_mode(mass_, has_mode_ ? 2 : 6, mode_);
    has_mode_           = true;
    eigenvalue_         = lowest - shift_;
    if (eigenvalue_ >= 0.)
      return;
    // Down the slope, if there is one; else where the first guess pointed, so
    // that round-off doesn't choose.
    const double force = system_.work(u, mode_);
    if (force < 0. && force * force > lowest * step.round_off_work)
      mode_ *= -1.;
    Vector     trial(u);
    const auto is_falling = [&](const double factor) {
      trial = u;
      trial.add(factor, mode_);
      return system_.work(trial, mode_) >= -least_slope * eigenvalue_ * factor;
    };
    const double peak   = mode_.linfty_norm();
    double       factor = amplitude_ / peak;
    if (is_falling(factor))
      while (2. * factor * peak < system_.size() && is_falling(2. * factor))
        factor *= 2.;
    else
      do
        factor *= 0.5;
      while (factor * peak > 1e-12 * system_.size() && !is_falling(factor));
    u.add(factor, mode_);
    amplitude_ = factor * peak;
  }
} // namespace Nacre
