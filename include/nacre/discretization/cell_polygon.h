// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cell_polygon_h
#define nacre_discretization_cell_polygon_h

#include <nacre/base/types.h>

#include <deal.II/base/point.h>

#include <deal.II/grid/reference_cell.h>

#include <array>
#include <vector>

namespace Nacre
{
  /** A polyline through a reference cell, along which it is cut. */
  struct CutChain
  {
    /** At least two; a closed chain ends with its first point. */
    std::vector<Point<dim>> points;
    /** Number of the cut. */
    unsigned int cut;
  };

  /** An interval of a face of a cell along which a cut runs. */
  struct CutOpening
  {
    /** As CellPolygon::intervals(). */
    double begin, end;
    /** Number of the cut. */
    unsigned int cut;
    /** Whether the cut runs from the begin to the end. */
    bool is_forward;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &begin &end &cut &is_forward;
    }
  };

  /**
   * A part of a reference cell between cuts. Its vertices run
   * counterclockwise; it may be non-convex and may touch itself in a vertex.
   * Lengths and areas are those of the reference cell, whose edges have the
   * length 1. Points closer than 1e-10 are one.
   */
  class CellPolygon
  {
  public:
    /** What the side from the vertex i to the vertex i + 1 lies on. */
    struct Side
    {
      /** Face of the reference cell; invalid_unsigned_int: a lip of a cut. */
      unsigned int face;
      /** Number of the cut of a lip; else invalid_unsigned_int. */
      unsigned int cut;
      /**
       * Of a lip: whether the cut runs along the side, so that the polygon
       * lies on the left of the cut.
       */
      bool is_left = false;
    };

    /** Vertices between two sides in one line on the same are left out. */
    CellPolygon(const ReferenceCell    &cell,
                std::vector<Point<dim>> vertices,
                std::vector<Side>       sides);

    /** The whole quadrilateral or triangle. */
    static CellPolygon
    whole(const ReferenceCell &cell);

    const ReferenceCell &
    reference_cell() const
    {
      return cell_;
    }

    unsigned int
    n_vertices() const
    {
      return vertices_.size();
    }

    const Point<dim> &
    vertex(const unsigned int i) const
    {
      return vertices_[i];
    }

    const std::vector<Point<dim>> &
    vertices() const
    {
      return vertices_;
    }

    const Side &
    side(const unsigned int i) const
    {
      return sides_[i];
    }

    double
    area() const;

    /** Whether @p x lies inside or at most @p tolerance away from a side. */
    bool
    contains(const Point<dim> &x, const double tolerance) const;

    /** The centroid of the largest of the triangles(). */
    Point<dim>
    inner_point() const;

    /**
     * The parts along a chain, in the order of divide(). The chain is clipped
     * to the polygon; what doesn't run from boundary to boundary divides
     * nothing.
     */
    std::vector<CellPolygon>
    split(const CutChain &chain) const;

    /**
     * Intervals [s0, s1] of the @p face that are sides of the polygon, merged
     * and ascending; s runs from the face's vertex 0 to its vertex 1 (those of
     * ReferenceCell::face_to_cell_vertices(face, ., 1)).
     */
    std::vector<std::array<double, 2>>
    intervals(const unsigned int face) const;

    /** Triangles by cutting off ears, the best shaped first; none is flat. */
    std::vector<std::array<Point<dim>, 3>>
    triangles() const;

  private:
    ReferenceCell           cell_;
    std::vector<Point<dim>> vertices_;
    std::vector<Side>       sides_;
  };

  /** How far @p x is away from a polygon; 0 inside. */
  double
  distance_to_polygon(const std::vector<Point<dim>> &vertices,
                      const Point<dim>              &x);

  /**
   * The parts of a reference cell that chains cut all together. Chains may
   * cross each other and themselves, end on each other, touch the boundary,
   * run through vertices, have kinks. Only the segments that separate two
   * parts remain as lips. A segment along a face divides nothing.
   *
   * Parts are sorted along a fixed direction by their centroids: neither the
   * chains' order nor their directions matter. Parts below an area of 1e-14
   * don't arise.
   *
   * @throws ExcMessage if a closed chain makes a hole in a part
   */
  std::vector<CellPolygon>
  divide(const ReferenceCell &cell, const std::vector<CutChain> &chains);
} // namespace Nacre

#endif
