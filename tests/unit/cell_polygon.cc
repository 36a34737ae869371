// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Parts of cut reference cells: areas, sides and rules. Coordinates have size
// 1: the floor of areas is the round-off of some hundred sums, 1e-13, unless
// points were moved, which costs up to 1e-10.

#include "unit_test.h"
#include <nacre/discretization/cell_polygon.h>
#include <nacre/discretization/part_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace Nacre;
using namespace UnitTests;

namespace
{
  using Parts  = std::vector<CellPolygon>;
  using Chains = std::vector<CutChain>;

  const auto quadrilateral = ReferenceCells::Quadrilateral;
  const auto triangle      = ReferenceCells::Triangle;

  double
  total_area(const Parts &parts)
  {
    double area = 0.;
    for (const auto &part : parts)
      area += part.area();
    return area;
  }

  double
  triangles_area(const CellPolygon &part)
  {
    double area = 0.;
    for (const auto &[a, b, c] : part.triangles())
      area +=
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    return area;
  }

  std::vector<double>
  areas(const Parts &parts)
  {
    std::vector<double> all;
    for (const auto &part : parts)
      all.push_back(part.area());
    return all;
  }

  /** Sorted areas are those of @p expected to @p tolerance. */
  bool
  have_areas(const Parts        &parts,
             std::vector<double> expected,
             const double        tolerance = 1e-13)
  {
    auto found = areas(parts);
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    return found.size() == expected.size() &&
           std::equal(found.begin(),
                      found.end(),
                      expected.begin(),
                      [&](const double a, const double b) {
                        return std::abs(a - b) < tolerance;
                      });
  }

  /** Integral of x^i y^j by Green's theorem, exact to the degree of a side. */
  double
  integral(const CellPolygon &part, const unsigned int i, const unsigned int j)
  {
    const QGauss<1> gauss((i + j) / 2 + 2);
    double          sum = 0.;
    for (unsigned int v = 0; v < part.n_vertices(); ++v)
      {
        const Point<dim>    &a  = part.vertex(v);
        const Tensor<1, dim> ab = part.vertex((v + 1) % part.n_vertices()) - a;
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const Point<dim> x = a + gauss.point(q)[0] * ab;
            sum += gauss.weight(q) * ab[1] * std::pow(x[0], i + 1) *
                   std::pow(x[1], j) / (i + 1);
          }
      }
    return sum;
  }

  Chains
  reversed(Chains chains)
  {
    std::reverse(chains.begin(), chains.end());
    for (auto &chain : chains)
      std::reverse(chain.points.begin(), chain.points.end());
    return chains;
  }

  /** Vertices, up to the first one, and the sides' names are the same. */
  bool
  same(const CellPolygon &a, const CellPolygon &b)
  {
    const unsigned int n = a.n_vertices();
    if (n != b.n_vertices())
      return false;
    for (unsigned int i = 0; i < n; ++i)
      if (a.vertex(i).distance(b.vertex(i)) > 1e-12 ||
          a.side(i).face != b.side(i).face || a.side(i).cut != b.side(i).cut)
        return false;
    return true;
  }

  /** All that holds of any parts. */
  void
  check_parts(const ReferenceCell &cell, const Chains &chains)
  {
    const auto   parts = divide(cell, chains);
    const double whole = CellPolygon::whole(cell).area();
    BOOST_TEST(std::abs(total_area(parts) - whole) < 1e-13);
    for (const unsigned int face : cell.face_indices())
      {
        double length = 0.;
        for (const auto &part : parts)
          for (const auto &[s, t] : part.intervals(face))
            length += t - s;
        BOOST_TEST(std::abs(length - 1.) < 1e-13);
      }
    for (unsigned int i = 0; i < parts.size(); ++i)
      {
        BOOST_TEST(parts[i].area() > 1e-14);
        BOOST_TEST(std::abs(triangles_area(parts[i]) - parts[i].area()) <
                   1e-13);
        for (unsigned int k = 0; k < parts.size(); ++k)
          BOOST_TEST(parts[k].contains(parts[i].inner_point(), 0.) == (i == k));
      }
    const auto back = divide(cell, reversed(chains));
    BOOST_TEST(back.size() == parts.size());
    for (unsigned int i = 0; i < std::min(back.size(), parts.size()); ++i)
      BOOST_TEST(back[i].area() == parts[i].area(),
                 boost::test_tools::tolerance(1e-8));
  }

  /** Points on faces and inside, so that chains go anywhere. */
  Chains
  random_chains(const ReferenceCell &cell, std::mt19937 &generator)
  {
    std::uniform_real_distribution<> real(0., 1.);
    const auto                       on_face = [&] {
      const unsigned int face = generator() % cell.n_faces();
      const auto         a =
        cell.template vertex<dim>(cell.face_to_cell_vertices(face, 0, 1));
      const auto b =
        cell.template vertex<dim>(cell.face_to_cell_vertices(face, 1, 1));
      // now and then a vertex
      const double t = generator() % 5 == 0 ? generator() % 2 : real(generator);
      return Point<dim>(a + t * (b - a));
    };
    const auto inside = [&] {
      const double x = real(generator), y = real(generator);
      return cell == triangle && x + y > 1. ? Point<dim>(1. - x, 1. - y) :
                                              Point<dim>(x, y);
    };
    Chains chains;
    for (unsigned int c = 0; c <= generator() % 4; ++c)
      {
        CutChain chain{{}, c};
        chain.points.push_back(generator() % 6 == 0 ? inside() : on_face());
        for (unsigned int k = generator() % 3; k > 0; --k)
          chain.points.push_back(inside());
        chain.points.push_back(generator() % 6 == 0 ? inside() : on_face());
        // now and then a chain that begins on the one before
        if (c > 0 && generator() % 3 == 0)
          {
            const auto &other = chains.back().points;
            chain.points[0] =
              other[0] + real(generator) * (other[1] - other[0]);
          }
        chains.push_back(chain);
      }
    return chains;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(cell_polygon)

BOOST_AUTO_TEST_CASE(whole_cells)
{
  for (const auto &cell : {quadrilateral, triangle})
    {
      const auto whole = CellPolygon::whole(cell);
      BOOST_TEST(whole.n_vertices() == cell.n_vertices());
      BOOST_TEST(whole.area() == (cell == triangle ? 0.5 : 1.));
      BOOST_TEST(divide(cell, {}).size() == 1);
      check_parts(cell, {});
    }
}

BOOST_AUTO_TEST_CASE(one_chain)
{
  const auto parts =
    divide(quadrilateral, {{{{0., .2}, {.5, .4}, {1., .2}}, 7}});
  BOOST_TEST(have_areas(parts, {.3, .7}));
  BOOST_TEST(parts[0].area() < 0.5); // the lower one comes first
  unsigned int n_lips = 0;
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int i = 0; i < parts[k].n_vertices(); ++i)
      if (parts[k].side(i).face == numbers::invalid_unsigned_int)
        {
          ++n_lips;
          BOOST_TEST(parts[k].side(i).cut == 7);
          BOOST_TEST(parts[k].side(i).is_left == (k == 1));
        }
  BOOST_TEST(n_lips == 4);
  // face 0 runs upwards at x = 0
  BOOST_TEST(parts[0].intervals(0)[0][1] == .2);
  BOOST_TEST(parts[1].intervals(0)[0][0] == .2);
  BOOST_TEST(parts[0].intervals(3).empty());
  BOOST_TEST(parts[0].contains({.5, .39}, 0.));
  BOOST_TEST(!parts[0].contains({.5, .41}, 0.));
  BOOST_TEST(parts[0].contains({.5, .41}, .011));
}

BOOST_AUTO_TEST_CASE(ends_are_snapped)
{
  // 1e-11 before and beyond the faces
  const auto parts =
    divide(quadrilateral, {{{{1e-11, .25}, {1. + 1e-11, .25}}, 0}});
  BOOST_TEST(have_areas(parts, {.25, .75}));
  for (unsigned int i = 0; i < 4; ++i)
    BOOST_TEST((parts[0].vertex(i)[0] == 0. || parts[0].vertex(i)[0] == 1.));
  const auto corner =
    divide(triangle, {{{{0., 1e-11}, {.5 + 1e-11, .5 + 1e-11}}, 0}});
  BOOST_TEST(have_areas(corner, {.25, .25}, 1e-10));
  BOOST_TEST(corner[0].n_vertices() == 3);
  BOOST_TEST(corner[1].n_vertices() == 3);
}

BOOST_AUTO_TEST_CASE(crossings_and_junctions)
{
  const CutChain across{{{0., .5}, {1., .5}}, 0};
  const CutChain upward{{{.25, 0.}, {.25, 1.}}, 1};
  BOOST_TEST(have_areas(divide(quadrilateral, {across, upward}),
                        {.125, .125, .375, .375}));
  // A chain that ends on another, in any order.
  const CutChain ends{{{.25, 0.}, {.25, .5}}, 1};
  for (const auto &chains : {Chains{across, ends}, Chains{ends, across}})
    {
      const auto parts = divide(quadrilateral, chains);
      BOOST_TEST(have_areas(parts, {.125, .375, .5}));
      check_parts(quadrilateral, chains);
    }
  // Loose ends beyond a crossing divide nothing.
  BOOST_TEST(
    have_areas(divide(quadrilateral,
                      {{{{0., .5}, {.75, .5}}, 0}, {{{.5, 0.}, {.5, .75}}, 1}}),
               {.25, .75}));
  // Three chains through one point.
  BOOST_TEST(
    divide(quadrilateral,
           {across, {{{0., 0.}, {1., 1.}}, 1}, {{{0., 1.}, {1., 0.}}, 2}})
      .size() == 6);
  // A chain that crosses itself.
  BOOST_TEST(have_areas(
    divide(quadrilateral, {{{{.25, 0.}, {.75, .5}, {.25, .5}, {.75, 0.}}, 0}}),
    {.0625, .0625, .875}));
}

BOOST_AUTO_TEST_CASE(vertices_and_faces)
{
  BOOST_TEST(
    have_areas(divide(quadrilateral, {{{{0., 0.}, {1., 1.}}, 0}}), {.5, .5}));
  BOOST_TEST(
    have_areas(divide(triangle, {{{{0., 0.}, {.5, .5}}, 0}}), {.25, .25}));
  // Along a face, then across.
  BOOST_TEST(divide(quadrilateral, {{{{0., 0.}, {1., 0.}}, 0}}).size() == 1);
  const auto parts =
    divide(quadrilateral, {{{{0., 0.}, {.5, 0.}, {1., .5}}, 0}});
  BOOST_TEST(have_areas(parts, {.125, .875}));
  // In by one face and out by the same: its interval has a gap.
  const Chains turn = {{{{.25, 0.}, {.25, .5}, {.75, .5}, {.75, 0.}}, 0}};
  const auto   u    = divide(quadrilateral, turn);
  BOOST_TEST(have_areas(u, {.25, .75}));
  const auto &around = u[0].area() > .5 ? u[0] : u[1];
  BOOST_TEST(around.intervals(2).size() == 2);
  BOOST_TEST(around.intervals(2)[0][1] == .25);
  BOOST_TEST(around.intervals(2)[1][0] == .75);
  check_parts(quadrilateral, turn);
  // A kink touches the opposite face: three parts.
  BOOST_TEST(
    have_areas(divide(quadrilateral, {{{{.25, 1.}, {.5, 0.}, {.75, 1.}}, 0}}),
               {.25, .375, .375}));
}

BOOST_AUTO_TEST_CASE(tips_and_closed_chains)
{
  BOOST_TEST(divide(quadrilateral, {{{{0., .3}, {.6, .3}}, 0}}).size() == 1);
  BOOST_TEST(
    divide(quadrilateral, {{{{.2, .3}, {.6, .3}}, 0}})[0].n_vertices() == 4);
  // A closed chain that begins on a face touches it in a point.
  const Chains touching = {{{{.5, 0.}, {.75, .5}, {.25, .5}, {.5, 0.}}, 0}};
  BOOST_TEST(have_areas(divide(quadrilateral, touching), {.125, .875}));
  check_parts(quadrilateral, touching);
  const CutChain hole{{{.3, .3}, {.7, .3}, {.5, .6}, {.3, .3}}, 0};
  BOOST_TEST(
    holds(complaint([&] { divide(quadrilateral, {hole}); }), "closed cut"));
  // Held by a stick, it is still a hole; by two, none.
  const CutChain stick{{{0., .3}, {.3, .3}}, 1};
  BOOST_TEST(holds(complaint([&] {
                     divide(quadrilateral, {hole, stick});
                   }),
                   "closed cut"));
  const CutChain other{{{1., .3}, {.7, .3}}, 1};
  BOOST_TEST(divide(quadrilateral, {hole, stick, other}).size() == 3);
}

BOOST_AUTO_TEST_CASE(parts_of_parts)
{
  const CutChain first{{{0., .2}, {.5, .8}, {1., .2}}, 0};
  const CutChain second{{{0., .5}, {1., .5}}, 1};
  const CutChain third{{{.4, 0.}, {.6, 1.}}, 2};
  Parts          parts = {CellPolygon::whole(quadrilateral)};
  for (const auto &chain : {first, second, third})
    {
      Parts next;
      for (const auto &part : parts)
        for (const auto &piece : part.split(chain))
          next.push_back(piece);
      parts = next;
    }
  BOOST_TEST(
    have_areas(parts, areas(divide(quadrilateral, {first, second, third}))));
  // A chain elsewhere changes nothing.
  const auto low = divide(quadrilateral, {first})[0];
  BOOST_TEST(low.split({{{0., .9}, {1., .9}}, 1}).size() == 1);
  BOOST_TEST(same(low.split({{{0., .9}, {1., .9}}, 1})[0], low));
}

BOOST_AUTO_TEST_CASE(random_parts)
{
  std::mt19937 generator(1);
  for (unsigned int n = 0; n < 400; ++n)
    for (const auto &cell : {quadrilateral, triangle})
      {
        const auto chains = random_chains(cell, generator);
        try
          {
            check_parts(cell, chains);
          }
        catch (const ExceptionBase &exception)
          {
            // Chains may enclose a hole, nothing else may go wrong.
            BOOST_TEST(holds(exception.what(), "closed cut"));
          }
      }
}

BOOST_AUTO_TEST_CASE(rules)
{
  std::mt19937 generator(2);
  for (const unsigned int p : {2, 5})
    for (const auto &cell : {quadrilateral, triangle})
      for (const auto &part : divide(cell, random_chains(cell, generator)))
        {
          const auto rule = part_quadrature(part, p);
          for (unsigned int i = 0; i <= 4 * p; ++i)
            {
              const unsigned int j   = 4 * p - i;
              double             sum = 0.;
              for (unsigned int q = 0; q < rule.size(); ++q)
                sum += rule.weight(q) * std::pow(rule.point(q)[0], i) *
                       std::pow(rule.point(q)[1], j);
              // Green's boundary terms are up to 1 / (i + 1), not small.
              BOOST_TEST(std::abs(sum - integral(part, i, j)) < 1e-14);
            }
          for (unsigned int q = 0; q < rule.size(); ++q)
            {
              BOOST_TEST(rule.weight(q) > 0.);
              BOOST_TEST(part.contains(rule.point(q), 1e-14));
            }
        }
}

BOOST_AUTO_TEST_SUITE_END()
