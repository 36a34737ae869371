// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_coarse_cell_h
#define nacre_problem_coarse_cell_h

#include <nacre/base/types.h>

#include <array>
#include <vector>

/**
 * Coarse cells given by the points at their nodes: triangles with 3 or 6, and
 * quadrilaterals with 4 or 9 points. First come the corners in deal.II's
 * order, (0,0), (1,0), (0,1), (1,1) and without the last for triangles; then
 * the middles of the sides in deal.II's order of lines; then the centre.
 */
namespace Nacre::CoarseCell
{
  /** A side as one walks around the cell counterclockwise. */
  struct Side
  {
    std::array<unsigned int, 2> corners;
    /** Index of its middle among the points of a second-order cell. */
    unsigned int middle;
  };

  /** The sides of a cell of @p n_corners (3 or 4) corners. */
  const std::vector<Side> &
  sides(const unsigned int n_corners);

  /** The reference point of a corner. */
  Point<2>
  unit_corner(const unsigned int n_corners, const unsigned int corner);

  /**
   * The isoparametric position (18), sum_a N_a(unit) points_a, with the
   * Lagrange functions of degree one or two.
   */
  Point<3>
  position(const std::vector<Point<3>> &points, const Point<2> &unit);

  /** Derivatives of position() along the two reference coordinates. */
  std::array<Tensor<1, 3>, 2>
  tangents(const std::vector<Point<3>> &points, const Point<2> &unit);

  /**
   * The centre that the 8-node serendipity functions give,
   * -1/4 sum of the corners + 1/2 sum of the middles: with it an 8-node cell
   * is a 9-node cell. @p points holds at least the eight.
   */
  Point<3>
  serendipity_centre(const std::vector<Point<3>> &points);

  /** The points' indices in a cell of @p n_points turned over. */
  const std::vector<unsigned int> &
  turned_over(const unsigned int n_points);
} // namespace Nacre::CoarseCell

#endif
