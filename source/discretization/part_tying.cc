// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_tying.h>
#include <nacre/discretization/shape_table.h>

namespace Nacre
{
  MembraneTying
  part_tying(const Discretization          &discretization,
             const CellPart                &part,
             const Quadrature<dim>         &rule,
             const std::vector<Point<dim>> &targets)
  {
    GeometryTable::Values geometry;
    GeometryTable(discretization.geometry_fe(), rule.get_points())
      .evaluate(discretization.geometry_nodes(part), geometry);
    std::vector<double> areas(rule.size());
    for (unsigned int q = 0; q < rule.size(); ++q)
      areas[q] =
        rule.weight(q) *
        cross_product_3d(geometry.tangent(q, 0), geometry.tangent(q, 1)).norm();
    return MembraneTying::projected(discretization.element(),
                                    rule,
                                    areas,
                                    targets);
  }
} // namespace Nacre
