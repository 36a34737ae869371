// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_transverse_shear_h
#define nacre_postprocess_transverse_shear_h

#include <nacre/postprocess/strain_values.h>

#include <deal.II/base/symmetric_tensor.h>

#include <set>
#include <utility>
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
   * other regions. Parts of divided cells are cells of their own here, which
   * meet where they share pieces of edges: nothing is taken across a cut. After
   * Zienkiewicz and Zhu, Int. J. Numer. Meth. Engng 33
   * (1992) 1331.
   */
  class TransverseShear
  {
  public:
    using cell_iterator = DoFHandler<dim, spacedim>::active_cell_iterator;
    using Vector3       = Tensor<1, spacedim>;

    /** @param state must live as long */
    explicit TransverseShear(const ShellState &state);

    /**
     * A part of this rank.
     * @param points frames on it, where the force is wanted
     */
    void
    reinit(const CellPart &part, const ShellCellValues &points);

    /** q in space, for the normal t0 of the cell (force/length). */
    Vector3
    value(const unsigned int q) const
    {
      return values_[q];
    }

  private:
    using Moment = SymmetricTensor<2, spacedim>;

    /** What a patch takes of a part. */
    struct Samples
    {
      std::vector<Point<spacedim>> positions;
      std::vector<Moment>          moments;
      Point<spacedim>              middle;
      /** At the middles of the faces, and at that of the cell. */
      std::vector<Vector3> normals;
    };

    /** A part of a patch; sign = -1: of the opposite orientation. */
    struct Member
    {
      CellPart part;
      double   sign;
    };

    /** A neighbour across a face, and its face. */
    using Neighbor = std::pair<CellPart, unsigned int>;

    /** Computed when first asked for. */
    const Samples &
    samples(const CellPart &part);

    /** Where moments are taken on a part of a divided cell. */
    Quadrature<dim>
    sample_points_of(const CellPart &part) const;

    std::vector<Neighbor>
    neighbors(const CellPart &part, const unsigned int face) const;

    /** The parts at the corners of a part, and behind its edges. */
    std::set<unsigned int>
    parts_around(const CellPart &part) const;

    /** The part itself first. */
    std::vector<Member>
    patch(const CellPart &part);

    /** The members' places and moments; small parts follow others. */
    template <typename Place>
    std::pair<std::vector<Point<2>>, std::vector<Moment>>
    gather(const std::vector<Member> &members, const Place &place);

    const ShellState      state_;
    const Quadrature<dim> sample_points_;
    StrainValues          strains_;
    std::vector<std::set<Triangulation<dim, spacedim>::active_cell_iterator>>
                         cells_of_vertex_;
    std::vector<Samples> samples_; // by CellPart::index()
    std::vector<Vector3> values_;
  };
} // namespace Nacre

#endif
