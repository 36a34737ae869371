// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Tied strains: interpolation from the samples reproduces the strains that a
// cell of the degree p can have without locking.

#include "unit_test.h"
#include <nacre/discretization/membrane_tying.h>
#include <nacre/discretization/part_quadrature.h>

#include <cmath>

using namespace Nacre;

namespace
{
  /** (e11, e22, 2 e12) at a point of the reference cell. */
  using Strain = std::function<std::array<double, 3>(const Point<dim> &)>;

  /** The tied strain [3 target + component]. */
  std::vector<double>
  tied(const MembraneTying &tying,
       const unsigned int   n_targets,
       const Strain        &strain)
  {
    std::vector<double> samples;
    for (const auto &[point, direction] : tying.samples())
      {
        const auto e = strain(tying.points()[point]);
        samples.push_back(direction[0] * e[0] + direction[1] * e[1] +
                          direction[2] * e[2]);
      }
    tying.sum(samples);
    std::vector<double> values(3 * n_targets);
    for (unsigned int q = 0; q < n_targets; ++q)
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[sample, weight] : tying.weights(q, v))
          values[3 * q + v] += weight * samples[sample];
    return values;
  }

  double
  largest_error(const MembraneTying           &tying,
                const std::vector<Point<dim>> &targets,
                const Strain                  &strain)
  {
    const auto values = tied(tying, targets.size(), strain);
    double     error  = 0.;
    for (unsigned int q = 0; q < targets.size(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        error =
          std::max(error, std::abs(values[3 * q + v] - strain(targets[q])[v]));
    return error;
  }

  double
  largest_error(const Element                 &element,
                const std::vector<Point<dim>> &targets,
                const Strain                  &strain)
  {
    return largest_error(MembraneTying(element, targets), targets, strain);
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

namespace
{
  /** A cell's parts: a quarter, a slice, and a triangle of the size 0.02. */
  std::vector<CellPolygon>
  parts(const ReferenceCell &cell)
  {
    std::vector<CellPolygon> all;
    for (const auto &chain : {CutChain{{{0., .45}, {.5, .5}}, 0},
                              CutChain{{{.02, 0.}, {0., .02}}, 0},
                              CutChain{{{0., .3}, {.3, .5}, {.6, 0.}}, 0}})
      for (const auto &part : divide(cell, {chain}))
        all.push_back(part);
    for (const auto &part : divide(cell,
                                   {{{{0., .3}, {.7, .3}}, 0},
                                    {{{0., .302}, {.7, .301}}, 0},
                                    {{{.4, 0.}, {.4, .6}}, 0}}))
      all.push_back(part);
    return all;
  }

  /** An area element that varies. */
  double
  area_element(const Point<dim> &x)
  {
    return 1. + .3 * x[0] - .2 * x[0] * x[1];
  }
} // namespace

// Values are of size 1, at points of the part: the projection's round-off is
// some epsilon times the largest value of the polynomials, 1e-12.
BOOST_AUTO_TEST_CASE(projections)
{
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              Element{ElementType::serendipity, 2},
                              Element{ElementType::triangle, 2}})
    for (const auto &part : parts(element.reference_cell()))
      {
        const bool          triangle = element.type == ElementType::triangle;
        const int           p        = element.degree;
        const auto          rule     = part_quadrature(part, p);
        const auto         &points   = rule.get_points();
        std::vector<double> weights;
        for (unsigned int q = 0; q < rule.size(); ++q)
          weights.push_back(rule.weight(q) * area_element(points[q]));

        const std::array<std::array<int, 2>, 3> degrees = {
          {{{p - 1, p}}, {{p, p - 1}}, {{p - 1, p - 1}}}};
        const auto kept = [&](const Point<dim> &x) {
          std::array<double, 3> e;
          for (unsigned int v = 0; v < 3; ++v)
            e[v] = triangle ? v - 2. * x[0] + x[1] :
                              std::pow(x[0], degrees[v][0]) *
                                std::pow(x[1], degrees[v][1]);
          return e;
        };
        const auto tying =
          MembraneTying::projected(element, rule, weights, points);
        BOOST_TEST(largest_error(tying, points, kept) < 1e-12);
        // At the part's vertices, which lie beyond the points.
        std::vector<Point<dim>> vertices;
        for (unsigned int i = 0; i < part.n_vertices(); ++i)
          vertices.push_back(part.vertex(i));
        BOOST_TEST(largest_error(
                     MembraneTying::projected(element, rule, weights, vertices),
                     vertices,
                     kept) < 1e-11);

        // What isn't kept is orthogonal to what is; it has been 1 before.
        const auto rough = [&](const Point<dim> &x) {
          const double f = std::cos(7. * x[0] / (.1 + x[1]) + 3. * x[1]);
          return std::array<double, 3>{{f, f, f}};
        };
        const auto projection = tied(tying, points.size(), rough);
        for (unsigned int v = 0; v < 3; ++v)
          {
            double product = 0., square = 0., area = 0.;
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                const double rest = rough(points[q])[v] - projection[3 * q + v];
                product += weights[q] * kept(points[q])[v] * rest;
                square += weights[q] * rest * rest;
                area += weights[q];
              }
            BOOST_TEST(std::abs(product) < 1e-13 * area);
            BOOST_TEST(square > 1e-24 * area);
          }
      }
}

BOOST_AUTO_TEST_CASE(projection_onto_too_much)
{
  // xi1^p in e11 locks: a projection that kept it would do nothing.
  const Element element{ElementType::lagrange, 3};
  const auto    part =
    divide(element.reference_cell(), {{{{0., .4}, {1., .6}}, 0}})[0];
  const auto rule = part_quadrature(part, 3);
  for (unsigned int v = 0; v < 3; ++v)
    for (unsigned int c = 0; c < 2; ++c)
      {
        const unsigned int degree  = v < 2 && c != v ? 4 : 3;
        const Strain       locking = [&](const Point<dim> &x) {
          std::array<double, 3> e{};
          e[v] = std::pow(x[c], degree);
          return e;
        };
        BOOST_TEST(largest_error(MembraneTying::projected(element,
                                                          rule,
                                                          rule.get_weights(),
                                                          rule.get_points()),
                                 rule.get_points(),
                                 locking) > 1e-4);
      }
}

BOOST_AUTO_TEST_CASE(untied_strains_are_their_samples)
{
  const auto tying = MembraneTying::untied(targets);
  BOOST_TEST(tying.points().size() == targets.size());
  BOOST_TEST(tying.samples().size() == 3 * targets.size());
}

BOOST_AUTO_TEST_SUITE_END()
