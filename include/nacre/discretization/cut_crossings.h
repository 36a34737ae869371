// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_crossings_h
#define nacre_discretization_cut_crossings_h

#include <nacre/discretization/cut_path.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <array>
#include <utility>
#include <vector>

namespace Nacre
{
  /** A cut as a cell sees it: on a closed chart moved by periods. */
  struct CutImage
  {
    unsigned int       path;
    std::array<int, 2> periods;

    bool
    operator<(const CutImage &other) const
    {
      return std::make_pair(path, periods) <
             std::make_pair(other.path, other.periods);
    }

    bool
    operator==(const CutImage &other) const
    {
      return path == other.path && periods == other.periods;
    }
  };

  /** Where a cut meets an edge, or has a point of its own in a cell. */
  struct CutMark
  {
    CutImage image;
    /** Number of the leg plus the part of it, 0 to 1, along the cut. */
    double along;
    /** Parameter of the edge, or unused. */
    double s;
    /** In the reference cell of the cell that asked. */
    Point<dim> unit;
  };

  /** Finds the marks of cuts on edges and in cells. */
  class CutCrossings
  {
  public:
    using Cell = CellMaps::Cell;

    /** All arguments must live as long as the object. */
    CutCrossings(const CellMaps             &maps,
                 const std::vector<CutPath> &paths,
                 const double                snap);

    /** Whether a cut may run through the cell; quick. */
    bool
    may_cross(const Cell &cell) const;

    /**
     * The marks on a @p face of an active cell, in its own terms: s from
     * face_to_cell_vertices(face, 0, 1) on. They are found in the cell with the
     * lower id of the two that share the edge, and are the same for both but
     * for the direction of s, bit for bit. Nearer to an end than `snap` they
     * lie at the end.
     */
    std::vector<CutMark>
    on_face(const Cell &cell, const unsigned int face) const;

    /** The cuts' own points in the cell, those on its edges included. */
    std::vector<CutMark>
    inside(const Cell &cell) const;

  private:
    using Box = BoundingBox<spacedim>;
    /** Path and leg. */
    using LegOfPath = std::pair<unsigned int, unsigned int>;

    /** A leg that may be near to something. */
    struct NearLeg
    {
      CutImage     image;
      unsigned int leg;
    };

    /** An edge of a cell under one of the maps. */
    struct EdgeCurve;

    Tensor<1, spacedim>
    shift(const CutImage &image) const;

    /** The legs near to a box of the chart or of space, sorted. */
    std::vector<NearLeg>
    near_legs(const Box &box, const bool in_chart) const;

    /** The marks of one leg on an edge, unsnapped. */
    void
    add_crossings(const EdgeCurve      &edge,
                  const NearLeg        &near,
                  std::vector<CutMark> &marks) const;

    /** The marks of a cut's point number @p index on an edge. */
    void
    add_point(const EdgeCurve      &edge,
              const CutImage       &image,
              const unsigned int    index,
              std::vector<CutMark> &marks) const;

    /** The marks on an edge in the terms of @p cell. */
    std::vector<CutMark>
    marks_of(const Cell &cell, const unsigned int face) const;

    /** Snap to ends, and make one of marks that round-off alone separates. */
    void
    tidy(std::vector<CutMark> &marks) const;

    const CellMaps             &maps_;
    const std::vector<CutPath> &paths_;
    const double                snap_;
    /** In space, in the chart. */
    std::array<RTree<std::pair<Box, LegOfPath>>, 2> legs_;
  };
} // namespace Nacre

#endif
