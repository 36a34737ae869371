// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The time integrators on an oscillator u'' + 2 zeta u' + omega^2 u = 0:
// orders, conservation, the damping of high frequencies.

#include "../tests_common.h"
#include <nacre/analysis/time_integrator.h>

using namespace Tests;

constexpr double omega = 2.;

TrilinosVector
number(const double value)
{
  TrilinosVector v(complete_index_set(1), MPI_COMM_SELF);
  v(0) = value;
  v.compress(VectorOperation::insert);
  return v;
}

/** The state after n steps of dt, from u = 1, v = 0. */
MotionState
oscillate(const TimeIntegrator &integrator,
          const double          damping,
          const double          frequency,
          const double          dt,
          const unsigned int    n)
{
  MotionState state{number(1.), number(0.), number(-frequency * frequency)};
  for (unsigned int k = 0; k < n; ++k)
    {
      // Linear: w(u_f) + omega^2 u_f = 0 in one Newton step.
      TrilinosVector u_f(state.u);
      const double   residual =
        integrator.inertia(state, u_f, dt)(0) + frequency * frequency * u_f(0);
      u_f.add(-residual /
              (integrator.inertia_factor(dt) + frequency * frequency));
      state = integrator.end_state(state, u_f, dt);
    }
  (void)damping;
  return state;
}

/** Error of u at t = 1. */
double
error(const TimeScheme scheme, const double damping, const unsigned int n)
{
  const TimeIntegrator integrator(scheme, 0.8, 2. * damping);
  const double         omega_d = std::sqrt(omega * omega - damping * damping);
  const double         exact =
    std::exp(-damping) *
    (std::cos(omega_d) + damping / omega_d * std::sin(omega_d));
  const auto state = oscillate(integrator, damping, omega, 1. / n, n);
  return std::abs(state.u(0) - exact);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto &[scheme, order] : std::vector<std::pair<TimeScheme, double>>{
         {TimeScheme::newmark, 2.},
         {TimeScheme::generalised_alpha, 2.},
         {TimeScheme::implicit_midpoint, 2.},
         {TimeScheme::implicit_euler, 1.},
         {TimeScheme::energy_momentum, 2.}})
    for (const double damping : {0., 0.3})
      {
        const auto  &name = name_of(scheme);
        const double rate =
          std::log2(error(scheme, damping, 200) / error(scheme, damping, 400));
        check_below(name + ", damping " + std::to_string(damping) + ": order",
                    std::abs(rate - order),
                    0.05);
      }

  const auto energy = [](const MotionState &state) {
    return 0.5 * state.v(0) * state.v(0) +
           0.5 * omega * omega * state.u(0) * state.u(0);
  };
  const TimeIntegrator midpoint(TimeScheme::implicit_midpoint, 0., 0.);
  check_below("midpoint: energy after 1000 steps",
              std::abs(energy(oscillate(midpoint, 0., omega, 0.1, 1000)) /
                         (0.5 * omega * omega) -
                       1.),
              1e-11);
  // At infinite frequency a step multiplies by the spectral radius.
  const TimeIntegrator alpha(TimeScheme::generalised_alpha, 0.5, 0.);
  check_below("generalised alpha: high frequencies",
              std::abs(oscillate(alpha, 0., 1e6, 1., 40).u(0)),
              1e-8);
  return n_failures == 0 ? 0 : 1;
}
