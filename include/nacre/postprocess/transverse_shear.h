// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_transverse_shear_h
#define nacre_postprocess_transverse_shear_h

#include <nacre/postprocess/strain_values.h>

#include <deal.II/base/symmetric_tensor.h>

#include <set>
#include <vector>

namespace Nacre
{
  /**
   * The transverse shear force from the equilibrium of moments,
   *   q^a = m^ab_|b,
   * the covariant divergence on the undeformed surface (force/length). As a
   * vector of the tangent plane it is q = P Div M = P M,b a^b with the moment
   * tensor M = m^ab a_a (x) a_b of space and the projection P onto the plane.
   * q . nu is the force along t0 that the side of the unit conormal nu exerts;
   * with a load p along t0 a plate has div q + p = 0.
   *
   * The moments of a solution jump between cells, and their derivatives within
   * a cell are one order worse (of no use for p = 2). Hence M is recovered
   * first: on each cell by the polynomial in the coordinates of the tangent
   * plane at its middle that is closest to the moments at superconvergent
   * points of the cell and of the cells around it, as far as the surface goes
   * on smoothly and with the same section: not across creases and not into
   * other regions. After Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33
   * (1992) 1331.
   */
  class TransverseShear
  {
  public:
    using cell_iterator = DoFHandler<dim, spacedim>::active_cell_iterator;
    using Vector3       = Tensor<1, spacedim>;

    /**
     * @param state must live as long
     * @param points in the reference cell, where it is wanted
     */
    TransverseShear(const ShellState &state, const Quadrature<dim> &points);

    /** A cell of this rank. */
    void
    reinit(const cell_iterator &cell);

    /** q in space, for the normal t0 of the cell (force/length). */
    Vector3
    value(const unsigned int q) const
    {
      return values_[q];
    }

  private:
    using Moment = SymmetricTensor<2, spacedim>;

    /** What a patch takes of a cell. */
    struct Samples
    {
      std::vector<Point<spacedim>> positions;
      std::vector<Moment>          moments;
      Point<spacedim>              middle;
      /** At the middles of the faces, and at that of the cell. */
      std::vector<Vector3> normals;
    };

    /** A cell of a patch; sign = -1: of the opposite orientation. */
    struct Member
    {
      cell_iterator cell;
      double        sign;
    };

    /** Computed when first asked for. */
    const Samples &
    samples(const cell_iterator &cell);

    /** The cell itself first. */
    std::vector<Member>
    patch(const cell_iterator &cell);

    const ShellState      state_;
    const Quadrature<dim> sample_points_;
    StrainValues          strains_;
    ShellCellValues       points_;
    std::vector<std::set<Triangulation<dim, spacedim>::active_cell_iterator>>
                         cells_of_vertex_;
    std::vector<Samples> samples_; // by active cell index
    std::vector<Vector3> values_;
  };
} // namespace Nacre

#endif
