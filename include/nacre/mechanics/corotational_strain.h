// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_corotational_strain_h
#define nacre_mechanics_corotational_strain_h

#include <nacre/mechanics/shell_strain.h>

namespace Nacre
{
  /**
   * The polar decomposition F = R U of the deformation gradient
   * F = phi,a (x) phi0^a + t (x) t0 at a point of the mid-surface. R turns t0
   * into t, so that U = R^T F stretches the tangent plane only.
   */
  template <typename Number = double>
  struct PolarRotation
  {
    using Vector = Tensor<1, 3, Number>;

    /** R phi0,alpha (length). */
    std::array<Vector, 2> q_cov;
    /** R phi0^alpha (1/length). */
    std::array<Vector, 2> q_con;
    /**
     * The spin of R about t: t . omega = spin[g] . d(phi,g), with dR R^T =
     * omega x; (1/length).
     */
    std::array<Vector, 2> spin;
  };

  /**
   * R from the frames before and after the deformation (a_cov = phi,a and
   * t0 = t of the latter), without eigenvectors: by Cayley and Hamilton
   * U + (det U) U^-1 = (tr U) I in the tangent plane, thus
   *
   * R = (F + (det U) F^-T) / tr U,  (tr U)^2 = tr U^2 + 2 det U.
   *
   * Smooth for every deformation that keeps j > 0, where det U = j / j0. The
   * spin follows from the symmetry of d(R^T F).
   */
  template <typename Number>
  PolarRotation<Number>
  make_polar_rotation(const SurfaceFrame<>       &frame,
                      const SurfaceFrame<Number> &deformed)
  {
    const auto  &a     = frame.a_cov;
    const auto  &phi   = deformed.a_cov;
    const auto  &g     = frame.metric_con;
    const Number det   = deformed.j0 / frame.j0;
    const Number tr_UU = g[0] * (phi[0] * phi[0]) + g[1] * (phi[1] * phi[1]) +
                         2. * g[2] * (phi[0] * phi[1]);
    using std::sqrt;
    const Number tr_U = sqrt(Number(tr_UU + 2. * det));

    PolarRotation<Number> polar;
    for (unsigned int beta = 0; beta < 2; ++beta)
      polar.q_cov[beta] =
        (phi[beta] + det * ((a[0] * a[beta]) * deformed.a_con[0] +
                            (a[1] * a[beta]) * deformed.a_con[1])) /
        tr_U;
    polar.q_con[0] = g[0] * polar.q_cov[0] + g[2] * polar.q_cov[1];
    polar.q_con[1] = g[2] * polar.q_cov[0] + g[1] * polar.q_cov[1];
    for (unsigned int beta = 0; beta < 2; ++beta)
      polar.spin[beta] =
        cross_product_3d(deformed.t0, polar.q_con[beta]) / tr_U;
    return polar;
  }

  /** Strains in the frame that the polar rotation turns with the material. */
  namespace CorotationalStrain
  {
    /**
     * The linear membrane strain (3) of R^T phi - phi0, which is the Biot
     * strain U - I: 1/2 (R phi0,a . phi,b + R phi0,b . phi,a) - phi0,a .
     * phi0,b in Voigt order (11, 22, 2 * 12) (length^2).
     */
    template <typename Number>
    Voigt<Number>
    membrane(const SurfaceFrame<>        &frame,
             const SurfaceFrame<Number>  &deformed,
             const PolarRotation<Number> &polar)
    {
      const auto   &a   = frame.a_cov;
      const auto   &phi = deformed.a_cov;
      Voigt<Number> strain;
      strain[0] = polar.q_cov[0] * phi[0] - a[0] * a[0];
      strain[1] = polar.q_cov[1] * phi[1] - a[1] * a[1];
      strain[2] =
        polar.q_cov[0] * phi[1] + polar.q_cov[1] * phi[0] - 2. * (a[0] * a[1]);
      return strain;
    }

    /**
     * The linear bending strain (4) of R^T phi - phi0, which is the exact
     * change of curvature -(phi,ab . t) + (phi0,ab . t0); Voigt
     * (11, 22, 2 * 12), (length).
     */
    template <typename Number>
    Voigt<Number>
    bending(const SurfaceFrame<> &frame, const SurfaceFrame<Number> &deformed)
    {
      Voigt<Number> strain;
      for (unsigned int v = 0; v < 3; ++v)
        strain[v] = (v < 2 ? 1. : 2.) * (frame.b(v) - deformed.b(v));
      return strain;
    }
  } // namespace CorotationalStrain

  /**
   * The rotation vector's rate of a unit vector along a moving tangent, and
   * rotations that carry a tangent d0 to d.
   */
  namespace EdgeRotation
  {
    /**
     * The smallest rotation that turns the unit vector @p d0 into @p d,
     * applied to a vector @p p orthogonal to d0. Undefined for d = -d0.
     */
    template <typename Number>
    Tensor<1, 3, Number>
    smallest(const Tensor<1, 3>         &d0,
             const Tensor<1, 3, Number> &d,
             const Tensor<1, 3>         &p)
    {
      return p - ((d * p) / (1. + d * d0)) * (d0 + d);
    }

    /**
     * The spin of smallest() about d, per rate of the unit vector d:
     * d . omega = smallest_spin . dd.
     */
    template <typename Number>
    Tensor<1, 3, Number>
    smallest_spin(const Tensor<1, 3> &d0, const Tensor<1, 3, Number> &d)
    {
      return cross_product_3d(d, d0) / (1. + d * d0);
    }
  } // namespace EdgeRotation
} // namespace Nacre

#endif
