// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/shape_table.h>

#include <deal.II/fe/fe.h>

namespace Nacre
{
  ShapeTable::ShapeTable(const FiniteElement<dim, spacedim> &fe,
                         const std::vector<Point<dim>>      &points)
    : n_nodes_(fe.n_dofs_per_cell())
  {
    Assert(fe.n_components() == 1, ExcNotImplemented());
    const unsigned int size = points.size() * n_nodes_;
    values_.reserve(size);
    gradients_.reserve(size);
    hessians_.reserve(size);
    for (const auto &point : points)
      for (unsigned int a = 0; a < n_nodes_; ++a)
        {
          const auto gradient = fe.shape_grad(a, point);
          const auto hessian  = fe.shape_grad_grad(a, point);
          values_.push_back(fe.shape_value(a, point));
          gradients_.push_back({{gradient[0], gradient[1]}});
          hessians_.push_back({{hessian[0][0], hessian[1][1], hessian[0][1]}});
        }
  }
} // namespace Nacre
