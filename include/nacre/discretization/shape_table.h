// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shape_table_h
#define nacre_discretization_shape_table_h

#include <nacre/base/types.h>

#include <array>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class FiniteElement;
}

namespace Nacre
{
  /**
   * Values and derivatives of scalar shape functions with respect to the
   * coordinates of the reference cell, at fixed points of it: computed once,
   * used on every cell.
   */
  class ShapeTable
  {
  public:
    /** @param fe a scalar element @param points points in [0, 1]^2 */
    ShapeTable(const FiniteElement<dim, spacedim> &fe,
               const std::vector<Point<dim>>      &points);

    unsigned int
    n_nodes() const
    {
      return n_nodes_;
    }

    unsigned int
    n_points() const
    {
      return values_.size() / n_nodes_;
    }

    /** N at the point @p q of the node @p a. */
    double
    value(const unsigned int q, const unsigned int a) const
    {
      return values_[q * n_nodes_ + a];
    }

    /** N,1, N,2. */
    const std::array<double, 2> &
    gradient(const unsigned int q, const unsigned int a) const
    {
      return gradients_[q * n_nodes_ + a];
    }

    /** N,11, N,22, N,12. */
    const std::array<double, 3> &
    hessian(const unsigned int q, const unsigned int a) const
    {
      return hessians_[q * n_nodes_ + a];
    }

  private:
    unsigned int                       n_nodes_;
    std::vector<double>                values_;    // [point][node]
    std::vector<std::array<double, 2>> gradients_; // [point][node]
    std::vector<std::array<double, 3>> hessians_;  // [point][node]
  };
} // namespace Nacre

#endif
