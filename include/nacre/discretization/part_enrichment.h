// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_enrichment_h
#define nacre_discretization_part_enrichment_h

#include <nacre/discretization/cell_polygon.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/discretization/tip_functions.h>

#include <deal.II/base/quadrature.h>

#include <memory>
#include <vector>

namespace Nacre
{
  struct CellPart;

  /**
   * What the tips of cuts add to the displacements of a part, (C.4) of
   * doc/cutting.md:
   *
   *   u_h = sum_a N_a u_a + sum_k c_k psi_k,
   *   psi_k = chi (F_k - sum_a N_a F_k(X_a)).
   *
   * or of the cell in which a cut ends, (C.4') there, with the functions psi_i
   * of the tip that are 1 on the left of the crack and 0 on its right,
   *
   *   psi_ai = N_a psi_i e_i  or  N_a (1 - psi_i) e_i.
   *
   * Functions of a tip that are scalars, TipFunctions, are shape functions as
   * those of nodes are, and have vectors c_k.
   *
   * The psi_k vanish at the nodes. Their scalar dofs c_k (length) belong to the
   * tip and are those of all its parts; they follow the nodes' dofs.
   */
  struct PartEnrichment
  {
    /** chi = chi_0 + chi_1 xi_1 + chi_2 xi_2 + chi_3 xi_1 xi_2. */
    using Cutoff = std::array<double, 4>;

    static double
    chi(const Cutoff &cutoff, const Point<dim> &unit)
    {
      return cutoff[0] + cutoff[1] * unit[0] + cutoff[2] * unit[1] +
             cutoff[3] * unit[0] * unit[1];
    }

    /** What one tip adds. */
    struct Share
    {
      std::shared_ptr<const TipFunctions> functions;
      /** The sheet, as TipFunctions takes it. */
      int    side = 0;
      Cutoff cutoff{};
      /** F_k(X_a) as [a][k]. */
      std::vector<std::vector<Tensor<1, 3>>> at_nodes;
      /** A node of the edge by which the crack enters the cell. */
      struct OpenNode
      {
        unsigned int node;
        /** Whether its copy elsewhere stands for the left of the crack. */
        bool opens_left;
      };
      /** If there are any, these psi_ai are the functions. */
      std::vector<OpenNode> open_nodes;
      /** Whether the cell is the tip's or shares a vertex with that. */
      bool is_near = false;
      /** Coordinates of the tip, beyond the cell in others than the tip's. */
      Point<dim> tip;
      /** Backward along the crack; where the tip lies inside. */
      Tensor<1, dim> backward;
      bool           holds_tip = false;
      /** Number of the tip's cut, and whether the tip is its end. */
      unsigned int cut    = numbers::invalid_unsigned_int;
      bool         at_end = false;

      /** Of the coefficients c_k, three for each scalar function. */
      unsigned int
      n_functions() const
      {
        return open_nodes.empty() ? functions->size() :
                                    spacedim * open_nodes.size();
      }
    };

    std::vector<Share> shares;

    unsigned int
    n_functions() const
    {
      unsigned int n = 0;
      for (const auto &share : shares)
        n += share.n_functions();
      return n;
    }

    /** Whether the functions are scalars, of all tips or of none. */
    bool
    has_scalars() const
    {
      return shares.front().functions->are_scalars();
    }

    /**
     * The functions psi_k at a point, appended to @p result; f_k e_x of scalar
     * ones.
     * @param q the point's number in @p shapes and @p geometry
     * @param lip of a point on a lip in the cell that holds the tip, which is
     *   on its left: CutLip::along
     */
    void
    evaluate(const ShapeTable              &shapes,
             const GeometryTable::Values   &geometry,
             const unsigned int             q,
             const Point<dim>              &unit,
             std::vector<FieldDerivatives> &result,
             const Tensor<1, dim>          &lip = {}) const;
  };

  /** Where the crack enters the part that holds its tip. */
  Point<dim>
  crack_entry(const PartEnrichment::Share &share, const CellPolygon &outline);

  /**
   * A rule of a part that has tip functions: in cells near to a tip, triangles
   * that fan out from the point nearest to the tip, with the square of the
   * radius as coordinate; in others, that of part_quadrature() with points
   * more.
   * @param degree of the displacements
   */
  Quadrature<dim>
  enriched_quadrature(const CellPart &part, const unsigned int degree);

  /**
   * A rule of an edge or a piece of it that has tip functions: near to a tip,
   * of intervals that get smaller towards the point nearest to it.
   * @param begin, end of the piece in the part's reference cell
   */
  Quadrature<1>
  enriched_edge_quadrature(const PartEnrichment &enrichment,
                           const Point<dim>     &begin,
                           const Point<dim>     &end,
                           const unsigned int    degree);
} // namespace Nacre

#endif
