// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/williams_fields.h>

#include <deal.II/base/numbers.h>

namespace Nacre
{
  PolarSeries
  PolarSeries::along_x() const
  {
    PolarSeries result;
    for (const auto &[a, b, c, s] : terms_)
      {
        const double m = 0.5 * (a + b), n = 0.5 * (a - b);
        result.add(a - 1., b - 1., m * c, m * s);
        result.add(a - 1., b + 1., n * c, n * s);
      }
    return result;
  }

  PolarSeries
  PolarSeries::along_y() const
  {
    // The term is the real part of (c - i s) z^m zbar^n.
    PolarSeries result;
    for (const auto &[a, b, c, s] : terms_)
      {
        const double m = 0.5 * (a + b), n = 0.5 * (a - b);
        result.add(a - 1., b - 1., m * s, -m * c);
        result.add(a - 1., b + 1., -n * s, n * c);
      }
    return result;
  }

  PolarSeries
  PolarSeries::scaled(const double factor) const
  {
    PolarSeries result;
    for (const auto &[a, b, c, s] : terms_)
      result.add(a, b, factor * c, factor * s);
    return result;
  }

  PolarSeries
  PolarSeries::stretched(const double length) const
  {
    PolarSeries result;
    for (const auto &[a, b, c, s] : terms_)
      {
        const double factor = std::pow(length, -a);
        result.add(a, b, factor * c, factor * s);
      }
    return result;
  }

  double
  PolarSeries::degree() const
  {
    double result = 0.;
    for (const Term &term : terms_)
      result = std::max(result, term.exponent);
    return result;
  }

  WilliamsField::WilliamsField(const std::array<PolarSeries, 3> &displacement)
    : values_(displacement)
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        gradients_[0][c] = values_[c].along_x();
        gradients_[1][c] = values_[c].along_y();
        hessians_[0][c]  = gradients_[0][c].along_x();
        hessians_[1][c]  = gradients_[1][c].along_y();
        hessians_[2][c]  = gradients_[0][c].along_y();
      }
  }

  WilliamsField
  WilliamsField::stretched(const double length) const
  {
    Components values;
    for (unsigned int c = 0; c < 3; ++c)
      values[c] = values_[c].stretched(length);
    return WilliamsField(values);
  }

  double
  WilliamsField::degree() const
  {
    return std::max(
      {values_[0].degree(), values_[1].degree(), values_[2].degree()});
  }

  namespace
  {
    /** u and v of membrane_williams_field(), times @p factor. */
    std::array<PolarSeries, 3>
    membrane_series(const unsigned int  n,
                    const bool          symmetric,
                    const ElasticPlate &plate,
                    const double        factor)
    {
      const double nu    = plate.poissons_ratio;
      const double kappa = (3. - nu) / (1. + nu);
      const double a     = 0.5 * n;
      const double sign  = n % 2 == 0 ? 1. : -1.;
      const double scale = factor * (1. + nu) / plate.youngs_modulus;

      std::array<PolarSeries, 3> u;
      if (symmetric)
        {
          u[0].add(a, a, scale * (kappa + a + sign), 0.);
          u[0].add(a, a - 2., -scale * a, 0.);
          u[1].add(a, a, 0., scale * (kappa - a - sign));
          u[1].add(a, a - 2., 0., scale * a);
        }
      else
        {
          u[0].add(a, a, 0., scale * (kappa + a - sign));
          u[0].add(a, a - 2., 0., -scale * a);
          u[1].add(a, a, -scale * (kappa - a + sign), 0.);
          u[1].add(a, a - 2., -scale * a, 0.);
        }
      return u;
    }
  } // namespace

  PolarSeries
  bending_williams_series(const unsigned int n,
                          const bool         symmetric,
                          const double       poissons_ratio)
  {
    const double nu     = poissons_ratio;
    const double lambda = 0.5 * n;
    // cos(b pi) vanishes for odd n, sin(b pi) for even n.
    const bool moment_remains = symmetric == (n % 2 == 0);
    const auto on_lips        = [&](const double b) {
      if (moment_remains)
        return -b * b + (lambda + 1.) * (1. + nu * lambda);
      return b * (b * b - (lambda + 1.) * (lambda + 1.) -
                  (1. - nu) * lambda * (lambda - 1.));
    };
    const double first = on_lips(lambda + 1.), second = on_lips(lambda - 1.);
    // One of the two may obey the condition alone: n = 6 for nu = 0.
    const double A = second == 0. && first != 0. ? 0. : 1.;
    const double B = second != 0. ? -first / second : 1. - A;

    PolarSeries w;
    for (const auto &[b, factor] :
         {std::make_pair(lambda + 1., A), std::make_pair(lambda - 1., B)})
      w.add(lambda + 1., b, symmetric ? factor : 0., symmetric ? 0. : factor);
    return w;
  }

  WilliamsField
  membrane_williams_field(const unsigned int  n,
                          const bool          symmetric,
                          const ElasticPlate &plate)
  {
    Assert(n > 0, ExcMessage("A rigid motion is no Williams field"));
    return WilliamsField(membrane_series(n, symmetric, plate, 1.));
  }

  WilliamsField
  bending_williams_field(const unsigned int  n,
                         const bool          symmetric,
                         const ElasticPlate &plate)
  {
    Assert(n > 0, ExcMessage("A rigid motion is no Williams field"));
    return WilliamsField(
      {{{}, {}, bending_williams_series(n, symmetric, plate.poissons_ratio)}});
  }

  WilliamsField
  unit_williams_field(const CrackMode mode, const ElasticPlate &plate)
  {
    const double root = std::sqrt(2. * numbers::PI);
    const double nu   = plate.poissons_ratio;
    if (mode == CrackMode::opening || mode == CrackMode::sliding)
      return WilliamsField(
        membrane_series(1, mode == CrackMode::opening, plate, 1. / root));

    // Moments follow from the curvature -w,ab.
    const PolarSeries w =
      bending_williams_series(1, mode == CrackMode::bending, nu);
    const auto   second = WilliamsField({{{}, {}, w}}).hessian(1., 0.);
    const double D      = plate.bending_stiffness();
    const double factor =
      mode == CrackMode::bending ?
        -1. / (root * D * (second[1][2] + nu * second[0][2])) :
        -(1. + nu) / ((3. + nu) * root * D * (1. - nu) * second[2][2]);
    return WilliamsField({{{}, {}, w.scaled(factor)}});
  }

  double
  unit_release_rate(const CrackMode mode, const ElasticPlate &plate)
  {
    const double nu = plate.poissons_ratio;
    if (mode == CrackMode::opening || mode == CrackMode::sliding)
      return plate.thickness / plate.youngs_modulus;
    return 1. / (plate.bending_stiffness() * (1. - nu) * (3. + nu));
  }
} // namespace Nacre
