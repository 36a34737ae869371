// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_orthotropic_material_h
#define nacre_mechanics_orthotropic_material_h

#include <nacre/base/types.h>

#include <array>
#include <optional>

namespace Nacre
{
  /**
   * An orthotropic linear elastic material in plane stress: direction 1 along
   * the fibres, 2 across them within the ply. Jones, Mechanics of Composite
   * Materials, 2nd edition, chapter 2.
   */
  struct OrthotropicMaterial
  {
    /** Stresses at failure, all positive (force/length^2). */
    struct Strengths
    {
      /** Along the fibres, tension and compression. */
      double Xt, Xc;
      /** Across them. */
      double Yt, Yc;
      /** In shear. */
      double S;
    };

    /** Young's moduli, shear modulus (force/length^2). */
    double E1 = 1., E2 = 1., G12 = 0.5;
    /** Contraction along 2 by stress along 1; nu21 = nu12 E2/E1. */
    double nu12 = 0.;
    /** Mass/length^3. */
    double density = 0.;
    /** Thermal expansion along and across the fibres (1/temperature). */
    double                   alpha1 = 0., alpha2 = 0.;
    std::optional<Strengths> strengths;

    /**
     * Q of stress (s1, s2, t12) = Q (e1, e2, 2 e12), Jones (2.66):
     * Q11 = E1/(1 - nu12 nu21), Q22 = E2/(1 - nu12 nu21),
     * Q12 = nu12 Q22, Q66 = G12.
     */
    VoigtMatrix<>
    stiffness() const;

    /**
     * The Tsai-Wu index of @p stress (s1, s2, t12), 1 at failure:
     * F1 s1 + F2 s2 + F11 s1^2 + F22 s2^2 + F66 t12^2 + 2 F12 s1 s2,
     * F1 = 1/Xt - 1/Xc, F11 = 1/(Xt Xc), F2 and F22 with Y, F66 = 1/S^2,
     * F12 = -sqrt(F11 F22)/2; Jones (2.133)-(2.143). Only with strengths.
     */
    double
    tsai_wu(const Voigt<> &stress) const;

    /**
     * The largest of s1/Xt or -s1/Xc, s2/Yt or -s2/Yc, |t12|/S, 1 at failure;
     * Jones (2.118). Only with strengths.
     */
    double
    maximum_stress(const Voigt<> &stress) const;
  };

  /**
   * From strains (e11, e22, 2 e12) in covariant components, or any others, to
   * those along unit vectors d1, d2, of which @p d1 and @p d2 are the
   * contravariant components d^a: e_ij = d_i^a e_ab d_j^b.
   */
  VoigtMatrix<>
  strain_transformation(const std::array<double, 2> &d1,
                        const std::array<double, 2> &d2);
} // namespace Nacre

#endif
