// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_shell_strain_h
#define nacre_mechanics_shell_strain_h

#include <nacre/mechanics/surface_frame.h>

namespace Nacre
{
  /** Linear strain measures of the Kirchhoff-Love shell. */
  namespace ShellStrain
  {
    /**
     * Linear membrane strain (3),
     * eps_ab = 1/2 (phi0,a . u,b + u,a . phi0,b), as (e11, e22, 2 e12) in the
     * covariant basis (length^2), from the derivatives u,1 and u,2 (length).
     */
    template <typename FrameNumber, typename Number>
    Voigt<Number>
    membrane(const SurfaceFrame<FrameNumber> &frame,
             const Tensor<1, 3, Number>      &u_1,
             const Tensor<1, 3, Number>      &u_2)
    {
      Voigt<Number> strain;
      strain[0] = frame.a_cov[0] * u_1;
      strain[1] = frame.a_cov[1] * u_2;
      strain[2] = frame.a_cov[0] * u_2 + frame.a_cov[1] * u_1;
      return strain;
    }

    /**
     * The bending strain of a scalar shape function N that multiplies a
     * displacement along t0: -(N,ab - Gamma^g_ab N,g) as (11, 22, 2 * 12).
     * The strain of N e_c is this times the component c of t0, since (4) is
     * identical to rho_ab(u) = -(u,ab - Gamma^g_ab u,g) . t0.
     *
     * @param dN derivatives N,1, N,2 on the reference cell
     * @param ddN second derivatives N,11, N,22, N,12
     */
    template <typename Number>
    Voigt<Number>
    bending_of_shape_function(const SurfaceFrame<Number>  &frame,
                              const std::array<double, 2> &dN,
                              const std::array<double, 3> &ddN)
    {
      Voigt<Number> strain;
      for (unsigned int v = 0; v < 3; ++v)
        strain[v] = frame.christoffel[0][v] * dN[0] +
                    frame.christoffel[1][v] * dN[1] - ddN[v];
      strain[2] *= 2.;
      return strain;
    }

    /**
     * Bending strain of a displacement (1/length times length^2), the
     * linearisation (4) of -(phi,ab . t) + (phi0,ab . t0), in the cheap form
     * rho_ab(u) = -(u,ab - Gamma^g_ab u,g) . t0; Voigt (11, 22, 2 * 12).
     */
    template <typename FrameNumber, typename Number>
    Voigt<Number>
    bending(const SurfaceFrame<FrameNumber>           &frame,
            const std::array<Tensor<1, 3, Number>, 2> &du,
            const std::array<Tensor<1, 3, Number>, 3> &ddu)
    {
      Voigt<Number> strain;
      for (unsigned int v = 0; v < 3; ++v)
        strain[v] = (frame.christoffel[0][v] * du[0] +
                     frame.christoffel[1][v] * du[1] - ddu[v]) *
                    frame.t0;
      strain[2] *= 2.;
      return strain;
    }

    /**
     * Linearised change of the unit normal (17):
     * Delta t(u) = -(t0 . u,g) phi0^g (1).
     */
    template <typename Number>
    Tensor<1, 3, Number>
    normal_change(const SurfaceFrame<Number>                &frame,
                  const std::array<Tensor<1, 3, Number>, 2> &du)
    {
      return -(frame.t0 * du[0]) * frame.a_con[0] -
             (frame.t0 * du[1]) * frame.a_con[1];
    }

    /**
     * The covariant components nu_a nu_b of a unit vector @p nu of the tangent
     * plane, in the Voigt order of strains (nu_1^2, nu_2^2, 2 nu_1 nu_2):
     * contracted with resultants it gives nu . m . nu, with a strain's
     * stiffness H(nu, nu, nu, nu).
     */
    template <typename Number>
    Voigt<Number>
    dyad_of(const SurfaceFrame<Number> &frame, const Tensor<1, 3, Number> &nu)
    {
      const Number  nu_1 = frame.a_cov[0] * nu;
      const Number  nu_2 = frame.a_cov[1] * nu;
      Voigt<Number> dyad;
      dyad[0] = nu_1 * nu_1;
      dyad[1] = nu_2 * nu_2;
      dyad[2] = 2. * nu_1 * nu_2;
      return dyad;
    }

    /**
     * The symmetric space tensor n^ab a_a (x) a_b of resultants in Voigt
     * order (n11, n22, n12).
     */
    template <typename Number>
    Tensor<2, 3, Number>
    resultant_tensor(const SurfaceFrame<Number> &frame,
                     const Voigt<Number>        &resultant)
    {
      const auto &a = frame.a_cov;
      return resultant[0] * outer_product(a[0], a[0]) +
             resultant[1] * outer_product(a[1], a[1]) +
             resultant[2] *
               (outer_product(a[0], a[1]) + outer_product(a[1], a[0]));
    }
  } // namespace ShellStrain
} // namespace Nacre

#endif
