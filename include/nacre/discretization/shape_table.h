// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shape_table_h
#define nacre_discretization_shape_table_h

#include <nacre/base/types.h>
#include <nacre/discretization/tip_functions.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/base/array_view.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class FiniteElement;
  template <int dim, int spacedim>
  class FE_Q;
} // namespace dealii

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

    /**
     * Let scalar functions of tips follow the nodes' functions.
     * @param functions times e_x, [point][function]
     */
    void
    append_functions(const std::vector<FieldDerivatives> &functions);

    /** Of the shape functions: those of nodes, and those of tips behind. */
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
    /** All products of one-dimensional polynomials at once. */
    void
    fill_products(const FE_Q<dim, spacedim>     &fe,
                  const std::vector<Point<dim>> &points);

    void
    append(const double          value,
           const Tensor<1, dim> &gradient,
           const Tensor<2, dim> &hessian);

    unsigned int                       n_nodes_;
    std::vector<double>                values_;    // [point][node]
    std::vector<std::array<double, 2>> gradients_; // [point][node]
    std::vector<std::array<double, 3>> hessians_;  // [point][node]
  };

  /**
   * The geometry phi0 = sum_b N^b X0^b (18) and its derivatives at fixed points
   * of the reference cell, all in one dense product.
   */
  class GeometryTable
  {
  public:
    /** @param fe the geometry's element @param points points in [0, 1]^2 */
    GeometryTable(const FiniteElement<dim, spacedim> &fe,
                  const std::vector<Point<dim>>      &points);

    /** @param shapes of the geometry's element */
    explicit GeometryTable(const ShapeTable &shapes);

    unsigned int
    n_points() const
    {
      return rows_.n() / n_kinds;
    }

    /** phi0 and its derivatives at all points of one cell (length). */
    class Values
    {
    public:
      Point<spacedim>
      position(const unsigned int q) const
      {
        return Point<spacedim>(get(q, 0));
      }

      /** phi0,1 or phi0,2. */
      Tensor<1, spacedim>
      tangent(const unsigned int q, const unsigned int alpha) const
      {
        return get(q, 1 + alpha);
      }

      /** The frame of the mid-surface. */
      SurfaceFrame<>
      frame(const unsigned int q) const
      {
        return make_surface_frame(tangent(q, 0),
                                  tangent(q, 1),
                                  second_derivatives(q));
      }

      /** phi0,11, phi0,22, phi0,12. */
      std::array<Tensor<1, spacedim>, 3>
      second_derivatives(const unsigned int q) const
      {
        return {{get(q, 3), get(q, 4), get(q, 5)}};
      }

    private:
      Tensor<1, spacedim>
      get(const unsigned int q, const unsigned int kind) const
      {
        Tensor<1, spacedim> x;
        for (unsigned int c = 0; c < spacedim; ++c)
          x[c] = values_(c, n_kinds * q + kind);
        return x;
      }

      FullMatrix<double> nodes_;  // [node][component]
      FullMatrix<double> values_; // [component][6 point + kind]

      friend class GeometryTable;
    };

    /** @param nodes positions X0 (length) of the element's nodes */
    void
    evaluate(const ArrayView<const Point<spacedim>> &nodes,
             Values                                 &values) const;

  private:
    /** Value, two first and three second derivatives. */
    static constexpr unsigned int n_kinds = 6;

    FullMatrix<double> rows_; // [node][6 point + kind]
  };
} // namespace Nacre

#endif
