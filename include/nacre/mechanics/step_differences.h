// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_step_differences_h
#define nacre_mechanics_step_differences_h

#include <nacre/mechanics/surface_frame.h>

namespace Nacre
{
  /**
   * How strains change over a step from one deformation to another, of any
   * size, as exact linear functions of the change of the positions:
   *
   *   Delta(strain) = B* Delta(phi),
   *
   * with B* of the means of both ends (index m) only. B* annuls infinitesimal
   * rigid motions of the mean positions. Forces B*^T s with the mean s of the
   * stresses thus do the work that the strain energy changes by, and have
   * neither a resultant nor a moment: Simo and Tarnow's algorithm (ZAMP 43,
   * 1992, 757) for strains that are not quadratic in the positions.
   *
   * All of it follows from products: Delta(x . y) = Delta(x) . y_m +
   * x_m . Delta(y) without a remainder. A unit vector orthogonal to two
   * others, x . y = 0, x . z = 0, x . x = 1, is determined by the three
   * products, and so is its difference: in the dual basis (y*, z*, x*) of
   * (y_m, z_m, x_m)
   *
   *   Delta(x) = -(x_m . Delta(y)) y* - (x_m . Delta(z)) z*.
   */
  namespace StepDifferences
  {
    using Vector3 = Tensor<1, 3>;

    inline Vector3
    mean(const Vector3 &start, const Vector3 &end)
    {
      return 0.5 * (start + end);
    }

    /** The vectors y_i with y_i . x_k = delta_ik. */
    inline std::array<Vector3, 3>
    dual_basis(const Vector3 &x_0, const Vector3 &x_1, const Vector3 &x_2)
    {
      const Vector3 y_0    = cross_product_3d(x_1, x_2);
      const double  volume = x_0 * y_0;
      return {{y_0 / volume,
               cross_product_3d(x_2, x_0) / volume,
               cross_product_3d(x_0, x_1) / volume}};
    }

    /**
     * The means of the frames at both ends: phi,alpha, their derivatives, the
     * normals as t0, no unit vector; a_con the dual vectors of phi,alpha in
     * the basis (phi,1m, phi,2m, t_m), and the Christoffel symbols with them:
     *
     *   Delta(t) = -(t_m . Delta(phi,g)) phi*^g,
     *   Delta(phi,ab . t) =
     *     (Delta(phi,ab) - Gamma*^g_ab Delta(phi,g)) . t_m.
     */
    inline SurfaceFrame<>
    mean_frame(const SurfaceFrame<> &start, const SurfaceFrame<> &end)
    {
      SurfaceFrame<> mean;
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        mean.a_cov[alpha] = 0.5 * (start.a_cov[alpha] + end.a_cov[alpha]);
      for (unsigned int v = 0; v < 3; ++v)
        mean.a_cov_derivatives[v] =
          0.5 * (start.a_cov_derivatives[v] + end.a_cov_derivatives[v]);
      mean.t0         = 0.5 * (start.t0 + end.t0);
      const auto dual = dual_basis(mean.a_cov[0], mean.a_cov[1], mean.t0);
      mean.a_con      = {{dual[0], dual[1]}};
      mean.j0         = cross_product_3d(mean.a_cov[0], mean.a_cov[1]).norm();
      mean.metric_con = {
        {dual[0] * dual[0], dual[1] * dual[1], dual[0] * dual[1]}};
      for (unsigned int gamma = 0; gamma < 2; ++gamma)
        for (unsigned int v = 0; v < 3; ++v)
          mean.christoffel[gamma][v] =
            mean.a_con[gamma] * mean.a_cov_derivatives[v];
      return mean;
    }

    /**
     * The vectors v_a such that direction . Delta(e) = v_a . Delta(phi,a) for
     * the Biot strain e (e11, e22, 2 e12). The covariant components of the
     * stretch, V = e + A with the metric A, fulfil C = V A^-1 V, so that
     *
     *   Delta(C) = X Delta(V) + Delta(V) X^T,  X = V_m A^-1,
     *
     * and P: Delta(C) = direction . Delta(e) if X^T P + P X = direction.
     *
     * @param frame undeformed @param mean mean_frame() @param strain mean e
     */
    inline std::array<Vector3, 2>
    stretch_vectors(const SurfaceFrame<>        &frame,
                    const SurfaceFrame<>        &mean,
                    const Voigt<>               &strain,
                    const std::array<double, 3> &direction)
    {
      const auto  &a = frame.a_cov;
      Tensor<2, 2> V, A_inverse, N;
      V[0][0] = strain[0] + a[0] * a[0];
      V[1][1] = strain[1] + a[1] * a[1];
      V[0][1] = V[1][0] = 0.5 * strain[2] + a[0] * a[1];
      A_inverse[0][0]   = frame.metric_con[0];
      A_inverse[1][1]   = frame.metric_con[1];
      A_inverse[0][1] = A_inverse[1][0] = frame.metric_con[2];
      N[0][0]                           = direction[0];
      N[1][1]                           = direction[1];
      N[0][1] = N[1][0] = direction[2];

      // The solution of this equation in two dimensions, without eigenvectors
      const Tensor<2, 2> X       = V * A_inverse;
      const double       trace_X = trace(X);
      const double       det_X   = determinant(X);
      const Tensor<2, 2> adj_X   = adjugate(X);
      const Tensor<2, 2> P =
        (det_X * N + transpose(adj_X) * N * adj_X) / (2. * trace_X * det_X);
      // P: Delta(C) = 2 P^ab phi,am . Delta(phi,b)
      return {{2. * (P[0][0] * mean.a_cov[0] + P[1][0] * mean.a_cov[1]),
               2. * (P[0][1] * mean.a_cov[0] + P[1][1] * mean.a_cov[1])}};
    }
  } // namespace StepDifferences
} // namespace Nacre

#endif
