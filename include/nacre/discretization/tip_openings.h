// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_openings_h
#define nacre_discretization_tip_openings_h

#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/mesh_nodes.h>
#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/part_numbering.h>
#include <nacre/discretization/tip_dofs.h>
#include <nacre/problem/cuts.h>

#include <deal.II/lac/affine_constraints.h>

#include <memory>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * The cells in which cuts end, opened by harmonic functions, (C.4') of
   * doc/cutting.md. A crack enters its last cell L by an edge or a vertex. The
   * nodes a there keep their copies u_a^left, u_a^right of the cells behind:
   *
   *   u_h = sum_a N_a u_a + sum_{a on the edge} sum_i N_a q_ai e_i d_ai,
   *   d_ai = e_i . (u_a^other - u_a),
   *
   * u_a the copy of the side on which the node lies, and q_ai the function
   * psi_i of the other side, psi_i on the left and 1 - psi_i on the right. The
   * psi_i are 1 and 0 on the edges beside the crack, hence u_h is continuous.
   * The d_ai are dofs of L that are constrained to what they are.
   *
   * A tip on an edge needs no function. Where the functions can't be fitted to
   * their conditions, or where no edge is free of other cuts, the crack closes
   * as it does without.
   */
  class TipOpenings : public TipDofs
  {
  public:
    /** Collective. */
    TipOpenings(const MeshNodes                  &mesh,
                const Cuts                       &cuts,
                const std::vector<CutTrace::Tip> &tips,
                const CellParts                  &parts);

    /** Nodes that the last cells don't share with parts behind them. */
    const SplitNodes &
    split_nodes() const
    {
      return split_nodes_;
    }

    void
    complete(const std::vector<Dof> &ends, CellParts &parts) override;

    /** The dofs of nodes that those of functions follow, of all ranks. */
    const IndexSet &
    masters() const
    {
      return masters_;
    }

    /** Add the lines of d_ai of this rank's cells. */
    void
    add_to(AffineConstraints<double> &constraints) const;

    /** Whether the discrete crack ends where the cut does. */
    bool
    opens(const CutTrace::Tip &tip) const;

    /** A sentence for each tip inside of a cell that stays closed. */
    std::vector<std::string>
    remarks(const Cuts &cuts) const;

  private:
    using Cell     = CellPart::Cell;
    using OpenNode = PartEnrichment::Share::OpenNode;

    /** How a crack enters the cell in which it ends. */
    struct Entry
    {
      /** The edge; none: by a vertex. */
      unsigned int face = numbers::invalid_unsigned_int;
      /** In the reference cell. */
      Point<dim> place;
      /** By OpenNode: the face, and the part behind it that isn't shared. */
      std::vector<OpenNode>     nodes;
      std::vector<unsigned int> faces;
      std::vector<unsigned int> parts;
    };

    struct Opening
    {
      bool                                is_open   = false;
      bool                                is_inside = false;
      Cell                                cell;
      Entry                               entry;
      std::shared_ptr<const TipFunctions> functions;
      /** Of this rank's cells: dofs of a node here, and of its other copy. */
      std::vector<std::array<std::array<Dof, spacedim>, 2>> copies;
    };

    /** The entry of the tip @p t into @p cell; false: not a simple one. */
    bool
    find_entry(const unsigned int t, const Cell &cell, Entry &entry) const;

    bool
    find_edge(const unsigned int t, const Cell &cell, Entry &entry) const;

    bool
    find_vertex(const unsigned int t, const Cell &cell, Entry &entry) const;

    /** The functions psi_i; returns whether they obey their conditions. */
    bool
    fit(const unsigned int t, const Cuts &cuts, const Cell &cell);

    bool
    is_left(const unsigned int t,
            const Point<dim>  &entry,
            const Point<dim>  &x) const;

    /** The two faces on which psi_i is 1 and 0. */
    static std::vector<unsigned int>
    adjacent_faces(const Entry &entry);

    /** Tell all ranks what owners found. */
    void
    share();

    void
    complete_cell(const unsigned int t, const Cell &cell, CellParts &parts);

    const MeshNodes                   mesh_;
    const std::vector<CutTrace::Tip> &tips_;
    const CellParts                  &parts_;
    std::vector<Opening>              openings_; // by tip
    SplitNodes                        split_nodes_;
    IndexSet                          masters_;
  };
} // namespace Nacre

#endif
