// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/orthotropic_material.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  VoigtMatrix<>
  OrthotropicMaterial::stiffness() const
  {
    const double  nu21   = nu12 * E2 / E1;
    const double  factor = 1. / (1. - nu12 * nu21);
    VoigtMatrix<> Q;
    Q[0][0] = factor * E1;
    Q[1][1] = factor * E2;
    Q[0][1] = Q[1][0] = nu12 * Q[1][1];
    Q[2][2]           = G12;
    return Q;
  }

  double
  OrthotropicMaterial::tsai_wu(const Voigt<> &stress) const
  {
    Assert(strengths, ExcMessage("The material has no strengths."));
    const auto &[Xt, Xc, Yt, Yc, S] = *strengths;
    const double F1                 = 1. / Xt - 1. / Xc;
    const double F2                 = 1. / Yt - 1. / Yc;
    const double F11                = 1. / (Xt * Xc);
    const double F22                = 1. / (Yt * Yc);
    const double F12                = -0.5 * std::sqrt(F11 * F22);
    return F1 * stress[0] + F2 * stress[1] + F11 * stress[0] * stress[0] +
           F22 * stress[1] * stress[1] + stress[2] * stress[2] / (S * S) +
           2. * F12 * stress[0] * stress[1];
  }

  double
  OrthotropicMaterial::maximum_stress(const Voigt<> &stress) const
  {
    Assert(strengths, ExcMessage("The material has no strengths."));
    const auto &[Xt, Xc, Yt, Yc, S] = *strengths;
    return std::max({stress[0] / Xt,
                     -stress[0] / Xc,
                     stress[1] / Yt,
                     -stress[1] / Yc,
                     std::abs(stress[2]) / S});
  }

  VoigtMatrix<>
  strain_transformation(const std::array<double, 2> &d1,
                        const std::array<double, 2> &d2)
  {
    VoigtMatrix<> T;
    T[0][0] = d1[0] * d1[0];
    T[0][1] = d1[1] * d1[1];
    T[0][2] = d1[0] * d1[1];
    T[1][0] = d2[0] * d2[0];
    T[1][1] = d2[1] * d2[1];
    T[1][2] = d2[0] * d2[1];
    T[2][0] = 2. * d1[0] * d2[0];
    T[2][1] = 2. * d1[1] * d2[1];
    T[2][2] = d1[0] * d2[1] + d1[1] * d2[0];
    return T;
  }
} // namespace Nacre
