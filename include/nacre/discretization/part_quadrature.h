// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_quadrature_h
#define nacre_discretization_part_quadrature_h

#include <nacre/discretization/cell_polygon.h>

#include <deal.II/base/quadrature.h>

namespace Nacre
{
  /**
   * Rule on a part of a reference cell: on its triangles, or on convex
   * quadrilaterals of two of them, Gauss rules with 2 @p degree + 1 points a
   * direction, which are exact for polynomials of the total degree 4 @p degree.
   * The points lie inside the part, the weights are positive and add up to its
   * area.
   */
  Quadrature<dim>
  part_quadrature(const CellPolygon &polygon, const unsigned int degree);
} // namespace Nacre

#endif
