// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_patches_h
#define nacre_discretization_tip_patches_h

#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/mesh_nodes.h>
#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/tip_dofs.h>
#include <nacre/problem/cuts.h>

#include <deal.II/lac/affine_constraints.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * The cells around the tips of cuts that have tip functions. The cut-off chi
   * is 1 on the tip's cell, on all cells that share a vertex with it and at
   * vertices nearer to the tip than Cuts::tip_radius, and linear, or bilinear,
   * down to 0 in the cells around: the interpolation error F - I_h F alone is
   * blended, and the cells beside the edge on which the discrete crack closes
   * have F whole.
   */
  class TipPatches : public TipDofs
  {
  public:
    /**
     * Collective. Makes the cells of the patches touched ones. Throws if a
     * patch has cells of several sizes, holds the tip's cell of another cut or
     * turns by more than 60 degrees, and if a cut turns in the cell in which it
     * ends.
     */
    TipPatches(const MeshNodes                   &mesh,
               const Cuts                        &cuts,
               const std::vector<CutTrace::Tip>  &tips,
               const std::vector<CutTrace::Line> &lines,
               CellParts                         &parts);

    void
    complete(const std::vector<Dof> &ends, CellParts &parts) override;

    /** Of the tip @p t, of whatever rank. */
    const std::shared_ptr<const TipFunctions> &
    functions(const unsigned int t) const
    {
      return patches_[t].functions;
    }

    /** A node that follows others, u_s = sum_a C_sa u_a, and their places. */
    struct Line
    {
      std::array<Dof, spacedim>              dofs;
      Point<spacedim>                        position;
      std::vector<std::array<Dof, spacedim>> masters;
      std::vector<Point<spacedim>>           master_positions;
      std::vector<double>                    weights;
    };

    /**
     * Let the regular part of the displacements obey the line of a small part,
     *
     *   u_s - sum_k c_k F_k(X_s) = sum_a C_sa (u_a - sum_k c_k F_k(X_a)):
     *
     * the c_k are further masters of the constrained dof, (C.7).
     */
    void
    add_to_line(const Line &line, AffineConstraints<double> &constraints) const;

  private:
    using Cell = CellPart::Cell;

    /** A tip, known to all ranks. */
    struct Patch
    {
      TipFunctions::Tip frame;
      double            poissons_ratio = 0.;
      double            size           = 0.;
      std::set<Dof>     tip_vertices;
      /** Where chi = 1. */
      std::set<Dof>                       whole_vertices;
      std::shared_ptr<const TipFunctions> functions;
      /** From the tip backward along the cut. */
      std::vector<Point<spacedim>> path;
      /** Sides of the nodes, by their first dofs. */
      std::map<Dof, int> side_of_node;
    };

    void
    find_frames(const Cuts &cuts);

    void
    share_frames();

    /** @param radius up to which chi = 1 */
    void
    find_vertices(const double radius);

    void
    check(const Cuts &cuts) const;

    /** Whether the surface around a tip is nearly its tangent plane. */
    void
    check_turn(const Cuts &cuts, const unsigned int t, const Cell &cell) const;

    void
    check_bends(const Cuts &cuts) const;

    /** Begins messages about a tip. */
    std::string
    where(const Cuts &cuts, const unsigned int t) const;

    /** @param radius (length) that the path is to reach */
    void
    make_path(const std::vector<CutTrace::Line> &lines,
              const double                       radius,
              const unsigned int                 t);

    /** Of the patch's vertices, in the cell. */
    std::vector<bool>
    vertices_in(const std::set<Dof> &vertices, const Cell &cell) const;

    bool
    is_in(const Patch &patch, const Cell &cell) const;

    /** The sheet of a part; 0 where the tip lies inside. */
    int
    side_of(const unsigned int t,
            const CellPart    &part,
            const bool         is_cut) const;

    void
    find_sides_of_nodes(const CellParts &parts);

    PartEnrichment::Share
    make_share(const unsigned int t,
               const CellPart    &part,
               const bool         is_cut) const;

    const MeshNodes                   mesh_;
    const std::vector<CutTrace::Tip> &tips_;
    std::vector<Patch>                patches_; // by tip
  };
} // namespace Nacre

#endif
