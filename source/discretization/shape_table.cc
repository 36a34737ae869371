// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/shape_table.h>

#include <deal.II/fe/fe_q.h>

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
    if (const auto *fe_q = dynamic_cast<const FE_Q<dim, spacedim> *>(&fe))
      fill_products(*fe_q, points);
    else
      for (const auto &point : points)
        for (unsigned int a = 0; a < n_nodes_; ++a)
          append(fe.shape_value(a, point),
                 fe.shape_grad(a, point),
                 fe.shape_grad_grad(a, point));
  }

  void
  ShapeTable::fill_products(const FE_Q<dim, spacedim>     &fe,
                            const std::vector<Point<dim>> &points)
  {
    std::vector<double>         values(n_nodes_);
    std::vector<Tensor<1, dim>> gradients(n_nodes_);
    std::vector<Tensor<2, dim>> hessians(n_nodes_);
    std::vector<Tensor<3, dim>> third;
    std::vector<Tensor<4, dim>> fourth;
    for (const auto &point : points)
      {
        fe.get_poly_space()
          .evaluate(point, values, gradients, hessians, third, fourth);
        for (unsigned int a = 0; a < n_nodes_; ++a)
          append(values[a], gradients[a], hessians[a]);
      }
  }

  void
  ShapeTable::append(const double          value,
                     const Tensor<1, dim> &gradient,
                     const Tensor<2, dim> &hessian)
  {
    values_.push_back(value);
    gradients_.push_back({{gradient[0], gradient[1]}});
    hessians_.push_back({{hessian[0][0], hessian[1][1], hessian[0][1]}});
  }

  namespace
  {
    /** Append to each row of @p table, [row][old], its @p entries. */
    template <typename Value>
    void
    append_to_rows(const unsigned int        n_rows,
                   const std::vector<Value> &entries,
                   std::vector<Value>       &table)
    {
      const unsigned int n_old = table.size() / n_rows;
      const unsigned int n_new = entries.size() / n_rows;
      std::vector<Value> result;
      result.reserve(table.size() + entries.size());
      for (unsigned int row = 0; row < n_rows; ++row)
        {
          const auto old  = table.begin() + row * n_old;
          const auto more = entries.begin() + row * n_new;
          result.insert(result.end(), old, old + n_old);
          result.insert(result.end(), more, more + n_new);
        }
      table.swap(result);
    }
  } // namespace

  void
  ShapeTable::append_functions(const std::vector<FieldDerivatives> &functions)
  {
    std::vector<double>                values;
    std::vector<std::array<double, 2>> gradients;
    std::vector<std::array<double, 3>> hessians;
    for (const auto &f : functions)
      {
        values.push_back(f.value[0]);
        gradients.push_back({{f.first[0][0], f.first[1][0]}});
        hessians.push_back({{f.second[0][0], f.second[1][0], f.second[2][0]}});
      }
    const unsigned int n = n_points();
    append_to_rows(n, values, values_);
    append_to_rows(n, gradients, gradients_);
    append_to_rows(n, hessians, hessians_);
    n_nodes_ = values_.size() / n;
  }

  GeometryTable::GeometryTable(const FiniteElement<dim, spacedim> &fe,
                               const std::vector<Point<dim>>      &points)
    : GeometryTable(ShapeTable(fe, points))
  {}

  GeometryTable::GeometryTable(const ShapeTable &shapes)
    : rows_(shapes.n_nodes(), n_kinds * shapes.n_points())
  {
    for (unsigned int b = 0; b < rows_.m(); ++b)
      for (unsigned int q = 0; q < shapes.n_points(); ++q)
        {
          double *row = &rows_(b, n_kinds * q);
          row[0]      = shapes.value(q, b);
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            row[1 + alpha] = shapes.gradient(q, b)[alpha];
          for (unsigned int v = 0; v < 3; ++v)
            row[3 + v] = shapes.hessian(q, b)[v];
        }
  }

  void
  GeometryTable::evaluate(const ArrayView<const Point<spacedim>> &nodes,
                          Values                                 &values) const
  {
    AssertDimension(nodes.size(), rows_.m());
    values.nodes_.reinit(rows_.m(), spacedim, true);
    values.values_.reinit(spacedim, rows_.n(), true);
    for (unsigned int b = 0; b < nodes.size(); ++b)
      for (unsigned int c = 0; c < spacedim; ++c)
        values.nodes_(b, c) = nodes[b][c];
    values.nodes_.Tmmult(values.values_, rows_);
  }
} // namespace Nacre
