// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Tied strains: interpolation from the samples reproduces the strains that a
// cell of the degree p can have without locking.

#include "unit_test.h"
#include <nacre/discretization/membrane_tying.h>

#include <cmath>

using namespace Nacre;

namespace
{
  /** (e11, e22, 2 e12) at a point of the reference cell. */
  using Strain = std::function<std::array<double, 3>(const Point<dim> &)>;

  double
  largest_error(const Element                 &element,
                const std::vector<Point<dim>> &targets,
                const Strain                  &strain)
  {
    const MembraneTying tying(element, targets);
    std::vector<double> samples;
    for (const auto &[point, direction] : tying.samples())
      {
        const auto e = strain(tying.points()[point]);
        samples.push_back(direction[0] * e[0] + direction[1] * e[1] +
                          direction[2] * e[2]);
      }
    double error = 0.;
    for (unsigned int q = 0; q < targets.size(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          double value = 0.;
          for (const auto &[sample, weight] : tying.weights(q, v))
            value += weight * samples[sample];
          error = std::max(error, std::abs(value - strain(targets[q])[v]));
        }
    return error;
  }

  const std::vector<Point<dim>> targets = {{0.1, 0.2},
                                           {0.5, 0.3},
                                           {0.05, 0.9},
                                           {0.31, 0.64}};
} // namespace

BOOST_AUTO_TEST_SUITE(tying)

BOOST_AUTO_TEST_CASE(quadrilaterals)
{
  for (const unsigned int p : {2, 3, 4, 5})
    {
      const Element element{ElementType::lagrange, p};
      // e11 of degree p - 1 along xi1, p along xi2; 2 e12 of p - 1 in both
      const Strain kept = [p](const Point<dim> &x) {
        return std::array<double, 3>{{std::pow(x[0], p - 1) * std::pow(x[1], p),
                                      std::pow(x[0], p) * std::pow(x[1], p - 1),
                                      std::pow(x[0] * x[1], p - 1)}};
      };
      BOOST_TEST(largest_error(element, targets, kept) < 1e-13);
      // One degree more along xi1 is what locks: it is not kept.
      const Strain locking = [p](const Point<dim> &x) {
        return std::array<double, 3>{{std::pow(x[0], p), 0., 0.}};
      };
      BOOST_TEST(largest_error(element, targets, locking) > 1e-4);
    }
}

BOOST_AUTO_TEST_CASE(triangles)
{
  const Element element{ElementType::triangle, 2};
  const Strain  linear = [](const Point<dim> &x) {
    return std::array<double, 3>{
      {1. + x[0] - 2. * x[1], 0.5 * x[1], 2. - x[0] + x[1]}};
  };
  BOOST_TEST(largest_error(element, targets, linear) < 1e-13);
}

BOOST_AUTO_TEST_CASE(untied_strains_are_their_samples)
{
  const auto tying = MembraneTying::untied(targets);
  BOOST_TEST(tying.points().size() == targets.size());
  BOOST_TEST(tying.samples().size() == 3 * targets.size());
}

BOOST_AUTO_TEST_SUITE_END()
