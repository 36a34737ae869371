// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/arc_length_step.h>

#include <cmath>

namespace Nacre
{
  ArcLengthStep::ArcLengthStep(ShellSystem  &system,
                               const Vector &u,
                               const double  time,
                               const Vector &direction,
                               const double  length,
                               const double  rate_step)
    : system_(system)
    , start_(u)
    , start_time_(time)
    , direction_(direction)
    , length_(length)
    , rate_step_(rate_step)
    , u_(u)
    , time_(time)
  {}

  void
  ArcLengthStep::set_predictor(const Vector &predictor)
  {
    // At the point itself the tangent is singular.
    predictor_     = predictor;
    has_predictor_ = true;
    u_ += predictor;
  }

  NewtonSolver::Result
  ArcLengthStep::solve(const NewtonSolver::Parameters &parameters)
  {
    system_.keep_tangent(false);
    system_.set_time(start_time_);
    auto result =
      NewtonSolver(parameters).solve(u_, [&](const Vector &u, Vector &du) {
        return linearise(u, du);
      });
    if (!result.converged)
      return result;
    Vector change(u_);
    change -= start_;
    const double norms = change.l2_norm() * predictor_.l2_norm();
    if (change * predictor_ < 0.5 * norms)
      {
        result.converged = false;
        result.kind      = FailureKind::no_convergence;
        result.reason = "the path turns by more than 60 degrees within a step";
      }
    return result;
  }

  NewtonSolver::Step
  ArcLengthStep::linearise(const Vector &u, Vector &du)
  {
    NewtonSolver::Step step = system_.solve_linearised(u, du);
    if (step.failure.kind != FailureKind::none)
      return step;
    const ShellSystem::Rate rate     = system_.rate(u, time_, rate_step_);
    const Vector           &velocity = rate.velocity;
    double                  dt       = 0.;
    if (!has_predictor_)
      {
        const double norm = velocity.l2_norm();
        AssertThrow(norm > 0.,
                    ExcMessage("Analysis/Type = arc length: nothing moves the "
                               "shell: no load and no prescribed displacement "
                               "depends on t."));
        dt         = direction_.l2_norm() == 0. ? length_ :
                     direction_ * velocity > 0. ? length_ / norm :
                                                  -length_ / norm;
        predictor_ = velocity;
        predictor_ *= dt;
        has_predictor_ = true;
        // The residual is that of equilibrium: what later ones compare with is
        // the work of the step's loads.
        step.work           = dt * dt * rate.work;
        step.round_off_work = 0.;
      }
    else
      dt = -(predictor_ * du) / (predictor_ * velocity);
    if (!std::isfinite(dt))
      {
        step.failure = {FailureKind::singular_tangent,
                        "the path has no tangent to working precision"};
        return step;
      }
    du.add(dt, velocity);
    time_ += dt;
    system_.set_time(time_);
    return step;
  }
} // namespace Nacre
