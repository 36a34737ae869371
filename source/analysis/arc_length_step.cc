// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/arc_length_step.h>

#include <cmath>

namespace Nacre
{
  ArcLengthStep::ArcLengthStep(ShellSystem  &system,
                               const Vector &u,
                               const double  time,
                               const double  rate_step)
    : system_(system)
    , start_(u)
    , start_time_(time)
    , rate_step_(rate_step)
    , u_(u)
    , time_(time)
  {}

  void
  ArcLengthStep::go_along_tangent(const Vector &direction, const double length)
  {
    direction_ = &direction;
    length_    = length;
  }

  void
  ArcLengthStep::go_to_value(const ControlledQuantity &quantity,
                             const double              value)
  {
    quantity_ = &quantity;
    value_    = value;
  }

  void
  ArcLengthStep::go_to_plane(const Vector &normal, const double distance)
  {
    normal_   = normal;
    distance_ = distance;
  }

  void
  ArcLengthStep::go_along_mode(const Vector &mode)
  {
    // At the point itself the tangent is singular.
    normal_    = mode;
    distance_  = mode * mode;
    predictor_ = mode;
    is_first_  = false;
    u_ += mode;
  }

  NewtonSolver::Result
  ArcLengthStep::solve(const NewtonSolver::Parameters &parameters)
  {
    Assert(direction_ != nullptr || quantity_ != nullptr || normal_.size() > 0,
           ExcNotInitialized());
    system_.keep_tangent(false);
    system_.set_time(start_time_);
    auto result =
      NewtonSolver(parameters).solve(u_, [&](const Vector &u, Vector &du) {
        return linearise(u, du);
      });
    system_.count_negative_eigenvalues(result);
    if (!result.converged || distance_ == 0.)
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

  void
  ArcLengthStep::set_tangent_plane(const Vector &velocity)
  {
    const double norm = velocity.l2_norm();
    AssertThrow(norm > 0.,
                ExcMessage("Analysis/Type = arc length: nothing moves the "
                           "shell: no load and no prescribed displacement "
                           "depends on t."));
    const double dt = direction_->l2_norm() == 0. ? length_ :
                      *direction_ * velocity > 0. ? length_ / norm :
                                                    -length_ / norm;
    normal_         = velocity;
    normal_ *= dt;
    distance_ = normal_ * normal_;
  }

  double
  ArcLengthStep::distance_left(const Vector &u)
  {
    if (quantity_ == nullptr)
      {
        Vector change(u);
        change -= start_;
        found_ = ControlledQuantity::with_gradient(normal_ * change, normal_);
        return distance_ - found_.value;
      }
    found_            = quantity_->evaluate(u, time_);
    const double left = quantity_->change(found_.value, value_);
    if (is_first_)
      distance_ = left;
    return left;
  }

  StepFailure
  ArcLengthStep::no_tangent() const
  {
    if (quantity_ != nullptr && is_first_)
      return {FailureKind::constant_quantity,
              "the controlled quantity doesn't change along the path there"};
    return {FailureKind::singular_tangent,
            "the path has no tangent to working precision, or the controlled "
            "quantity doesn't change along it"};
  }

  NewtonSolver::Step
  ArcLengthStep::linearise(const Vector &u, Vector &du)
  {
    NewtonSolver::Step step = system_.solve_linearised(u, du);
    if (step.failure.kind != FailureKind::none)
      return step;
    const ShellSystem::Rate rate     = system_.rate(u, time_, rate_step_);
    const Vector           &velocity = rate.velocity;
    if (quantity_ == nullptr && normal_.size() == 0)
      set_tangent_plane(velocity);
    const double left  = distance_left(u);
    const auto   along = found_.slope(velocity);
    const double slope = along.value + found_.rate;
    const double dt    = (left - found_.slope(du).value) / slope;
    if (!(std::abs(slope) > along.error) || !std::isfinite(dt))
      {
        step.failure = no_tangent();
        return step;
      }
    du.add(dt, velocity);
    end_rate_ = 1. / slope;
    if (is_first_)
      start_rate_ = end_rate_;
    if (is_first_ && distance_ != 0.)
      {
        predictor_ = du;
        // The residual is that of equilibrium: what later ones compare with is
        // the work of the step's loads.
        step.work           = dt * dt * rate.work;
        step.round_off_work = 0.;
      }
    else if (quantity_ != nullptr)
      // In equilibrium, but Q hasn't its value yet.
      step.work =
        std::abs(step.work) + std::abs(rate.work) * std::pow(left / slope, 2);
    is_first_ = false;
    time_ += dt;
    system_.set_time(time_);
    return step;
  }
} // namespace Nacre
