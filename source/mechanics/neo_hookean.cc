// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/neo_hookean.h>

#include <limits>

namespace Nacre
{
  PlaneStress
  NeoHookean::response(const Voigt<> &strain,
                       const TangentAxes & /*axes*/,
                       const SectionState & /*state*/) const
  {
    const double mu   = shear_modulus;
    const double C_11 = 1. + 2. * strain[0];
    const double C_22 = 1. + 2. * strain[1];
    const double C_12 = strain[2];
    double       det  = C_11 * C_22 - C_12 * C_12;
    if (!(C_11 > 0. && det > 0.))
      det = std::numeric_limits<double>::quiet_NaN();

    // p = mu/det C is the pressure that keeps the normal stress zero.
    const double                pressure = mu / det;
    const std::array<double, 3> inverse{{C_22 / det, C_11 / det, -C_12 / det}};
    PlaneStress                 answer;
    for (unsigned int v = 0; v < 3; ++v)
      answer.stress[v] = (v < 2 ? mu : 0.) - pressure * inverse[v];
    // 2 p (C^-1 x C^-1 + the symmetric fourth-order C^-1)
    answer.tangent = 4. * pressure * isotropic_stiffness(inverse, 0.5);
    // mu/2 (tr C + 1/det C - 3), without differences of large numbers
    const double t = strain[0] + strain[1];
    const double d = strain[0] * strain[1] - 0.25 * C_12 * C_12;
    answer.energy  = 2. * mu * (t * t + 2. * t * d - d) / det;
    return answer;
  }
} // namespace Nacre
