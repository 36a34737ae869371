// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_trace_h
#define nacre_discretization_cut_trace_h

#include <nacre/discretization/cell_polygon.h>
#include <nacre/discretization/cut_path.h>

#include <deal.II/grid/cell_id.h>

#include <array>
#include <vector>

namespace Nacre
{
  /**
   * Where the cuts run through the cells of a mesh: chains of straight segments
   * in reference cells, opened intervals of edges, tips.
   *
   * A cut's crossings with an edge are computed from the edge as the cell with
   * the lower CellId sees it, and its parameter is a multiple of 2^-50, so that
   * s and 1 - s are exact: both cells and all ranks have the same numbers. A
   * crossing nearer to a vertex than Cuts::snap moves into it. Between two
   * places of one edge a cut opens the edge; else it is a chain.
   */
  class CutTrace
  {
  public:
    using Cell = Triangulation<dim, spacedim>::active_cell_iterator;

    /** An end of a cut inside the surface, and on no other cut. */
    struct Tip
    {
      /** Number of the cut. */
      unsigned int cut;
      /** Whether it is the last point of the cut, not the first. */
      bool            at_end;
      Point<spacedim> position;
      /** Tangent of the surface ahead of the tip, of length 1. */
      Tensor<1, spacedim> direction;
      /**
       * The cell in which the cut ends, or along whose edge; the lowest of
       * them.
       */
      CellId cell;
      /** In its reference cell. */
      Point<dim> unit;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &cut &at_end &position &direction &cell &unit;
      }
    };

    /** A piece of a cut, for output. */
    struct Line
    {
      unsigned int                 cut;
      std::vector<Point<spacedim>> points;
    };

    /**
     * Trace the @p cuts through the owned cells of @p mesh and tell neighbours
     * on other ranks; collective. Throws if a cut has no part in the surface,
     * if cells at the vertices of a cut one are of another size, and as
     * make_cut_paths() does.
     */
    CutTrace(const parallel::TriangulationBase<dim, spacedim> &mesh,
             const CellMaps                                   &maps,
             const Cuts                                       &cuts);

    /** The chains of an owned or ghost cell. */
    const std::vector<CutChain> &
    chains(const unsigned int active_cell_index) const
    {
      return chains_[active_cell_index];
    }

    /**
     * Intervals [s0, s1] of the @p face of an owned or ghost cell along which a
     * cut runs; s is 0 at face_to_cell_vertices(face, 0, 1) and 1 at
     * face_to_cell_vertices(face, 1, 1). Sorted and disjoint; both cells of an
     * edge say the same. None on the surface's boundary.
     */
    const std::vector<std::array<double, 2>> &
    opened(const unsigned int active_cell_index, const unsigned int face) const
    {
      return opened_[active_cell_index][face];
    }

    /** The same by cut, and in its order; those of one cut may overlap. */
    const std::vector<CutOpening> &
    openings(const unsigned int active_cell_index,
             const unsigned int face) const
    {
      return openings_[active_cell_index][face];
    }

    /** The same on all ranks, by cut and the begin first. */
    const std::vector<Tip> &
    tips() const
    {
      return tips_;
    }

    /** The cuts in this rank's cells, each piece once. */
    const std::vector<Line> &
    lines() const
    {
      return lines_;
    }

    /** Whether a cell has a chain or an opened edge. */
    bool
    is_cut(const unsigned int active_cell_index) const;

  private:
    class Tracer;

    std::vector<std::vector<CutChain>>                           chains_;
    std::vector<std::vector<std::vector<std::array<double, 2>>>> opened_;
    std::vector<std::vector<std::vector<CutOpening>>>            openings_;
    std::vector<Tip>                                             tips_;
    std::vector<Line>                                            lines_;
  };
} // namespace Nacre

#endif
