// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_surface_projection_h
#define nacre_problem_surface_projection_h

#include <nacre/problem/parametric_surface.h>

#include <array>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * The projection of points in space onto a surface x(u, v): the nearest
   * point, where the tangents are normal to the difference,
   *   x,a . (p - x) = 0.
   * The surface goes on beyond its edges as far as its map does.
   */
  class SurfaceProjection
  {
  public:
    /** @param where the surface's subsection, for messages */
    SurfaceProjection(SurfaceDescription &&surface, const std::string &where);

    /** The nearest point of the surface; throws if none is found. */
    Point<3>
    operator()(const Point<3> &point) const;

  private:
    /** A point of a coarse cell from which the search may start. */
    struct Sample
    {
      unsigned int cell;
      Point<2>     unit;
      Point<3>     position;
    };

    /** x,u and x,v in the reference coordinates of a coarse cell. */
    std::array<Tensor<1, 3>, 2>
    tangents(const unsigned int cell, const Point<2> &unit) const;

    const ParametricSurface surface_;
    const std::string       where_;
    std::vector<Sample>     samples_;
  };
} // namespace Nacre

#endif
