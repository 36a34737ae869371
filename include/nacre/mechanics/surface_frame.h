// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_surface_frame_h
#define nacre_mechanics_surface_frame_h

#include <nacre/base/types.h>

#include <array>
#include <cmath>

namespace Nacre
{
  /**
   * The differential geometry of a surface at one point: of the mid-surface,
   * undeformed or deformed, whose positions phi it is made from.
   * Greek indices are coordinates of the reference cell; a pair of them is
   * stored in the order 11, 22, 12.
   */
  template <typename Number = double>
  struct SurfaceFrame
  {
    using Vector = Tensor<1, 3, Number>;

    /** Covariant basis phi,alpha (length). */
    std::array<Vector, 2> a_cov;
    /** Contravariant basis phi^alpha, a^alpha . a_beta = delta; (12). */
    std::array<Vector, 2> a_con;
    /** Second derivatives phi,11, phi,22, phi,12 (length). */
    std::array<Vector, 3> a_cov_derivatives;
    /** Unit normal a_1 x a_2 / j0. */
    Vector t0;
    /** Area Jacobian |a_1 x a_2| (length^2), (5). */
    Number j0;
    /** Contravariant metric a^11, a^22, a^12 (1/length^2). */
    std::array<Number, 3> metric_con;
    /** Christoffel symbols [gamma][11, 22, 12]: a^gamma . phi,alpha beta. */
    std::array<std::array<Number, 3>, 2> christoffel;

    /** Second fundamental form b_11, b_22, b_12 = phi,ab . t0 (length). */
    Number
    b(const unsigned int v) const
    {
      return a_cov_derivatives[v] * t0;
    }
  };

  /**
   * The frame from the first derivatives @p a_1, @p a_2 and the second
   * derivatives (11, 22, 12) of the mid-surface, (5), (11), (12).
   */
  template <typename Number>
  SurfaceFrame<Number>
  make_surface_frame(const Tensor<1, 3, Number>                &a_1,
                     const Tensor<1, 3, Number>                &a_2,
                     const std::array<Tensor<1, 3, Number>, 3> &derivatives)
  {
    SurfaceFrame<Number> frame;
    frame.a_cov             = {{a_1, a_2}};
    frame.a_cov_derivatives = derivatives;
    const auto   cross      = cross_product_3d(a_1, a_2);
    const Number a_11       = a_1 * a_1;
    const Number a_22       = a_2 * a_2;
    const Number a_12       = a_1 * a_2;
    const Number j0_squared = cross * cross;
    using std::sqrt;
    frame.j0         = sqrt(j0_squared);
    frame.t0         = cross / frame.j0;
    frame.metric_con = {
      {a_22 / j0_squared, a_11 / j0_squared, -a_12 / j0_squared}};
    frame.a_con[0] = frame.metric_con[0] * a_1 + frame.metric_con[2] * a_2;
    frame.a_con[1] = frame.metric_con[2] * a_1 + frame.metric_con[1] * a_2;
    for (unsigned int gamma = 0; gamma < 2; ++gamma)
      for (unsigned int v = 0; v < 3; ++v)
        frame.christoffel[gamma][v] = frame.a_con[gamma] * derivatives[v];
    return frame;
  }
} // namespace Nacre

#endif
