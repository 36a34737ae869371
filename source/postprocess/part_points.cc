// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/part_points.h>

#include <array>

namespace Nacre
{
  namespace
  {
    /** Corners of a block in lexicographic order. */
    using Block = std::array<Point<dim>, 4>;

    /** Twice the area of the triangle (a, b, c). */
    double
    cross(const Point<dim> &a, const Point<dim> &b, const Point<dim> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /** Whether all corners of a quadrilateral are well below 180 degrees. */
    bool
    is_convex_quadrilateral(const CellPolygon &polygon)
    {
      if (polygon.n_vertices() != 4)
        return false;
      for (unsigned int i = 0; i < 4; ++i)
        if (cross(polygon.vertex(i),
                  polygon.vertex((i + 1) % 4),
                  polygon.vertex((i + 2) % 4)) < 0.1 * polygon.area())
          return false;
      return true;
    }

    std::vector<Block>
    blocks_of(const CellPolygon &polygon)
    {
      const bool is_in_triangle =
        polygon.reference_cell() == ReferenceCells::Triangle;
      if (!is_in_triangle && is_convex_quadrilateral(polygon))
        return {{{polygon.vertex(0),
                  polygon.vertex(1),
                  polygon.vertex(3),
                  polygon.vertex(2)}}};
      std::vector<Block> blocks;
      for (const auto &[a, b, c] : polygon.triangles())
        blocks.push_back(
          {{a, b, c, is_in_triangle ? Point<dim>(b + (c - a)) : c}});
      return blocks;
    }
  } // namespace

  std::vector<Point<dim>>
  points_on_part(const CellPart &part, const std::vector<Point<dim>> &points)
  {
    if (!part.is_cut())
      return points;
    std::vector<Point<dim>> result;
    for (const Block &corners : blocks_of(part.polygon()))
      for (const auto &x : points)
        {
          Tensor<1, dim> image;
          for (unsigned int v = 0; v < 4; ++v)
            image += (v % 2 == 1 ? x[0] : 1. - x[0]) *
                     (v / 2 == 1 ? x[1] : 1. - x[1]) *
                     Tensor<1, dim>(corners[v]);
          result.emplace_back(image);
        }
    return result;
  }

  Point<dim>
  centroid(const CellPolygon &polygon)
  {
    Tensor<1, dim> moment;
    for (const auto &[a, b, c] : polygon.triangles())
      moment += cross(a, b, c) / 6. *
                Tensor<1, dim>(a + (b - Point<dim>()) + (c - Point<dim>()));
    return Point<dim>(moment / polygon.area());
  }
} // namespace Nacre
