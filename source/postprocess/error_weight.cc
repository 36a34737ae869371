// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/error_weight.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, 3>;
    using Tensor3 = Tensor<2, 3>;

    /** A(k) in a basis of two tangents and the normal. */
    Tensor3
    energy_symbol(const SurfaceFrame<>         &frame,
                  const SectionStiffness       &stiffness,
                  const std::array<Vector3, 3> &basis,
                  const std::array<double, 2>  &k)
    {
      std::array<Voigt<>, 3> eps;
      for (unsigned int c = 0; c < 2; ++c)
        {
          const double v[] = {basis[c] * frame.a_cov[0],
                              basis[c] * frame.a_cov[1]};
          eps[c][0]        = k[0] * v[0];
          eps[c][1]        = k[1] * v[1];
          eps[c][2]        = k[0] * v[1] + k[1] * v[0];
        }
      for (unsigned int v = 0; v < 3; ++v)
        eps[2][v] = -(v == 2 ? 2. : 1.) * frame.b(v);
      Voigt<> rho;
      rho[0] = k[0] * k[0];
      rho[1] = k[1] * k[1];
      rho[2] = 2. * k[0] * k[1];

      Tensor3 symbol;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          symbol[c][d] = eps[c] * (stiffness.membrane * eps[d]);
      symbol[2][2] += rho * (stiffness.bending * rho);
      // eps : B : rho, in which only the normal part has a bending strain
      const Voigt<> B_rho = stiffness.coupling * rho;
      for (unsigned int c = 0; c < 3; ++c)
        {
          symbol[c][2] += eps[c] * B_rho;
          symbol[2][c] += eps[c] * B_rho;
        }
      return symbol;
    }
  } // namespace

  double
  resolved_wave_number(const unsigned int degree)
  {
    return numbers::PI * degree;
  }

  Tensor<2, 3>
  error_weight(const SurfaceFrame<>   &frame,
               const SectionStiffness &stiffness,
               const double            kappa)
  {
    // The integrand is smooth and periodic: this is exact to per cents.
    constexpr unsigned int n_directions = 12;

    const Vector3                e1    = frame.a_cov[0] / frame.a_cov[0].norm();
    const std::array<Vector3, 3> basis = {
      {e1, cross_product_3d(frame.t0, e1), frame.t0}};
    Tensor3 mean;
    for (unsigned int d = 0; d < n_directions; ++d)
      {
        const double phi = numbers::PI * (d + 0.5) / n_directions;
        mean +=
          invert(
            energy_symbol(frame,
                          stiffness,
                          basis,
                          {{kappa * std::cos(phi), kappa * std::sin(phi)}})) /
          n_directions;
      }
    Tensor3 weight = mean[2][2] * outer_product(frame.t0, frame.t0);
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int d = 0; d < 2; ++d)
        weight += mean[c][d] * outer_product(basis[c], basis[d]);
    return weight;
  }

  double
  cell_height(const SurfaceFrame<> &frame, const Tensor<1, 3> &n)
  {
    return 1. / std::hypot(frame.a_con[0] * n, frame.a_con[1] * n);
  }
} // namespace Nacre
