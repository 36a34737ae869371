// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_part_points_h
#define nacre_postprocess_part_points_h

#include <nacre/discretization/cell_part.h>

#include <vector>

namespace Nacre
{
  /**
   * Points spread over a part of a divided cell. The part consists of blocks,
   * one convex quadrilateral or triangles, and each is the image of the
   * reference cell: a triangle that of a quadrilateral whose last two vertices
   * are one.
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
