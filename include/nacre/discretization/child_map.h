// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_child_map_h
#define nacre_discretization_child_map_h

#include <nacre/base/types.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <deal.II/grid/reference_cell.h>

#include <vector>

namespace Nacre
{
  /** The affine map of a child's reference cell into its parent's. */
  struct ChildMap
  {
    /** The place of the identity among child_maps(). */
    static constexpr unsigned int identity =
      GeometryInfo<dim>::max_children_per_cell;

    Point<dim>     origin;
    Tensor<2, dim> jacobian;

    Point<dim>
    to_parent(const Point<dim> &x) const
    {
      return origin + jacobian * x;
    }

    Point<dim>
    to_child(const Point<dim> &x) const
    {
      return Point<dim>(invert(jacobian) * (x - origin));
    }
  };

  /** The maps of all children of a cell, and the identity at the end. */
  std::vector<ChildMap>
  child_maps(const ReferenceCell &cell);
} // namespace Nacre

#endif
