// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_quadrature.h>
#include <nacre/discretization/plane_geometry.h>

#include <deal.II/base/quadrature_lib.h>

#include <optional>

namespace Nacre
{
  namespace
  {
    using Triangle      = std::array<Point<dim>, 3>;
    using Quadrilateral = std::array<Point<dim>, 4>; // counterclockwise

    /**
     * The union of two triangles that share a side, if it is convex: no corner
     * takes less than a twentieth of the largest area there.
     */
    std::optional<Quadrilateral>
    join(const Triangle &a, const Triangle &b)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if (a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j])
            {
              const Quadrilateral corners{
                {a[i], b[(j + 2) % 3], a[(i + 1) % 3], a[(i + 2) % 3]}};
              double smallest = 1., largest = 0.;
              for (unsigned int k = 0; k < 4; ++k)
                {
                  const double area =
                    PlaneGeometry::twice_area(corners[(k + 3) % 4],
                                              corners[k],
                                              corners[(k + 1) % 4]);
                  smallest = std::min(smallest, area);
                  largest  = std::max(largest, area);
                }
              if (smallest > 0.05 * largest)
                return corners;
            }
      return {};
    }

    /** The rule on the square, mapped bilinearly. */
    void
    append(const Quadrilateral     &corners,
           const Quadrature<dim>   &rule,
           std::vector<Point<dim>> &points,
           std::vector<double>     &weights)
    {
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double s = rule.point(q)[0], t = rule.point(q)[1];
          const auto   along = (1. - t) * (corners[1] - corners[0]) +
                             t * (corners[2] - corners[3]);
          const auto across = (1. - s) * (corners[3] - corners[0]) +
                              s * (corners[2] - corners[1]);
          points.push_back(corners[0] + s * (corners[1] - corners[0]) +
                           t * across);
          weights.push_back(rule.weight(q) *
                            (along[0] * across[1] - along[1] * across[0]));
        }
    }
  } // namespace

  Quadrature<dim>
  part_quadrature(const CellPolygon &polygon, const unsigned int degree)
  {
    // n Gauss points are exact to 2 n - 1; the Jacobian of the bilinear map, or
    // of the collapse, takes one degree. The table of symmetric rules, which
    // need fewer points, ends at the degree 14.
    const unsigned int  n = 2 * degree + 1;
    const QGauss<dim>   on_square(n);
    const QSimplex<dim> on_triangle =
      degree <= 3 ?
        QSimplex<dim>(QWitherdenVincentSimplex<dim>(2 * degree, false)) :
        QSimplex<dim>(QDuffy(n, 1.));
    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    auto                    triangles = polygon.triangles();
    while (!triangles.empty())
      {
        const Triangle triangle = triangles.back();
        triangles.pop_back();
        std::optional<Quadrilateral> both;
        for (unsigned int k = 0; k < triangles.size() && !both; ++k)
          if ((both = join(triangle, triangles[k])))
            triangles.erase(triangles.begin() + k);
        if (both)
          append(*both, on_square, points, weights);
        else
          {
            const auto part =
              on_triangle.compute_affine_transformation(triangle);
            points.insert(points.end(),
                          part.get_points().begin(),
                          part.get_points().end());
            weights.insert(weights.end(),
                           part.get_weights().begin(),
                           part.get_weights().end());
          }
      }
    return Quadrature<dim>(points, weights);
  }
} // namespace Nacre
