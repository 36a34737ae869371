// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/dynamic_step.h>

namespace Nacre
{
  DynamicStep::DynamicStep(ShellSystem          &system,
                           const MassTerms      &mass,
                           const TimeIntegrator &integrator,
                           const PathParameters &parameters,
                           const MotionState    &start,
                           const double          time,
                           const double          dt)
    : system_(system)
    , mass_(mass)
    , integrator_(integrator)
    , parameters_(parameters)
    , start_(start)
    , time_(time)
    , dt_(dt)
    , conserves_(parameters.scheme == TimeScheme::energy_momentum)
  {
    system_.set_load_time(time_);
    step_start_ = system_.step_start(start_.u);
    // The loads are those of t_f, the constraints those of the end.
    system_.set_time(time_ + dt_);
    const double t_f = integrator_.force_time(time_, dt_);
    if (conserves_)
      system_.set_force_time(t_f);
    else
      system_.set_load_time(t_f);
  }

  DynamicStep::Vector
  DynamicStep::inertia(const Vector &u_f) const
  {
    return system_.with_ghosts(integrator_.inertia(start_, u_f, dt_));
  }

  Inertia
  DynamicStep::terms(const Vector &w) const
  {
    return {mass_,
            w,
            integrator_.inertia_factor(dt_),
            conserves_ ? &step_start_ : nullptr};
  }

  NewtonSolver::Result
  DynamicStep::solve(const bool search)
  {
    system_.keep_tangent(parameters_.keeps_tangent());
    auto parameters          = parameters_.newton;
    parameters.max_increment = 100. * system_.size();
    mixes_ = conserves_ && !search && !parameters_.keeps_tangent() &&
             parameters.damping == 1.;
    n_new_tangents_ = 2;

    NewtonSolver::Work work;
    if (search)
      work = [&](const Vector &u_f, const Vector &du) {
        const Vector  w          = inertia(u_f);
        const Inertia terms_of_w = terms(w);
        return system_.work(u_f, du, &terms_of_w);
      };
    // Start where a constant velocity would lead.
    u_f_ = start_.u;
    u_f_.add(integrator_.share() * dt_, start_.v);
    return NewtonSolver(parameters)
      .solve(
        u_f_,
        [&](const Vector &u_f, Vector &du) { return linearise(u_f, du); },
        work);
  }

  NewtonSolver::Step
  DynamicStep::linearise(const Vector &u_f, Vector &du)
  {
    if (mixes_ && n_new_tangents_ > 0)
      system_.keep_tangent(true);
    const Vector  w          = inertia(u_f);
    const Inertia terms_of_w = terms(w);
    const auto    step =
      system_.solve_linearised(u_f,
                               integrator_.end_displacement(start_, u_f),
                               du,
                               &terms_of_w,
                               integrator_.share());
    if (mixes_ && step.failure.kind == FailureKind::none)
      mix(u_f, du);
    return step;
  }

  void
  DynamicStep::mix(const Vector &u_f, Vector &du)
  {
    const bool   was_new   = n_new_tangents_ > 0;
    const double increment = du.linfty_norm();
    if (was_new)
      {
        --n_new_tangents_;
        mixing_.reset();
      }
    else if (increment > 0.8 * last_increment_)
      n_new_tangents_ = 2;
    last_increment_ = increment;
    // The first increment may bring prescribed displacements.
    if (n_new_tangents_ == 0)
      mixing_.improve(u_f, du);
  }

  EnergyBalance
  DynamicStep::balance(const EnergyLedger  &ledger,
                       const EnergyBalance &before,
                       const MotionState   &end) const
  {
    return ledger
      .after_step(before, {time_, dt_, start_, end, step_start_, conserves_});
  }
} // namespace Nacre
