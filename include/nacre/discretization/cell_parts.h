// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cell_parts_h
#define nacre_discretization_cell_parts_h

#include <nacre/discretization/cell_part.h>

#include <vector>

namespace Nacre
{
  class CutTrace;

  /**
   * The parts into which cuts divide the cells of a mesh, and the pieces of
   * edges in which they meet.
   *
   * A part is a connected component of a cell without the cuts, a piece an
   * interval of an edge in which two parts of neighbouring cells meet and
   * along which no cut runs. Cells that a cut divides or whose edges it opens
   * are *cut*; those that share a vertex with them are *touched*, since their
   * nodes may have several copies. Of all others nothing is stored.
   *
   * Parts that are removed exist no more: a cell may have no parts at all.
   */
  class CellParts
  {
  public:
    using Cell = CellPart::Cell;

    /** A mesh without cuts. */
    CellParts() = default;

    /** The parts of this rank's cells and of its ghosts. */
    CellParts(const DoFHandler<dim, spacedim> &dof_handler,
              const CutTrace                  &trace);

    /** Whether there are any cuts. */
    bool
    is_empty() const
    {
      return entry_of_cell_.empty();
    }

    bool
    is_touched(const Cell &cell) const
    {
      return !is_empty() && entry_of_cell_[cell->active_cell_index()] !=
                              numbers::invalid_unsigned_int;
    }

    /** Whether a cut divides the cell or opens one of its edges, or parts of
     * it have been removed. */
    bool
    is_cut(const Cell &cell) const
    {
      return is_touched(cell) &&
             entries_[entry_of_cell_[cell->active_cell_index()]].is_cut;
    }

    /**
     * Whether a cut ends in, divides or runs along an owned cell, or does so
     * in a cell that shares a vertex with it. Such cells have one size along
     * the cut, so that no hanging node has several copies.
     */
    bool
    is_near_cut(const Cell &cell) const
    {
      return is_touched(cell) &&
             entries_[entry_of_cell_[cell->active_cell_index()]].is_near_cut;
    }

    /** Whether the edge is met in pieces, since one of its cells is cut. */
    bool
    has_pieces(const Cell &cell, const unsigned int face) const
    {
      return !is_empty() &&
             (is_cut(cell) ||
              (!cell->at_boundary(face) && cell->neighbor(face)->is_active() &&
               is_cut(cell->neighbor(face))));
    }

    unsigned int
    n_parts(const Cell &cell) const
    {
      return is_touched(cell) ? parts(cell).size() : 1;
    }

    CellPart
    part(const Cell &cell, const unsigned int number = 0) const
    {
      return is_touched(cell) ? CellPart(cell, &parts(cell)[number]) :
                                CellPart(cell);
    }

    /** One more than the largest CellPart::index(). */
    unsigned int
    n_indices() const
    {
      return n_indices_;
    }

    /**
     * The pieces of an edge to a neighbour of the same size; none if the rank
     * doesn't know the neighbour.
     */
    std::vector<EdgePiece>
    pieces_between(const Cell &cell, const unsigned int face) const;

    /** The intervals of a face that are sides of one of its cell's parts. */
    std::vector<EdgePiece>
    pieces_of(const CellPart &part, const unsigned int face) const;

    /**
     * The lips of a part; of the part in which a tip with functions lies, those
     * behind the tip, too. Where several cuts run along a side, it is a lip of
     * the first one.
     */
    std::vector<CutLip>
    lips(const CellPart &part) const;

    /** Make a whole cell a touched one. */
    void
    touch(const Cell &cell);

    /**
     * Take parts away and make all other cells touched ones.
     * @param is_removed by CellPart::index(), of this rank's parts and ghosts
     */
    void
    remove(const DoFHandler<dim, spacedim> &dof_handler,
           const std::vector<bool>         &is_removed);

    /** Whether parts have been removed, on whatever rank. */
    bool
    are_removed() const
    {
      return are_removed_;
    }

    /** Touched cells; their parts may be completed. */
    const std::vector<Cell> &
    touched_cells() const
    {
      return touched_cells_;
    }

    std::vector<PartData> &
    parts(const Cell &cell)
    {
      return entries_[entry_of_cell_[cell->active_cell_index()]].parts;
    }

    const std::vector<PartData> &
    parts(const Cell &cell) const
    {
      return entries_[entry_of_cell_[cell->active_cell_index()]].parts;
    }

  private:
    /** What is known of a touched cell. */
    struct Entry
    {
      bool                  is_cut      = false;
      bool                  is_near_cut = false;
      std::vector<PartData> parts;
      /** By face: intervals along which a cut runs. */
      std::vector<std::vector<std::array<double, 2>>> opened;
      std::vector<std::vector<CutOpening>>            openings;
    };

    void
    add_lips_on_face(const CellPart      &part,
                     const unsigned int   face,
                     std::vector<CutLip> &lips) const;

    void
    make_entry(const Cell &cell, const CutTrace &trace);

    std::vector<Cell>         touched_cells_;
    std::vector<unsigned int> entry_of_cell_;
    std::vector<Entry>        entries_;
    unsigned int              n_indices_   = 0;
    bool                      are_removed_ = false;
  };
} // namespace Nacre

#endif
