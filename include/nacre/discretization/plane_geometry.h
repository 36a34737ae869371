// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_plane_geometry_h
#define nacre_discretization_plane_geometry_h

#include <nacre/base/types.h>

#include <deal.II/base/point.h>

#include <cmath>

namespace Nacre
{
  /** Points, segments and triangles in a reference cell, of size 1. */
  namespace PlaneGeometry
  {
    /** Points closer than this are one. */
    constexpr double snap_distance = 1e-10;

    /** Lengths up to this are round-off. */
    constexpr double round_off = 1e-12;

    /** Twice the area of a triangle, positive if it is counterclockwise. */
    inline double
    twice_area(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /** Distance of @p c from the line from a to b, positive on its left. */
    inline double
    offset(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c)
    {
      return twice_area(a, b, c) / a.distance(b);
    }

    /** The point of the segment from a to b that is nearest to @p x. */
    inline Point<dim>
    nearest_on_segment(const Point<dim> &a,
                       const Point<dim> &b,
                       const Point<dim> &x)
    {
      const Tensor<1, dim> ab = b - a;
      const double         t  = ((x - a) * ab) / ab.norm_square();
      return t <= 0. ? a : t >= 1. ? b : Point<dim>(a + t * ab);
    }

    /**
     * Where the ray from @p origin along @p d meets the line through @p a and
     * @p b: 0 at a, 1 at b; -1 if it doesn't.
     */
    inline double
    ray_on_line(const Point<dim>     &origin,
                const Tensor<1, dim> &d,
                const Point<dim>     &a,
                const Point<dim>     &b)
    {
      const Tensor<1, dim> ab    = b - a;
      const double         cross = ab[0] * d[1] - ab[1] * d[0];
      if (std::abs(cross) < round_off * d.norm())
        return -1.;
      const Tensor<1, dim> to_origin = origin - a;
      const double s = (to_origin[0] * d[1] - to_origin[1] * d[0]) / cross;
      return (s * ab - to_origin) * d > 0. ? s : -1.;
    }
  } // namespace PlaneGeometry
} // namespace Nacre

#endif
