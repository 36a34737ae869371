// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_extension_h
#define nacre_discretization_part_extension_h

#include <nacre/discretization/part_numbering.h>
#include <nacre/discretization/tip_patches.h>

#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace Nacre
{
  /**
   * The point xi, in or near the reference cell, at which the polynomial
   * geometry of @p nodes (length) is nearest to @p target: Gauss-Newton.
   */
  Point<dim>
  continued_point(const FiniteElement<dim, spacedim> &fe,
                  const std::vector<Point<spacedim>> &nodes,
                  const Point<spacedim>              &target);

  /**
   * Small parts follow larger neighbours. A part below a fraction of its cell
   * is bad; its root is a good part, reached by the longest pieces. A node that
   * no good part holds follows the root's polynomial,
   *
   *     u_s = sum_a N_a^root(xi_root(X_s)) u_a,
   *
   * xi_root the point of the root's continued geometry nearest to the node
   * (C.3). So does its position, so that rigid motions stay in the space.
   * Badia, Verdugo, Martin (2018) call it aggregation.
   */
  class PartExtension
  {
  public:
    /** Collective; sets PartData::nodes of parts that have such nodes. */
    PartExtension(const MeshNodes     &mesh,
                  const double         smallest_part,
                  const PartNumbering &numbering,
                  CellParts           &parts);

    /** The dofs that nodes of any rank follow; collective. */
    IndexSet
    masters_of_all_ranks() const;

    /** Add the lines of this rank's cells. @param tips null: none */
    void
    add_to(AffineConstraints<double> &constraints,
           const TipPatches *const    tips) const;

    unsigned int
    n_nodes() const
    {
      return lines_.size();
    }

  private:
    using Dof = types::global_dof_index;

    /** The good part that a part follows. */
    struct Root
    {
      bool                         is_known = false;
      CellId                       cell;
      unsigned int                 part = 0;
      std::vector<Dof>             dofs;
      std::vector<Point<spacedim>> nodes;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &is_known &cell &part &dofs &nodes;
      }
    };

    /** A node that follows: its dofs, and weights of the root's nodes. */
    using Line = TipPatches::Line;

    /** The roots of all parts, by CellPart::index(). */
    void
    find_roots();

    /** One round of asking neighbours; returns whether anything changed. */
    bool
    ask_neighbors(const bool crosses_split_nodes);

    void
    exchange_roots();

    void
    make_lines(const PartNumbering &numbering);

    void
    exchange_nodes();

    bool
    is_good(const PartData &part) const
    {
      return part.fraction >= smallest_part_;
    }

    const MeshNodes   mesh_;
    const double      smallest_part_;
    const Dof         n_dofs_;
    const SplitNodes &split_nodes_;
    CellParts        &parts_;
    std::vector<Root> roots_;
    std::vector<Line> lines_;
  };
} // namespace Nacre

#endif
