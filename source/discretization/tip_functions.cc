// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/tip_functions.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  void
  FieldDerivatives::add(const double factor, const FieldDerivatives &other)
  {
    value += factor * other.value;
    for (unsigned int a = 0; a < 2; ++a)
      first[a] += factor * other.first[a];
    for (unsigned int v = 0; v < 3; ++v)
      second[v] += factor * other.second[v];
  }

  TipFunctions
  TipFunctions::branch_functions(const Tip   &tip,
                                 const double poissons_ratio,
                                 const double length)
  {
    // 2 mu = 1: the membrane fields are of order 1 at the distance 1.
    const ElasticPlate         plate{1. + poissons_ratio, poissons_ratio, 1.};
    std::vector<WilliamsField> fields;
    for (const unsigned int n : {1, 3})
      for (const bool symmetric : {true, false})
        {
          fields.push_back(
            membrane_williams_field(n, symmetric, plate).stretched(length));
          fields.push_back(
            bending_williams_field(n, symmetric, plate).stretched(length));
        }
    return TipFunctions(tip, fields, length);
  }

  TipFunctions
  TipFunctions::branch_scalars(const Tip   &tip,
                               const double poissons_ratio,
                               const double length)
  {
    std::vector<PolarSeries> scalars;
    for (const unsigned int n : {1, 3})
      for (const double frequency : {0.5 * n, 0.5 * n - 2.})
        for (const bool symmetric : {true, false})
          {
            PolarSeries f;
            f.add(0.5 * n, frequency, symmetric ? 1. : 0., symmetric ? 0. : 1.);
            scalars.push_back(f.stretched(length));
          }
    for (const bool symmetric : {true, false})
      scalars.push_back(bending_williams_series(3, symmetric, poissons_ratio)
                          .stretched(length));
    return TipFunctions(tip, scalars, length);
  }

  TipFunctions::TipFunctions(const Tip                      &tip,
                             const std::vector<PolarSeries> &scalars,
                             const double                    length)
    : tip_(tip)
    , length_(length)
    , are_scalars_(true)
  {
    for (const PolarSeries &f : scalars)
      fields_.emplace_back(std::array<PolarSeries, 3>{{f, {}, {}}});
  }

  std::pair<double, double>
  TipFunctions::polar_coordinates(const Tensor<1, 3> &position,
                                  const int           side) const
  {
    const Tensor<1, 3> d = position - tip_.position;
    const double       x = d * tip_.axes[0];
    double             y = d * tip_.axes[1];
    // On the crack's line the sheet is that of the side.
    if (std::abs(y) < 1e-11 * length_)
      y = 0.;
    double theta = std::atan2(y, x);
    if (side > 0 && theta < -0.5 * numbers::PI)
      theta += 2. * numbers::PI;
    if (side < 0 && theta > 0.5 * numbers::PI)
      theta -= 2. * numbers::PI;
    return {std::hypot(x, y), theta};
  }

  std::vector<Tensor<1, 3>>
  TipFunctions::values(const Point<3> &position, const int side) const
  {
    const auto [r, theta] = polar_coordinates(position, side);
    std::vector<Tensor<1, 3>> result;
    for (const auto &field : fields_)
      result.push_back(in_space(field.value(r, theta)));
    return result;
  }

  Tensor<1, 3>
  TipFunctions::sum(const std::vector<Tensor<1, 3>> &values,
                    const std::vector<double>       &coefficients) const
  {
    AssertDimension(values.size(), n_fields());
    AssertDimension(coefficients.size(), size());
    Tensor<1, 3> result;
    for (unsigned int i = 0; i < size(); ++i)
      result +=
        coefficients[i] *
        (are_scalars_ ? values[i / 3][0] * direction(i % 3) : values[i]);
    return result;
  }

  std::vector<double>
  TipFunctions::coefficients_of(const TipFunctions        &other,
                                const std::vector<double> &coefficients) const
  {
    AssertDimension(coefficients.size(), size());
    std::vector<double> result(coefficients);
    for (unsigned int i = 0; i < size(); ++i)
      result[i] *= std::pow(other.length_ / length_,
                            fields_[are_scalars_ ? i / 3 : i].degree());
    return result;
  }

  void
  TipFunctions::evaluate(const FieldDerivatives        &surface,
                         const int                      side,
                         std::vector<FieldDerivatives> &result) const
  {
    constexpr std::array<std::array<unsigned int, 2>, 3> pairs = {
      {{{0, 0}}, {{1, 1}}, {{0, 1}}}};
    const auto [exact_r, theta] = polar_coordinates(surface.value, side);
    // Output has points at the tip: no infinite stresses.
    const double r = std::max(exact_r, 1e-7 * length_);
    // x,a and x,ab of the plane's coordinates
    std::array<std::array<double, 2>, 2> d1;
    std::array<std::array<double, 3>, 2> d2;
    for (unsigned int i = 0; i < 2; ++i)
      {
        for (unsigned int a = 0; a < 2; ++a)
          d1[i][a] = tip_.axes[i] * surface.first[a];
        for (unsigned int v = 0; v < 3; ++v)
          d2[i][v] = tip_.axes[i] * surface.second[v];
      }
    result.resize(n_fields());
    for (unsigned int k = 0; k < n_fields(); ++k)
      {
        const auto &field    = fields_[k];
        const auto  gradient = field.gradient(r, theta);
        const auto  hessian  = field.hessian(r, theta);
        result[k].value      = in_space(field.value(exact_r, theta));
        for (unsigned int a = 0; a < 2; ++a)
          result[k].first[a] =
            in_space(d1[0][a] * gradient[0] + d1[1][a] * gradient[1]);
        for (unsigned int v = 0; v < 3; ++v)
          {
            const auto [a, b]   = pairs[v];
            result[k].second[v] = in_space(
              d1[0][a] * d1[0][b] * hessian[0] +
              d1[1][a] * d1[1][b] * hessian[1] +
              (d1[0][a] * d1[1][b] + d1[1][a] * d1[0][b]) * hessian[2] +
              d2[0][v] * gradient[0] + d2[1][v] * gradient[1]);
          }
      }
  }
} // namespace Nacre
