// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_time_integrator_h
#define nacre_analysis_time_integrator_h

#include <nacre/base/selection.h>

#include <deal.II/lac/trilinos_vector.h>

namespace Nacre
{
  /** Displacement (length), velocity and acceleration at one time. */
  struct MotionState
  {
    dealii::TrilinosWrappers::MPI::Vector u;
    dealii::TrilinosWrappers::MPI::Vector v;
    dealii::TrilinosWrappers::MPI::Vector a;
  };

  /** How a step in time is taken. */
  enum class TimeScheme
  {
    /** Newmark, beta = 1/4, gamma = 1/2: the trapezoidal rule. */
    newmark,
    /** Chung & Hulbert 1993, by the spectral radius at infinity. */
    generalised_alpha,
    /** Generalised-alpha of spectral radius 1. */
    implicit_midpoint,
    /** First order, dissipative. */
    implicit_euler,
    /** The midpoint rule with forces that conserve energy and momentum. */
    energy_momentum
  };

  const Selection<TimeScheme> &selection(TimeScheme);

  /**
   * One implicit step of M a + c M v + F(u) = f(t):
   *
   *   M a_m + c M v_f + F(u_f) = f(t_f),
   *   x_f = (1 - alpha_f) x_{n+1} + alpha_f x_n   for u, v, t,
   *   a_m = (1 - alpha_m) a_{n+1} + alpha_m a_n,
   *
   * with Newmark's relations between u, v, a at both ends, or with those of
   * the implicit Euler method v_{n+1} = (u_{n+1} - u_n) / dt,
   * a_{n+1} = (v_{n+1} - v_n) / dt. The unknown is u_f.
   *
   * The energy-momentum scheme is the midpoint rule with other forces than
   * F(u_f), Kinematics::add_cell_step_terms() and its like.
   */
  class TimeIntegrator
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /**
     * @param spectral_radius of generalised-alpha at infinite frequency, 0 to 1
     * @param damping c (1/time)
     */
    TimeIntegrator(const TimeScheme scheme,
                   const double     spectral_radius,
                   const double     damping);

    /** 1 - alpha_f. */
    double
    share() const
    {
      return 1. - alpha_f_;
    }

    /** t_f of a step from @p t. */
    double
    force_time(const double t, const double dt) const
    {
      return t + share() * dt;
    }

    /** u_{n+1} from u_f. */
    Vector
    end_displacement(const MotionState &start, const Vector &u_f) const;

    /** u, v, a at the end of the step. */
    MotionState
    end_state(const MotionState &start,
              const Vector      &u_f,
              const double       dt) const;

    /** w = a_m + c v_f, the inertial force per mass. */
    Vector
    inertia(const MotionState &start, const Vector &u_f, const double dt) const;

    /** dw / du_f (1/time^2). */
    double
    inertia_factor(const double dt) const;

  private:
    const TimeScheme scheme_;
    const double     damping_;
    double           alpha_f_ = 0.;
    double           alpha_m_ = 0.;
    double           beta_    = 0.25;
    double           gamma_   = 0.5;
  };
} // namespace Nacre

#endif
