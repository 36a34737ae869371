// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/tip_jump.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace Nacre
{
  namespace
  {
    /** Derivatives of a term. */
    struct JumpTerm
    {
      explicit JumpTerm(const PolarSeries &series)
        : value(series)
        , first{{series.along_x(), series.along_y()}}
        , second{{first[0].along_x(), first[1].along_y(), first[0].along_y()}}
        , third{{second[0].along_x(),
                 second[0].along_y(),
                 second[1].along_x(),
                 second[1].along_y()}}
      {}

      PolarSeries                value;
      std::array<PolarSeries, 2> first;
      /** xx, yy, xy. */
      std::array<PolarSeries, 3> second;
      /** xxx, xxy, xyy, yyy. */
      std::array<PolarSeries, 4> third;
    };

    using JumpRows =
      std::function<std::vector<double>(const JumpTerm &,
                                        const JumpBoundaryPoint &)>;

    double
    radius_of(const JumpBoundaryPoint &point)
    {
      return std::hypot(point.x, point.y);
    }

    double
    normal_slope(const JumpTerm &term, const JumpBoundaryPoint &point)
    {
      const double r = radius_of(point), theta = std::atan2(point.y, point.x);
      return point.normal_x * term.first[0](r, theta) +
             point.normal_y * term.first[1](r, theta);
    }

    /** m_nn and Kirchhoff's force V over -D, straight edge. */
    std::vector<double>
    plate_forces(const JumpTerm          &term,
                 const JumpBoundaryPoint &point,
                 const double             nu)
    {
      const double r = radius_of(point), theta = std::atan2(point.y, point.x);
      const double n = point.normal_x, m = point.normal_y;
      // The tangent is (-m, n).
      const double xx = term.second[0](r, theta), yy = term.second[1](r, theta),
                   xy    = term.second[2](r, theta);
      const double along = m * m * xx + n * n * yy - 2. * m * n * xy;
      const double xxx = term.third[0](r, theta), xxy = term.third[1](r, theta),
                   xyy = term.third[2](r, theta), yyy = term.third[3](r, theta);
      const double twisting =
        n * (m * m * xxx + n * n * xyy - 2. * m * n * xxy) +
        m * (m * m * xxy + n * n * yyy - 2. * m * n * xyy);
      return {xx + yy - (1. - nu) * along,
              n * (xxx + xyy) + m * (xxy + yyy) + (1. - nu) * twisting};
    }

    /** The conditions on the terms, a row each, and what they ask for. */
    struct JumpConditions
    {
      std::vector<std::vector<double>> columns; // [term][row]
      std::vector<double>              values;
      std::vector<bool>                is_value;
    };

    /**
     * @param rows of a term at a point: its value first where one is prescribed
     * @param length unit of the points
     */
    JumpConditions
    make_conditions(const std::vector<PolarSeries>       &terms,
                    const std::vector<JumpBoundaryPoint> &boundary,
                    const JumpMoments                    &moments,
                    const JumpRows                       &rows,
                    const double                          length)
    {
      JumpConditions result;
      for (const auto &series : terms)
        {
          const JumpTerm term(series);
          result.columns.emplace_back();
          auto               &column = result.columns.back();
          std::vector<double> at_points;
          for (auto point : boundary)
            {
              point.x /= length;
              point.y /= length;
              const auto of_point = rows(term, point);
              at_points.push_back(of_point[0]);
              column.insert(column.end(), of_point.begin(), of_point.end());
              if (result.columns.size() == 1)
                for (unsigned int i = 0; i < of_point.size(); ++i)
                  {
                    const bool is_value = i == 0 && point.value.has_value();
                    result.is_value.push_back(is_value);
                    result.values.push_back(is_value ? *point.value : 0.);
                  }
            }
          for (const auto &weights : moments)
            column.push_back(std::inner_product(weights.begin(),
                                                weights.end(),
                                                at_points.begin(),
                                                0.));
        }
      for (const auto &weights : moments)
        {
          AssertDimension(weights.size(), boundary.size());
          double sum = 0.;
          for (unsigned int q = 0; q < boundary.size(); ++q)
            if (weights[q] != 0.)
              sum += weights[q] * boundary[q].value.value();
          result.values.push_back(sum);
          result.is_value.push_back(false);
        }
      return result;
    }

    /** Fit the terms to the conditions, the moments exactly. */
    JumpFunction
    fit_terms(const std::vector<PolarSeries>       &terms,
              const std::vector<JumpBoundaryPoint> &boundary,
              const JumpMoments                    &moments,
              const JumpRows                       &rows)
    {
      // By weights: Householder's method is stable with them.
      constexpr double exact  = 1e7;
      double           length = 0.;
      for (const auto &point : boundary)
        length = std::max(length, radius_of(point));
      const auto conditions =
        make_conditions(terms, boundary, moments, rows, length);
      const auto        &values   = conditions.values;
      const unsigned int n        = terms.size(),
                         n_fitted = values.size() - moments.size();

      FullMatrix<double> matrix(values.size(), n);
      Vector<double>     right(values.size()), coefficients(n);
      for (unsigned int i = 0; i < values.size(); ++i)
        {
          // Moments first, whose rows are the large ones
          const unsigned int row    = (i + n_fitted) % values.size();
          const double       weight = row < n_fitted ? 1. : exact;
          right(i)                  = weight * values[row];
          for (unsigned int k = 0; k < n; ++k)
            matrix(i, k) = weight * conditions.columns[k][row];
        }
      Householder<double>(matrix).least_squares(coefficients, right);

      JumpFunction result;
      for (unsigned int k = 0; k < n; ++k)
        result.psi.add(terms[k].scaled(coefficients(k)).stretched(length));
      double       sum      = 0.;
      unsigned int n_values = 0;
      for (unsigned int i = 0; i < n_fitted; ++i)
        if (conditions.is_value[i])
          {
            double error = -values[i];
            for (unsigned int k = 0; k < n; ++k)
              error += coefficients(k) * conditions.columns[k][i];
            sum += error * error;
            ++n_values;
          }
      result.residual = std::sqrt(sum / n_values);
      return result;
    }

    PolarSeries
    polar_term(const double a, const double cosine, const double sine)
    {
      PolarSeries series;
      series.add(a, a, cosine, sine);
      return series;
    }
  } // namespace

  JumpFunction
  harmonic_jump(const std::vector<JumpBoundaryPoint> &boundary,
                const JumpMoments                    &moments)
  {
    constexpr unsigned int   order = 12;
    std::vector<PolarSeries> terms{polar_term(0., 1., 0.)};
    for (unsigned int k = 0; k < order; ++k)
      {
        terms.push_back(polar_term(k + 0.5, 0., 1.));
        terms.push_back(polar_term(k + 1., 1., 0.));
      }
    return fit_terms(terms,
                     boundary,
                     moments,
                     [](const JumpTerm &term, const JumpBoundaryPoint &point) {
                       return std::vector<double>{
                         point.value ?
                           term.value(radius_of(point),
                                      std::atan2(point.y, point.x)) :
                           normal_slope(term, point)};
                     });
  }

  JumpFunction
  biharmonic_jump(const std::vector<JumpBoundaryPoint> &boundary,
                  const double                          poissons_ratio,
                  const JumpMoments                    &moments)
  {
    constexpr unsigned int order = 20;
    // Of slopes, m_nn and V against values, in units of the cell's radius:
    // the values make the displacements continuous.
    constexpr double         slope_weight = 0.1, moment_weight = 0.02;
    std::vector<PolarSeries> terms{polar_term(0., 1., 0.),
                                   polar_term(1., 1., 0.),
                                   polar_term(1., 0., 1.)};
    for (unsigned int n = 1; n <= order; ++n)
      for (const bool symmetric : {true, false})
        terms.push_back(bending_williams_series(n, symmetric, poissons_ratio));
    return fit_terms(terms,
                     boundary,
                     moments,
                     [&](const JumpTerm &term, const JumpBoundaryPoint &point) {
                       if (point.value)
                         return std::vector<double>{
                           term.value(radius_of(point),
                                      std::atan2(point.y, point.x)),
                           slope_weight * normal_slope(term, point)};
                       auto forces = plate_forces(term, point, poissons_ratio);
                       forces[0] *= moment_weight;
                       forces[1] *= moment_weight * moment_weight;
                       return forces;
                     });
  }
} // namespace Nacre
