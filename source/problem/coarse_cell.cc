// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>

#include <deal.II/base/exceptions.h>

namespace Nacre::CoarseCell
{
  namespace
  {
    /** Values and derivatives of the functions of a cell at one point. */
    struct Shapes
    {
      std::array<double, 9>                value{};
      std::array<std::array<double, 9>, 2> derivative{};
    };

    /** In one direction: the functions at 0, 1 and, of degree two, at 1/2. */
    struct Line
    {
      Line(const double x, const bool quadratic)
      {
        if (quadratic)
          {
            value = {
              {(1. - 2. * x) * (1. - x), x * (2. * x - 1.), 4. * x * (1. - x)}};
            derivative = {{4. * x - 3., 4. * x - 1., 4. - 8. * x}};
          }
        else
          {
            value      = {{1. - x, x, 0.}};
            derivative = {{-1., 1., 0.}};
          }
      }

      std::array<double, 3> value;
      std::array<double, 3> derivative;
    };

    /** Of every node of a quadrilateral, its functions along x and y. */
    constexpr unsigned int quadrilateral_nodes[9][2] =
      {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 0}, {2, 1}, {2, 2}};

    Shapes
    quadrilateral(const unsigned int n_points, const Point<2> &unit)
    {
      const Line x(unit[0], n_points == 9), y(unit[1], n_points == 9);
      Shapes     shapes;
      for (unsigned int a = 0; a < n_points; ++a)
        {
          const auto [i, j]       = quadrilateral_nodes[a];
          shapes.value[a]         = x.value[i] * y.value[j];
          shapes.derivative[0][a] = x.derivative[i] * y.value[j];
          shapes.derivative[1][a] = x.value[i] * y.derivative[j];
        }
      return shapes;
    }

    Shapes
    triangle(const unsigned int n_points, const Point<2> &unit)
    {
      const std::array<double, 3> L{{1. - unit[0] - unit[1], unit[0], unit[1]}};
      constexpr double            dL[2][3] = {{-1., 1., 0.}, {-1., 0., 1.}};
      Shapes                      shapes;
      for (unsigned int a = 0; a < 3; ++a)
        {
          const unsigned int b = (a + 1) % 3;
          const bool         q = n_points == 6;
          shapes.value[a]      = q ? L[a] * (2. * L[a] - 1.) : L[a];
          shapes.value[3 + a]  = 4. * L[a] * L[b];
          for (unsigned int alpha = 0; alpha < 2; ++alpha)
            {
              shapes.derivative[alpha][a] =
                (q ? 4. * L[a] - 1. : 1.) * dL[alpha][a];
              shapes.derivative[alpha][3 + a] =
                4. * (dL[alpha][a] * L[b] + L[a] * dL[alpha][b]);
            }
        }
      return shapes;
    }

    Shapes
    shapes_at(const unsigned int n_points, const Point<2> &unit)
    {
      Assert(n_points == 3 || n_points == 4 || n_points == 6 || n_points == 9,
             ExcInternalError());
      return n_points % 3 == 0 && n_points != 9 ? triangle(n_points, unit) :
                                                  quadrilateral(n_points, unit);
    }
  } // namespace


  const std::vector<Side> &
  sides(const unsigned int n_corners)
  {
    static const std::vector<Side> of_triangle      = {{{{0, 1}}, 3},
                                                       {{{1, 2}}, 4},
                                                       {{{2, 0}}, 5}};
    static const std::vector<Side> of_quadrilateral = {{{{0, 1}}, 6},
                                                       {{{1, 3}}, 5},
                                                       {{{3, 2}}, 7},
                                                       {{{2, 0}}, 4}};
    return n_corners == 3 ? of_triangle : of_quadrilateral;
  }


  Point<2>
  unit_corner(const unsigned int n_corners, const unsigned int corner)
  {
    (void)n_corners;
    AssertIndexRange(corner, n_corners);
    return {double(corner % 2), double(corner / 2)};
  }


  Point<3>
  position(const std::vector<Point<3>> &points, const Point<2> &unit)
  {
    const Shapes shapes = shapes_at(points.size(), unit);
    Point<3>     x;
    for (unsigned int a = 0; a < points.size(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        x[c] += shapes.value[a] * points[a][c];
    return x;
  }


  std::array<Tensor<1, 3>, 2>
  tangents(const std::vector<Point<3>> &points, const Point<2> &unit)
  {
    const Shapes                shapes = shapes_at(points.size(), unit);
    std::array<Tensor<1, 3>, 2> result;
    for (unsigned int alpha = 0; alpha < 2; ++alpha)
      for (unsigned int a = 0; a < points.size(); ++a)
        for (unsigned int c = 0; c < 3; ++c)
          result[alpha][c] += shapes.derivative[alpha][a] * points[a][c];
    return result;
  }


  Point<3>
  serendipity_centre(const std::vector<Point<3>> &points)
  {
    Point<3> centre;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int a = 0; a < 8; ++a)
        centre[c] += (a < 4 ? -0.25 : 0.5) * points[a][c];
    return centre;
  }


  const std::vector<unsigned int> &
  turned_over(const unsigned int n_points)
  {
    static const std::vector<unsigned int> triangle = {0, 2, 1, 5, 4, 3};
    static const std::vector<unsigned int> quadrilateral =
      {0, 2, 1, 3, 6, 7, 4, 5, 8};
    return n_points == 3 || n_points == 6 ? triangle : quadrilateral;
  }
} // namespace Nacre::CoarseCell
