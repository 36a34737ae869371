// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cell_part_h
#define nacre_discretization_cell_part_h

#include <nacre/discretization/cell_polygon.h>

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace Nacre
{
  struct PartEnrichment;

  /** What cuts make of a cell that they divide or touch. */
  struct PartData
  {
    /** The part in the reference cell; none: all of the cell. */
    std::optional<CellPolygon> polygon;
    /** Area of the polygon over that of the reference cell. */
    double fraction = 1.;
    /** Number among the parts of the cell. */
    unsigned int number = 0;
    /** CellPart::index(). */
    unsigned int index = 0;
    /** In the order of the cell's local dofs; those of tip functions follow. */
    std::vector<types::global_dof_index> dofs;
    /** Positions X0 (length) of the nodes; empty: those of the cell. */
    std::vector<Point<spacedim>> nodes;
    /** Functions of tips; null: none. */
    std::shared_ptr<const PartEnrichment> enrichment;
  };

  /**
   * A cell of the shell, or one of the parts into which cuts divide it. Each
   * part carries the whole polynomial space of its cell, with dofs of its own
   * where the cuts separate it from its neighbours.
   */
  struct CellPart
  {
    using Cell = DoFHandler<dim, spacedim>::active_cell_iterator;

    CellPart() = default;

    /** A whole cell that no cut touches. */
    CellPart(const Cell &cell)
      : cell(cell)
    {}

    /** The same of a cell's neighbour, say, which is active. */
    CellPart(const DoFHandler<dim, spacedim>::cell_iterator &cell)
      : cell(cell)
    {}

    CellPart(const Cell &cell, const PartData *data)
      : cell(cell)
      , data(data)
    {}

    Cell cell;
    /** Null: the cell is what it is without cuts. */
    const PartData *data = nullptr;

    /** Whether it is a part of a divided cell. */
    bool
    is_cut() const
    {
      return data != nullptr && data->polygon.has_value();
    }

    const CellPolygon &
    polygon() const
    {
      return *data->polygon;
    }

    /** That of the part, or of the whole cell. */
    CellPolygon
    outline() const
    {
      return is_cut() ? polygon() : CellPolygon::whole(cell->reference_cell());
    }

    /** A point inside, in the reference cell. */
    Point<dim>
    inner_point() const
    {
      return is_cut() ? polygon().inner_point() :
                        cell->reference_cell().template barycenter<dim>();
    }

    /** Its tip functions; null: none. */
    const PartEnrichment *
    enrichment() const
    {
      return data != nullptr ? data->enrichment.get() : nullptr;
    }

    /**
     * Number among this rank's parts, for tables: the active cell index of
     * first parts, numbers beyond those for others.
     */
    unsigned int
    index() const
    {
      return data != nullptr ? data->index : cell->active_cell_index();
    }
  };

  /**
   * A straight piece of a lip: a side of a part along which a cut runs, within
   * the cell or along one of its edges.
   */
  struct CutLip
  {
    /** In the reference cell. */
    Point<dim> begin;
    /** From there to the other end; the part lies on the left. */
    Tensor<1, dim> along;
    /** Number of the cut. */
    unsigned int cut;
    /**
     * Whether the part lies on the left of who walks along the cut on the side
     * of t0.
     */
    bool is_left;
  };

  /**
   * An interval of an edge in which two parts of neighbouring cells meet, or
   * in which a part meets the boundary.
   */
  struct EdgePiece
  {
    EdgePiece() = default;

    /** A whole edge of one side. */
    EdgePiece(const CellPart &part, const unsigned int face)
    {
      sides[0].part = part;
      sides[0].face = face;
    }

    struct Side
    {
      CellPart     part;
      unsigned int face = numbers::invalid_unsigned_int;
      /**
       * Its ends in the coordinate of the face, which goes from 0 to 1 from the
       * face's first vertex to its second one; the same points on both sides.
       */
      std::array<double, 2> interval{{0., 1.}};
    };

    std::array<Side, 2> sides;
    unsigned int        n_sides = 1;
    /** Number among the pieces of the part's face. */
    unsigned int number = 0;

    /** What tables of boundary edges are keyed by. */
    std::pair<unsigned int, unsigned int>
    place() const
    {
      const auto &side = sides[0];
      return {side.part.index(),
              side.face + number * side.part.cell->n_faces()};
    }
  };
} // namespace Nacre

#endif
