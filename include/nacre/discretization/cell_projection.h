// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cell_projection_h
#define nacre_discretization_cell_projection_h

#include <nacre/base/types.h>

#include <deal.II/fe/fe.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Nacre
{
  /** Point and derivatives of a mid-surface given by nodes. */
  struct NodeSurface
  {
    const FiniteElement<dim, spacedim> &fe;
    const std::vector<Point<spacedim>> &nodes;

    Point<spacedim>
    position(const Point<dim> &unit) const
    {
      Point<spacedim> x;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        x += fe.shape_value(a, unit) * nodes[a];
      return x;
    }

    std::array<Tensor<1, spacedim>, dim>
    tangents(const Point<dim> &unit) const
    {
      std::array<Tensor<1, spacedim>, dim> tangents;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const auto gradient = fe.shape_grad(a, unit);
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            tangents[alpha] += gradient[alpha] * Tensor<1, spacedim>(nodes[a]);
        }
      return tangents;
    }
  };

  /** A cell's map to points, with derivatives by differences into the cell. */
  template <typename Map>
  struct DifferentiatedMap
  {
    /** From a point of the reference cell. */
    const Map &map;

    Point<spacedim>
    position(const Point<dim> &unit) const
    {
      return map(unit);
    }

    /** Of the second order: maps needn't go on beyond the surface's edges. */
    std::array<Tensor<1, spacedim>, dim>
    tangents(const Point<dim> &unit) const
    {
      const double                         step   = 1e-5;
      const double                         middle = 0.3;
      const Point<spacedim>                x_0    = map(unit);
      std::array<Tensor<1, spacedim>, dim> result;
      for (unsigned int alpha = 0; alpha < dim; ++alpha)
        {
          const double inward = unit[alpha] < middle ? step : -step;
          Point<dim>   near = unit, far = unit;
          near[alpha] += inward;
          far[alpha] += 2. * inward;
          result[alpha] =
            (4. * (map(near) - x_0) - (map(far) - x_0)) / (2. * inward);
        }
      return result;
    }
  };

  /**
   * The unit point of the nearest point to @p target on one cell: projected
   * Gauss-Newton from @p start. @p surface has position(unit) and
   * tangents(unit), as NodeSurface and DifferentiatedMap do.
   */
  template <typename Surface>
  Point<dim>
  project_to_cell(const Surface         &surface,
                  const ReferenceCell   &cell,
                  const Point<spacedim> &target,
                  Point<dim>             start)
  {
    for (unsigned int iteration = 0; iteration < 30; ++iteration)
      {
        const auto   difference = target - surface.position(start);
        const auto   a          = surface.tangents(start);
        const double a_11 = a[0] * a[0], a_22 = a[1] * a[1], a_12 = a[0] * a[1];
        const double b_1 = a[0] * difference, b_2 = a[1] * difference;
        const double det  = a_11 * a_22 - a_12 * a_12;
        Point<dim>   next = start;
        next[0] += (a_22 * b_1 - a_12 * b_2) / det;
        next[1] += (a_11 * b_2 - a_12 * b_1) / det;
        // Along an active bound the other coordinate moves alone.
        if (next[0] < 0. || next[0] > 1.)
          next[1] = start[1] + b_2 / a_22;
        if (next[1] < 0. || next[1] > 1.)
          next[0] = start[0] + b_1 / a_11;
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          next[alpha] = std::min(1., std::max(0., next[alpha]));
        if (cell == ReferenceCells::Triangle && next[0] + next[1] > 1.)
          {
            // Along the slanting edge, (1 - s, s).
            const auto   along = a[1] - a[0];
            const double s =
              start[1] +
              (along * (difference + (start[0] + start[1] - 1.) * a[0])) /
                (along * along);
            next[1] = std::min(1., std::max(0., s));
            next[0] = 1. - next[1];
          }
        const double step = next.distance(start);
        start             = next;
        if (step < 1e-14)
          break;
      }
    return start;
  }
} // namespace Nacre

#endif
