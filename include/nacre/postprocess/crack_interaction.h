// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_interaction_h
#define nacre_postprocess_crack_interaction_h

#include <nacre/postprocess/crack_extension.h>

namespace Nacre
{
  /** F = phi,a (x) phi0^a + t (x) t0 (1). */
  Tensor<2, 3>
  deformation_gradient(const SurfaceFrame<> &frame, const VectorDerivatives &u);

  /**
   * The displacement as an observer sees it who turns by @p R with the shell,
   * R^T (phi0 + u) - phi0 but for a translation, by its derivatives; u itself,
   * to round-off, if R = 1.
   */
  VectorDerivatives
  turned_back(const Tensor<2, 3>      &R,
              const SurfacePatch      &surface,
              const VectorDerivatives &u);

  /**
   * d/ds at s = 0 of the work of the membrane forces and moments of @p u on the
   * linear strains of @p X per area of the reference cell, as both are carried
   * along, see energy_change():
   *
   *   [n(u) : eps(X) + m(u) : rho(X)] j0(s) det(1 + s dq).
   *
   * In linear kinematics that is half of what energy_change() of u + X is above
   * that of u - X.
   */
  double
  interaction_change(const SectionAt         &section,
                     const bool               is_linear,
                     const SurfacePatch      &surface,
                     const CrackExtension    &extension,
                     const VectorDerivatives &u,
                     const Voigt<>           &tying,
                     const VectorDerivatives &X,
                     const double             length);

  /** A point of the surface that moves with a tip. */
  struct PointAtCrack
  {
    const SectionLaw     &section;
    const CrackTip       &tip;
    const SurfacePatch   &surface;
    const SurfaceFrame<> &frame;
    const CrackExtension &extension;

    /** n (force/length) of the linear strains of the displacement x,a. */
    Voigt<>
    membrane_force(const std::array<Tensor<1, 3>, 2> &x) const;
  };

  /**
   * A field @p X in equilibrium in the tangent plane of the tip needs loads
   * on a curved surface, which do work as u moves with the tip. Per area
   * (force/length), those at the lips included, it is what the virtual work
   * of X's membrane forces on v = u,g q^g differs by from that in the plane:
   *
   *   eps(X) : A : eps(v) - eps(P X) : A : eps(P v),  P = 1 - e_3 e_3.
   *
   * The loads that its moments need are smaller by (h/r)^2.
   */
  double
  held_work(const PointAtCrack      &point,
            const VectorDerivatives &X,
            const VectorDerivatives &u);

  /**
   * The same of the bending by a displacement @p w in large rotations, seen
   * from the tip: the membrane forces n(X) of X pull on the surface that w
   * bends, and those of the shell, @p n, on that which X bends,
   *
   *   n(X) : d(w, v) - n : d(w, Y),  v = w,g q^g,  Y = X,g q^g,
   *
   * with d_ab(x, y) = (e_3 . x,a) (e_3 . y,b), made symmetric.
   */
  double
  bent_work(const PointAtCrack      &point,
            const VectorDerivatives &X,
            const VectorDerivatives &w,
            const Voigt<>           &n);
} // namespace Nacre

#endif
