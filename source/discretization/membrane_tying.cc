// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/discretization/membrane_tying.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/lac/vector.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** Lagrange polynomial k of the @p nodes at @p x. */
    double
    lagrange(const std::vector<Point<1>> &nodes,
             const unsigned int           k,
             const double                 x)
    {
      double value = 1.;
      for (unsigned int m = 0; m < nodes.size(); ++m)
        if (m != k)
          value *= (x - nodes[m][0]) / (nodes[k][0] - nodes[m][0]);
      return value;
    }

    /** (tau_1^2, tau_2^2, tau_1 tau_2): its product with a strain is e_tt. */
    std::array<double, 3>
    dyad(const Tensor<1, dim> &tau)
    {
      return {{tau[0] * tau[0], tau[1] * tau[1], tau[0] * tau[1]}};
    }

    /** Barycentric coordinates, the linear functions on the triangle. */
    std::array<double, 3>
    barycentric(const Point<dim> &x)
    {
      return {{1. - x[0] - x[1], x[0], x[1]}};
    }

    /**
     * Exponents (i, j) of the tied component @p v, by ascending i + j; of e11
     * and e22 only those that 2 e12 doesn't have.
     */
    std::vector<std::array<unsigned int, 2>>
    tied_exponents(const Element &element, const unsigned int v)
    {
      const bool triangle =
        element.reference_cell() == ReferenceCells::Triangle;
      const unsigned int p     = element.degree;
      const unsigned int i_max = triangle ? 1 : v == 1 ? p : p - 1;
      const unsigned int j_max = triangle ? 1 : v == 0 ? p : p - 1;
      std::vector<std::array<unsigned int, 2>> exponents;
      for (unsigned int sum = 0; sum <= (triangle ? 1 : i_max + j_max); ++sum)
        for (unsigned int i = 0; i <= std::min(sum, i_max); ++i)
          if (sum - i <= j_max &&
              (v == 2 || (!triangle && std::max(i, sum - i) == p)))
            exponents.push_back({{i, sum - i}});
      return exponents;
    }

    /** Values [polynomial](point). */
    using Columns = std::vector<Vector<double>>;

    /** Append Legendre products on a box. */
    void
    append_products(const std::vector<std::array<unsigned int, 2>> &exponents,
                    const BoundingBox<dim>                         &box,
                    const std::vector<Point<dim>>                  &points,
                    Columns                                        &columns)
    {
      unsigned int degree = 0;
      for (const auto &[i, j] : exponents)
        degree = std::max({degree, i, j});
      const auto legendre =
        Polynomials::Legendre::generate_complete_basis(degree);
      const unsigned int first = columns.size();
      columns.resize(first + exponents.size(), Vector<double>(points.size()));
      std::vector<std::array<double, dim>> values(degree + 1);
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto x = box.real_to_unit(points[q]);
          for (unsigned int i = 0; i <= degree; ++i)
            values[i] = {{legendre[i].value(x[0]), legendre[i].value(x[1])}};
          for (unsigned int c = 0; c < exponents.size(); ++c)
            columns[first + c](q) =
              values[exponents[c][0]][0] * values[exponents[c][1]][1];
        }
    }

    /**
     * Modified Gram-Schmidt, twice over, in the weighted inner product of the
     * @p columns, of which the first @p n are orthonormal. The @p followers,
     * values elsewhere of the same functions or none, are combined alike.
     * Dependent columns are removed.
     */
    void
    orthonormalise(const std::vector<double> &weights,
                   unsigned int               n,
                   Columns                   &columns,
                   Columns                   &followers)
    {
      const auto product = [&](const auto &f, const auto &g) {
        double sum = 0.;
        for (unsigned int q = 0; q < weights.size(); ++q)
          sum += weights[q] * f(q) * g(q);
        return sum;
      };
      const bool follow = !followers.empty();
      for (unsigned int c = n; c < columns.size(); ++c)
        {
          Vector<double> f = columns[c], g;
          if (follow)
            g = followers[c];
          const double first_norm = std::sqrt(product(f, f));
          for (unsigned int pass = 0; pass < 2; ++pass)
            for (unsigned int k = 0; k < n; ++k)
              {
                const double share = product(columns[k], f);
                f.add(-share, columns[k]);
                if (follow)
                  g.add(-share, followers[k]);
              }
          const double norm = std::sqrt(product(f, f));
          if (norm <= 1e-11 * first_norm)
            continue;
          f /= norm;
          columns[n].swap(f);
          if (follow)
            {
              g /= norm;
              followers[n].swap(g);
            }
          ++n;
        }
      columns.resize(n);
      if (follow)
        followers.resize(n);
    }

    NACRE_SIMD void
    combine_rows(const double                                *rows,
                 const std::pair<unsigned int, double> *const weights,
                 const unsigned int                           n_weights,
                 const unsigned int                           n,
                 double                                      *row)
    {
      for (unsigned int i = 0; i < n; ++i)
        row[i] = 0.;
      for (unsigned int k = 0; k < n_weights; ++k)
        {
          const double *const from   = rows + weights[k].first * n;
          const double        weight = weights[k].second;
          for (unsigned int i = 0; i < n; ++i)
            row[i] += weight * from[i];
        }
    }

    NACRE_SIMD void
    add_to_rows(const double *const                          row,
                const std::pair<unsigned int, double> *const weights,
                const unsigned int                           n_weights,
                const unsigned int                           n,
                double *__restrict const rows)
    {
      for (unsigned int k = 0; k < n_weights; ++k)
        {
          double *const to     = rows + weights[k].first * n;
          const double  weight = weights[k].second;
          for (unsigned int i = 0; i < n; ++i)
            to[i] += weight * row[i];
        }
    }
  } // namespace

  void
  combine(const FullMatrix<double>     &rows,
          const MembraneTying::Weights &weights,
          double                       *row)
  {
    combine_rows(&rows(0, 0), weights.data(), weights.size(), rows.n(), row);
  }

  void
  MembraneTying::sum_rows(FullMatrix<double> &rows) const
  {
    if (sums_.empty())
      return;
    FullMatrix<double> sums(sums_.size(), rows.n());
    for (unsigned int j = 0; j < sums_.size(); ++j)
      combine(rows, sums_[j], &sums(j, 0));
    rows.swap(sums);
  }

  void
  MembraneTying::spread_rows(FullMatrix<double> &rows) const
  {
    if (sums_.empty())
      return;
    FullMatrix<double> shares(samples_.size(), rows.n());
    for (unsigned int j = 0; j < sums_.size(); ++j)
      add_to_rows(&rows(j, 0),
                  sums_[j].data(),
                  sums_[j].size(),
                  rows.n(),
                  &shares(0, 0));
    rows.swap(shares);
  }

  MembraneTying::MembraneTying(const Element                 &element,
                               const std::vector<Point<dim>> &targets)
    : weights_(3 * targets.size())
  {
    if (element.reference_cell() == ReferenceCells::Triangle)
      tie_triangle(targets);
    else
      tie_quadrilateral(element.degree, targets);
  }

  MembraneTying
  MembraneTying::untied(const std::vector<Point<dim>> &targets)
  {
    MembraneTying tying;
    tying.points_ = targets;
    tying.weights_.resize(3 * targets.size());
    for (unsigned int q = 0; q < targets.size(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          Sample sample{q, {{0., 0., 0.}}};
          sample.direction[v] = 1.;
          tying.weights_[3 * q + v].emplace_back(tying.samples_.size(), 1.);
          tying.samples_.push_back(sample);
        }
    return tying;
  }

  MembraneTying
  MembraneTying::projected(const Element                 &element,
                           const Quadrature<dim>         &part,
                           const std::vector<double>     &area_weights,
                           const std::vector<Point<dim>> &targets)
  {
    AssertDimension(part.size(), area_weights.size());
    MembraneTying tying = untied(part.get_points());
    tying.weights_.assign(3 * targets.size(), Weights());
    const BoundingBox<dim> box(part.get_points());
    const bool             at_rule = targets == part.get_points();
    // All components have the functions of 2 e12.
    Columns common, common_at_targets;
    for (const unsigned int v : {2, 0, 1})
      {
        Columns    at_points = common, at_targets = common_at_targets;
        const auto exponents = tied_exponents(element, v);
        append_products(exponents, box, part.get_points(), at_points);
        if (!at_rule)
          append_products(exponents, box, targets, at_targets);
        orthonormalise(area_weights, common.size(), at_points, at_targets);
        tying.add_functions(v,
                            area_weights,
                            at_points,
                            at_rule ? at_points : at_targets);
        if (v == 2)
          {
            common            = std::move(at_points);
            common_at_targets = std::move(at_targets);
          }
      }
    return tying;
  }

  void
  MembraneTying::add_functions(const unsigned int                 v,
                               const std::vector<double>         &area_weights,
                               const std::vector<Vector<double>> &at_points,
                               const std::vector<Vector<double>> &at_targets)
  {
    const unsigned int first = sums_.size();
    for (const auto &function : at_points)
      {
        sums_.emplace_back();
        sums_.back().reserve(area_weights.size());
        for (unsigned int k = 0; k < area_weights.size(); ++k)
          sums_.back().emplace_back(3 * k + v, function(k) * area_weights[k]);
      }
    for (unsigned int q = 0; q < weights_.size() / 3; ++q)
      {
        auto &weights = weights_[3 * q + v];
        weights.reserve(at_targets.size());
        for (unsigned int j = 0; j < at_targets.size(); ++j)
          weights.emplace_back(first + j, at_targets[j](q));
      }
  }

  void
  MembraneTying::tie_quadrilateral(const unsigned int             degree,
                                   const std::vector<Point<dim>> &targets)
  {
    for (unsigned int v = 0; v < 3; ++v)
      {
        const auto xs = QGauss<1>(v == 1 ? degree + 1 : degree).get_points();
        const auto ys = QGauss<1>(v == 0 ? degree + 1 : degree).get_points();
        for (unsigned int j = 0; j < ys.size(); ++j)
          for (unsigned int i = 0; i < xs.size(); ++i)
            {
              Sample sample{static_cast<unsigned int>(points_.size()),
                            {{0., 0., 0.}}};
              sample.direction[v] = 1.;
              for (unsigned int q = 0; q < targets.size(); ++q)
                {
                  const double weight = lagrange(xs, i, targets[q][0]) *
                                        lagrange(ys, j, targets[q][1]);
                  if (std::abs(weight) > 1e-13)
                    weights_[3 * q + v].emplace_back(samples_.size(), weight);
                }
              points_.emplace_back(xs[i][0], ys[j][0]);
              samples_.push_back(sample);
            }
      }
  }

  void
  MembraneTying::tie_triangle(const std::vector<Point<dim>> &targets)
  {
    // The linear field sum_k L_k e_k, unknowns 3 k + v, fulfils nine
    // conditions, each a combination of samples.
    FullMatrix<double> conditions(9, 9);
    std::array<std::vector<std::pair<unsigned int, double>>, 9> data;

    const auto   cell       = ReferenceCells::Triangle;
    unsigned int condition  = 0;
    const auto   add_sample = [&](const Point<dim>            &x,
                                const std::array<double, 3> &direction) {
      samples_.push_back(
        {static_cast<unsigned int>(points_.size()), direction});
      points_.push_back(x);
      return samples_.size() - 1;
    };
    for (const auto face : cell.face_indices())
      {
        const auto start =
          cell.template vertex<dim>(cell.face_to_cell_vertices(face, 0, 1));
        const auto end =
          cell.template vertex<dim>(cell.face_to_cell_vertices(face, 1, 1));
        const auto direction = dyad(end - start);
        for (const double t :
             {0.5 - std::sqrt(1. / 12.), 0.5 + std::sqrt(1. / 12.)})
          {
            const Point<dim> x = start + t * (end - start);
            data[condition].emplace_back(add_sample(x, direction), 1.);
            for (unsigned int k = 0; k < 3; ++k)
              for (unsigned int v = 0; v < 3; ++v)
                conditions(condition, 3 * k + v) =
                  barycentric(x)[k] * direction[v];
            ++condition;
          }
      }
    // The mean of a linear field is that of its values at the vertices.
    const QWitherdenVincentSimplex<dim> rule(1, false);
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        points_.push_back(rule.point(q));
        for (unsigned int v = 0; v < 3; ++v)
          {
            Sample sample{static_cast<unsigned int>(points_.size() - 1),
                          {{0., 0., 0.}}};
            sample.direction[v] = 1.;
            data[condition + v].emplace_back(samples_.size(),
                                             2. * rule.weight(q));
            samples_.push_back(sample);
          }
      }
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int v = 0; v < 3; ++v)
        conditions(condition + v, 3 * k + v) = 1. / 3.;

    conditions.gauss_jordan();
    for (unsigned int q = 0; q < targets.size(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          std::vector<double> weights(samples_.size());
          for (unsigned int c = 0; c < 9; ++c)
            for (const auto &[sample, share] : data[c])
              for (unsigned int k = 0; k < 3; ++k)
                weights[sample] +=
                  barycentric(targets[q])[k] * conditions(3 * k + v, c) * share;
          for (unsigned int s = 0; s < weights.size(); ++s)
            if (std::abs(weights[s]) > 1e-13)
              weights_[3 * q + v].emplace_back(s, weights[s]);
        }
  }
} // namespace Nacre
