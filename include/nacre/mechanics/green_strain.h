// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_green_strain_h
#define nacre_mechanics_green_strain_h

#include <nacre/mechanics/shell_strain.h>

namespace Nacre
{
  /**
   * The strains of exact finite rotations at a point of the mid-surface, as
   * functions of the deformed surface phi alone:
   *
   * E_ab = 1/2 (phi,a . phi,b - phi0,a . phi0,b)  (length^2)
   * kappa_ab = -(phi,ab . t - phi0,ab . t0)       (length)
   *
   * with the unit normal t; covariant components, Voigt order
   * (11, 22, 2 * 12). Both vanish under every rigid motion. The bending
   * strain is CorotationalStrain::bending(), which is exact, too.
   *
   * Variations, with the deformed basis A_a = phi,a, its dual a^a, the
   * Christoffel symbols Gamma^g_ab = phi,ab . a^g and b_ab = phi,ab . t:
   *
   * dE_ab(v)   = 1/2 (A_a . v,b + A_b . v,a)
   * d2E_ab(v, w) = 1/2 (v,a . w,b + v,b . w,a)
   * dkappa_ab(v) = -(v,ab - Gamma^g_ab v,g) . t
   * m^ab d2kappa_ab(v, w) = V(v) . T(w) + V(w) . T(v) + m^ab b_ab T(v) . T(w)
   *
   * V(v) = m^ab (v,ab - Gamma^g_ab v,g), and T(v) = a^g (t . v,g) is minus the
   * change of the normal (17). The first line of both follows by
   * differentiation; in the last one, dt = -T, and
   * d(a^g) = -a^h (a^g . w,h) + a^gh (t . w,h) t.
   */
  namespace GreenStrain
  {
    /**
     * E (length^2) from the derivatives @p du = (u,1, u,2) of the
     * displacement (length), without the difference of squares.
     */
    template <typename Number>
    Voigt<Number>
    membrane(const SurfaceFrame<>                      &frame,
             const std::array<Tensor<1, 3, Number>, 2> &du)
    {
      Voigt<Number> strain = ShellStrain::membrane(frame, du[0], du[1]);
      strain[0] += 0.5 * (du[0] * du[0]);
      strain[1] += 0.5 * (du[1] * du[1]);
      strain[2] += du[0] * du[1];
      return strain;
    }
  } // namespace GreenStrain
} // namespace Nacre

#endif
