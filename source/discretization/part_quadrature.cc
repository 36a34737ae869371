// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

namespace Nacre
{
  Quadrature<dim>
  part_quadrature(const CellPolygon &polygon, const unsigned int degree)
  {
    // n Gauss points are exact to 2 n - 1, and the collapse's Jacobian takes
    // one degree.
    const QDuffy            rule(2 * degree + 1, 1.);
    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    for (const auto &triangle : polygon.triangles())
      {
        const auto part = rule.compute_affine_transformation(triangle);
        points.insert(points.end(),
                      part.get_points().begin(),
                      part.get_points().end());
        weights.insert(weights.end(),
                       part.get_weights().begin(),
                       part.get_weights().end());
      }
    return Quadrature<dim>(points, weights);
  }
} // namespace Nacre
