// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_part_points_h
#define nacre_postprocess_part_points_h

#include <nacre/discretization/cell_part.h>

#include <vector>

namespace Nacre
{
  /**
   * Whether a part isn't shown as a whole cell: it is one of a divided cell, or
   * the crack goes on inside of it up to a tip that has functions.
   */
  bool
  has_blocks(const CellPart &part);

  /**
   * Points spread over a part that has_blocks(). It consists of one convex
   * quadrilateral or of triangles, those around the tip if one lies inside, and
   * each is the image of the reference cell: a triangle that of a quadrilateral
   * whose last two vertices are one. Points at a crack that ends inside of the
   * cell are those of the lip of their triangle.
   * @param points in the reference cell
   * @return their images on all blocks, one block after the other; of whole
   *   cells the @p points themselves
   */
  std::vector<Point<dim>>
  points_on_part(const CellPart &part, const std::vector<Point<dim>> &points);

  /** The centre of the area of a polygon. */
  Point<dim>
  centroid(const CellPolygon &polygon);
} // namespace Nacre

#endif
