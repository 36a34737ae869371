// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_edge_frame_h
#define nacre_mechanics_edge_frame_h

#include <nacre/mechanics/surface_frame.h>

namespace Nacre
{
  /**
   * The frame of an edge with the averaged normal of its two cells, Kaufmann
   * et al. (34)-(36), and how tensors pass between the bases of cells and
   * edge, (42)-(45): the report's own route. Its errata are those of
   * doc/report.md.
   *
   * A frame of an edge is a SurfaceFrame whose a_cov are the phi_e,alpha
   * (length), whose t0 is the averaged normal t_e and whose j0 is j~ =
   * |phi_e,1| (length). It has no second derivatives: Christoffel symbols are
   * zero.
   */
  namespace EdgeFrame
  {
    /**
     * t_e = (t^- + t^+) / |t^- + t^+| (34), phi_e,1 = @p tangent,
     * phi_e,2 = t_e x phi_e,1 / |phi_e,1| (35).
     *
     * phi_e,2 points to the left of the tangent, seen against t_e: K^+ must
     * lie there for the jump to be plus minus minus.
     *
     * @param tangent along the edge, of any length (length)
     * @param t_minus, t_plus unit normals of the cells, oriented alike; they
     *   must not be opposite
     */
    inline SurfaceFrame<>
    make_edge_frame(const Tensor<1, 3> &tangent,
                    const Tensor<1, 3> &t_minus,
                    const Tensor<1, 3> &t_plus)
    {
      const auto sum = t_minus + t_plus;
      Assert(sum.norm() > 1e-8, ExcMessage("The averaged normal vanishes."));
      const auto t_e = sum / sum.norm();
      return make_surface_frame(tangent,
                                cross_product_3d(t_e, tangent) / tangent.norm(),
                                std::array<Tensor<1, 3>, 3>());
    }

    /** c[a][g] = (phi^g of @p from) . (phi,a of @p to). */
    inline std::array<std::array<double, 2>, 2>
    mixed_products(const SurfaceFrame<> &from, const SurfaceFrame<> &to)
    {
      return {{{{to.a_cov[0] * from.a_con[0], to.a_cov[0] * from.a_con[1]}},
               {{to.a_cov[1] * from.a_con[0], to.a_cov[1] * from.a_con[1]}}}};
    }

    /**
     * Derivatives of a shape function with respect to the coordinates of
     * @p to, N,a^to = N,g (phi^g of from . phi,a of to) (36).
     * @param dN N,1, N,2 with respect to the coordinates of @p from
     */
    inline std::array<double, 2>
    transform_derivatives(const SurfaceFrame<>        &from,
                          const SurfaceFrame<>        &to,
                          const std::array<double, 2> &dN)
    {
      const auto c = mixed_products(from, to);
      return {
        {c[0][0] * dN[0] + c[0][1] * dN[1], c[1][0] * dN[0] + c[1][1] * dN[1]}};
    }

    /**
     * The Voigt matrix of the push-forward
     * e_ab = (phi^g . phi,a) (phi^d . phi,b) e_gd of strains, phi^g being of
     * @p from and phi,a of @p to: p (44)-(45) from the cell to the edge, P
     * (42)-(43) from the edge to the cell. P p = I where both have the same
     * tangent plane. A stiffness of the edge's basis is P^T H P (41).
     */
    inline VoigtMatrix<>
    strain_transformation(const SurfaceFrame<> &from, const SurfaceFrame<> &to)
    {
      const auto    c = mixed_products(from, to);
      VoigtMatrix<> matrix;
      for (unsigned int a = 0; a < 2; ++a)
        {
          for (unsigned int g = 0; g < 2; ++g)
            matrix[a][g] = c[a][g] * c[a][g];
          matrix[a][2] = c[a][0] * c[a][1];
        }
      for (unsigned int g = 0; g < 2; ++g)
        matrix[2][g] = 2. * c[0][g] * c[1][g];
      matrix[2][2] = c[0][0] * c[1][1] + c[0][1] * c[1][0];
      return matrix;
    }

    /**
     * Change of the normal (38) of @p frame by the displacement N e_c, per
     * component c of the normal: -N,g phi^g (1/length); all of the same frame.
     * @param dN derivatives with respect to that frame's coordinates
     */
    inline Tensor<1, 3>
    normal_change_of_shape_function(const SurfaceFrame<>        &frame,
                                    const std::array<double, 2> &dN)
    {
      return -dN[0] * frame.a_con[0] - dN[1] * frame.a_con[1];
    }

    /**
     * N^ of (37): the Voigt strain (11, 22, 2 * 12) of the symmetric tensor
     * phi_e,a . [[Delta t]] nu_b with nu = phi_e,2, that is nu_1 = 0 and
     * nu_2 = 1. Rows are Voigt components, columns those of [[Delta t]].
     */
    inline Tensor<2, 3>
    jump_matrix(const SurfaceFrame<> &edge)
    {
      Tensor<2, 3> matrix;
      matrix[1] = edge.a_cov[1];
      matrix[2] = edge.a_cov[0];
      return matrix;
    }
  } // namespace EdgeFrame
} // namespace Nacre

#endif
