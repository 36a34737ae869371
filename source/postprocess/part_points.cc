// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/plane_geometry.h>
#include <nacre/postprocess/part_points.h>

#include <algorithm>
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

    /**
     * A triangle as a block: of quadrilaterals the last two corners are one;
     * the points of triangles don't reach the last one.
     */
    Block
    triangle(const Point<dim> &a,
             const Point<dim> &b,
             const Point<dim> &c,
             const bool        is_in_triangle)
    {
      return {{a, b, c, is_in_triangle ? Point<dim>(b + (c - a)) : c}};
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
        blocks.push_back(triangle(a, b, c, is_in_triangle));
      return blocks;
    }

    /** The tip inside of a whole cell that has its functions; null: none. */
    const PartEnrichment::Share *
    tip_inside(const CellPart &part)
    {
      if (part.is_cut() || part.enrichment() == nullptr)
        return nullptr;
      const auto &shares = part.enrichment()->shares;
      const auto  found =
        std::find_if(shares.begin(), shares.end(), [](const auto &s) {
          return s.holds_tip;
        });
      return found == shares.end() ? nullptr : &*found;
    }

    /**
     * A triangle from the tip to each edge of its cell, two to the edge at
     * which the crack enters. The corners are moved off the crack by round-off,
     * each to the lip of its triangle.
     */
    std::vector<Block>
    blocks_around(const PartEnrichment::Share &share, const CellPolygon &whole)
    {
      const double       off = 1e-8;
      std::vector<Block> blocks;
      for (unsigned int i = 0; i < whole.n_vertices(); ++i)
        {
          const auto  &a = whole.vertex(i);
          const auto  &b = whole.vertex((i + 1) % whole.n_vertices());
          const double s =
            PlaneGeometry::ray_on_line(share.tip, share.backward, a, b);
          std::vector<Point<dim>> ends{a, b};
          if (s > off && s < 1. - off)
            ends.insert(ends.begin() + 1, a + s * (b - a));
          for (unsigned int k = 0; k + 1 < ends.size(); ++k)
            {
              Point<dim> tip = share.tip, c = ends[k], d = ends[k + 1];
              const Tensor<1, dim> middle = 1. / 3. * ((c - tip) + (d - tip));
              if (PlaneGeometry::twice_area(tip, c, d) < off)
                continue;
              for (Point<dim> *const x : {&tip, &c, &d})
                *x += off * (share.tip + middle - *x);
              blocks.push_back(
                triangle(c,
                         d,
                         tip,
                         whole.reference_cell() == ReferenceCells::Triangle));
            }
        }
      return blocks;
    }
  } // namespace

  bool
  has_blocks(const CellPart &part)
  {
    return part.is_cut() || tip_inside(part) != nullptr;
  }

  std::vector<Point<dim>>
  points_on_part(const CellPart &part, const std::vector<Point<dim>> &points)
  {
    if (!has_blocks(part))
      return points;
    const auto *const       tip = tip_inside(part);
    std::vector<Point<dim>> result;
    for (const Block &corners : tip != nullptr ?
                                  blocks_around(*tip, part.outline()) :
                                  blocks_of(part.polygon()))
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
