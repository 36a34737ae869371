// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/time_integrator.h>

namespace Nacre
{
  const Selection<TimeScheme> &
  selection(TimeScheme)
  {
    static const Selection<TimeScheme> table = {
      {TimeScheme::newmark, "newmark"},
      {TimeScheme::generalised_alpha, "generalised alpha"},
      {TimeScheme::implicit_midpoint, "implicit midpoint"},
      {TimeScheme::implicit_euler, "implicit euler"},
      {TimeScheme::energy_momentum, "energy momentum"}};
    return table;
  }

  TimeIntegrator::TimeIntegrator(const TimeScheme scheme,
                                 const double     spectral_radius,
                                 const double     damping)
    : scheme_(scheme)
    , damping_(damping)
  {
    if (scheme == TimeScheme::generalised_alpha ||
        scheme == TimeScheme::implicit_midpoint ||
        scheme == TimeScheme::energy_momentum)
      {
        // Chung & Hulbert (1993), (17), (18), (25)
        const double r =
          scheme == TimeScheme::generalised_alpha ? spectral_radius : 1.;
        alpha_m_ = (2. * r - 1.) / (r + 1.);
        alpha_f_ = r / (r + 1.);
        gamma_   = 0.5 - alpha_m_ + alpha_f_;
        beta_ = 0.25 * (1. - alpha_m_ + alpha_f_) * (1. - alpha_m_ + alpha_f_);
      }
  }

  TimeIntegrator::Vector
  TimeIntegrator::end_displacement(const MotionState &start,
                                   const Vector      &u_f) const
  {
    Vector u(u_f);
    u.sadd(1. / share(), -alpha_f_ / share(), start.u);
    return u;
  }

  MotionState
  TimeIntegrator::end_state(const MotionState &start,
                            const Vector      &u_f,
                            const double       dt) const
  {
    MotionState end{end_displacement(start, u_f), start.v, start.a};
    Vector      change(end.u);
    change -= start.u;
    if (scheme_ == TimeScheme::implicit_euler)
      {
        end.v = change;
        end.v /= dt;
        end.a = end.v;
        end.a -= start.v;
        end.a /= dt;
        return end;
      }
    // Newmark's relations
    change.add(-dt, start.v);
    end.a.sadd(1. - 1. / (2. * beta_), 1. / (beta_ * dt * dt), change);
    const double gamma = gamma_;
    end.v.add(dt * (1. - gamma), start.a, dt * gamma, end.a);
    return end;
  }

  TimeIntegrator::Vector
  TimeIntegrator::inertia(const MotionState &start,
                          const Vector      &u_f,
                          const double       dt) const
  {
    const MotionState end = end_state(start, u_f, dt);
    Vector            w(end.a);
    w.sadd(1. - alpha_m_, alpha_m_, start.a);
    if (damping_ != 0.)
      w.add(damping_ * (1. - alpha_f_), end.v, damping_ * alpha_f_, start.v);
    return w;
  }

  double
  TimeIntegrator::inertia_factor(const double dt) const
  {
    const bool   euler = (scheme_ == TimeScheme::implicit_euler);
    const double da_du = 1. / ((euler ? 1. : beta_) * dt * dt);
    const double dv_du = (euler ? 1. : gamma_ / beta_) / dt;
    return ((1. - alpha_m_) * da_du + damping_ * (1. - alpha_f_) * dv_du) /
           share();
  }
} // namespace Nacre
