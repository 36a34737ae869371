// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_numbering_h
#define nacre_discretization_part_numbering_h

#include <nacre/discretization/cell_parts.h>
#include <nacre/discretization/mesh_nodes.h>

#include <deal.II/base/index_set.h>

#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace Nacre
{
  /** A node of a part of a touched cell. */
  struct PartNode
  {
    CellPart::Cell cell;
    unsigned int   part;
    unsigned int   node;
  };

  /** Nodes that two parts which share a piece don't share. */
  class SplitNodes
  {
  public:
    /**
     * The node whose first dof of the DoFHandler is @p dof, of the whole cell
     * @p cell and of the part number @p neighbor_part behind its @p face.
     */
    void
    insert(const CellId                 &cell,
           const unsigned int            face,
           const unsigned int            neighbor_part,
           const types::global_dof_index dof)
    {
      nodes_.emplace(cell, face, neighbor_part, dof);
      faces_.emplace(cell, face);
      dofs_.insert(dof);
    }

    bool
    is_empty() const
    {
      return nodes_.empty();
    }

    /** Whether it is the first dof of such a node. */
    bool
    has(const types::global_dof_index dof) const
    {
      return dofs_.count(dof) > 0;
    }

    bool
    contains(const CellId                 &cell,
             const unsigned int            face,
             const unsigned int            neighbor_part,
             const types::global_dof_index dof) const
    {
      return !nodes_.empty() &&
             nodes_.count({cell, face, neighbor_part, dof}) > 0;
    }

    /** The same of a piece, whichever of its sides is the whole cell's. */
    bool
    contains(const EdgePiece &piece, const types::global_dof_index dof) const
    {
      const auto &[a, b] = piece.sides;
      return !nodes_.empty() &&
             (contains(a.part.cell->id(), a.face, b.part.data->number, dof) ||
              contains(b.part.cell->id(), b.face, a.part.data->number, dof));
    }

    /** Whether the cell has such nodes on the face. */
    bool
    is_at(const CellPart::Cell &cell, const unsigned int face) const
    {
      return !faces_.empty() && faces_.count({cell->id(), face}) > 0;
    }

  private:
    std::set<
      std::tuple<CellId, unsigned int, unsigned int, types::global_dof_index>>
                                              nodes_;
    std::set<std::pair<CellId, unsigned int>> faces_;
    std::set<types::global_dof_index>         dofs_;
  };

  /**
   * The numbers of the dofs of parts. Nodes of two parts are one node exactly
   * if the parts share a piece of an edge that holds the node, directly or by
   * other parts; so a node has as many copies as there are sides around it:
   * one ahead of a tip, two at a cut, four at a crossing.
   *
   * The first copy keeps the place of the DoFHandler's dofs in the range of
   * their owner, whose further copies follow at the end of its range. A copy
   * belongs to the rank of the lowest of its cells, the first one to the rank
   * that has the DoFHandler's dofs.
   *
   * Where parts are removed, their dofs don't exist: the dofs that remain keep
   * the order of the DoFHandler's, those of first copies before the others.
   */
  class PartNumbering
  {
  public:
    /**
     * Without cuts: the numbers of the DoFHandler. With cuts it sets
     * PartData::dofs; collective.
     * @param n_functions further dofs of this rank, behind those of its nodes
     * @param split_nodes they have copies of their own
     */
    PartNumbering(const MeshNodes   &mesh,
                  CellParts         &parts,
                  const unsigned int n_functions = 0,
                  const SplitNodes  &split_nodes = SplitNodes());

    const SplitNodes &
    split_nodes() const
    {
      return split_nodes_;
    }

    /** Where the ranges of dofs of the ranks end. */
    std::vector<types::global_dof_index>
    ends_of_ranks() const
    {
      return {new_starts_.begin() + 1, new_starts_.end()};
    }

    /** Count dofs of further functions among the relevant ones. */
    void
    add_relevant_dofs(const IndexSet &dofs)
    {
      locally_relevant_dofs_.add_indices(dofs);
      locally_relevant_dofs_.compress();
    }

    /**
     * All parts that hold a copy, of nodes of this rank's cut cells; of all its
     * nodes where parts are removed.
     */
    using Copies = std::vector<std::vector<PartNode>>;

    const Copies &
    copies() const
    {
      return copies_;
    }

    types::global_dof_index
    n_dofs() const
    {
      return new_starts_.back();
    }

    const IndexSet &
    locally_owned_dofs() const
    {
      return locally_owned_dofs_;
    }

    /** Those of this rank's cells and ghosts, and those of the rank. */
    const IndexSet &
    locally_relevant_dofs() const
    {
      return locally_relevant_dofs_;
    }

    /**
     * The number of a dof of the DoFHandler that has no further copies;
     * invalid for a removed one.
     */
    types::global_dof_index
    number_of(const types::global_dof_index dof) const;

  private:
    using Dof = types::global_dof_index;

    struct Copy;
    class Nodes;

    /** Join the nodes of parts that share a piece. */
    void
    join_across_pieces(const CellParts &parts, Nodes &nodes) const;

    /** Join the nodes of whole cells that share an edge. */
    void
    join_across_edges(const CellParts &parts, Nodes &nodes) const;

    /**
     * The copies of each node of cut cells, where parts are removed of each
     * node, by the node's first dof.
     */
    std::map<Dof, std::vector<Copy>>
    find_copies(const CellParts &parts) const;

    /** The first copy of a node first, and its owner. */
    void
    sort(const Dof dof, std::vector<Copy> &copies) const;

    /** Numbers of the copies that this rank owns. */
    void
    number_copies(std::map<Dof, std::vector<Copy>> &copies,
                  const unsigned int                n_functions);

    void
    set_dofs(std::map<Dof, std::vector<Copy>> &copies, CellParts &parts);

    void
    exchange(CellParts &parts) const;

    void
    make_index_sets(const CellParts &parts);

    const MeshNodes mesh_;
    unsigned int    n_nodes_;
    /** First dofs of all ranks, and the end: the DoFHandler's and ours. */
    std::vector<Dof> old_starts_;
    std::vector<Dof> new_starts_;
    IndexSet         locally_owned_dofs_;
    IndexSet         locally_relevant_dofs_;
    Copies           copies_;
    SplitNodes       split_nodes_;
    /** Where parts are removed: the numbers of dofs of uncut cells. */
    bool                         are_removed_ = false;
    std::unordered_map<Dof, Dof> numbers_;
  };
} // namespace Nacre

#endif
