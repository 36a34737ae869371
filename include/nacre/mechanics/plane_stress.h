// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_plane_stress_h
#define nacre_mechanics_plane_stress_h

#include <nacre/base/types.h>

#include <array>

namespace Nacre
{
  /** Two orthogonal unit vectors of the tangent plane. */
  using TangentAxes = std::array<Tensor<1, 3>, 2>;

  /**
   * What a material in plane stress answers to the strains (e11, e22, 2 e12) of
   * Green and Lagrange along two TangentAxes of the undeformed surface.
   */
  struct PlaneStress
  {
    /**
     * S = dw/de, the second stress of Piola and Kirchhoff (S11, S22, S12)
     * (force/length^2).
     */
    Voigt<> stress;
    /** d^2w/de^2, [stress][strain] (force/length^2). */
    VoigtMatrix<> tangent;
    /** w per volume of the undeformed body (force/length^2). */
    double energy = 0.;
  };
} // namespace Nacre

#endif
