// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/crack_interaction.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, 3>;

    /** x,a of a field that points carry along, x = u,g q^g. */
    std::array<Vector3, 2>
    gradient_of_carried(const VectorDerivatives &u,
                        const CrackExtension    &extension)
    {
      const auto            &q  = extension.q;
      const auto            &dq = extension.gradient;
      std::array<Vector3, 2> x;
      for (unsigned int a = 0; a < 2; ++a)
        x[a] = q[a] * u.second[a] + q[1 - a] * u.second[2] +
               dq[0][a] * u.first[0] + dq[1][a] * u.first[1];
      return x;
    }
  } // namespace

  Tensor<2, 3>
  deformation_gradient(const SurfaceFrame<> &frame, const VectorDerivatives &u)
  {
    const Vector3 phi_1 = frame.a_cov[0] + u.first[0];
    const Vector3 phi_2 = frame.a_cov[1] + u.first[1];
    const Vector3 area  = cross_product_3d(phi_1, phi_2);
    return outer_product(phi_1, frame.a_con[0]) +
           outer_product(phi_2, frame.a_con[1]) +
           outer_product(area / area.norm(), frame.t0);
  }

  VectorDerivatives
  turned_back(const Tensor<2, 3>      &R,
              const SurfacePatch      &surface,
              const VectorDerivatives &u)
  {
    // R^T u + (R^T - 1) phi0; x R is R^T x.
    const Tensor<2, 3> turn = R - Tensor<2, 3>(unit_symmetric_tensor<3>());
    const auto        &X    = surface.derivatives;
    VectorDerivatives  w;
    for (unsigned int a = 0; a < 2; ++a)
      w.first[a] = u.first[a] * R + X.first[a] * turn;
    for (unsigned int v = 0; v < 3; ++v)
      w.second[v] = u.second[v] * R + X.second[v] * turn;
    return w;
  }

  double
  interaction_change(const SectionAt         &section,
                     const bool               is_linear,
                     const SurfacePatch      &surface,
                     const CrackExtension    &extension,
                     const VectorDerivatives &u,
                     const Voigt<>           &tying,
                     const VectorDerivatives &X,
                     const double             length)
  {
    const auto work = [&](const double s) {
      const MovedPoint at(surface, extension, s);
      const auto       forces =
        at.response(section, is_linear, moved(u, extension, s), tying);
      const auto X_s = moved(X, extension, s);
      return (forces.membrane_force *
                ShellStrain::membrane(at.frame, X_s.first[0], X_s.first[1]) +
              forces.moment *
                ShellStrain::bending(at.frame, X_s.first, X_s.second)) *
             at.frame.j0 * at.determinant;
    };
    return change_with_advance(work, length);
  }

  Voigt<>
  PointAtCrack::membrane_force(const std::array<Vector3, 2> &x) const
  {
    return section.stiffness(frame, surface.position).membrane *
           ShellStrain::membrane(frame, x[0], x[1]);
  }

  double
  held_work(const PointAtCrack      &point,
            const VectorDerivatives &X,
            const VectorDerivatives &u)
  {
    const auto v        = gradient_of_carried(u, point.extension);
    const auto in_plane = [&](const std::array<Vector3, 2> &d) {
      const auto &e_3 = point.tip.axes[2];
      return std::array<Vector3, 2>(
        {{d[0] - (d[0] * e_3) * e_3, d[1] - (d[1] * e_3) * e_3}});
    };
    const auto flat = in_plane(v);
    return point.membrane_force(X.first) *
             ShellStrain::membrane(point.frame, v[0], v[1]) -
           point.membrane_force(in_plane(X.first)) *
             ShellStrain::membrane(point.frame, flat[0], flat[1]);
  }

  double
  bent_work(const PointAtCrack      &point,
            const VectorDerivatives &X,
            const VectorDerivatives &w,
            const Voigt<>           &n)
  {
    const auto across = [&](const std::array<Vector3, 2> &x,
                            const std::array<Vector3, 2> &y) {
      const auto &e_3 = point.tip.axes[2];
      return Voigt<>(
        {(e_3 * x[0]) * (e_3 * y[0]),
         (e_3 * x[1]) * (e_3 * y[1]),
         (e_3 * x[0]) * (e_3 * y[1]) + (e_3 * x[1]) * (e_3 * y[0])});
    };
    return point.membrane_force(X.first) *
             across(w.first, gradient_of_carried(w, point.extension)) -
           n * across(w.first, gradient_of_carried(X, point.extension));
  }
} // namespace Nacre
