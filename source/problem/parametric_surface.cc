// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/parametric_surface.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Local vertices of the four lines, counterclockwise around the cell. */
    constexpr unsigned int line_corners[4][2] = {{0, 1},
                                                 {1, 3},
                                                 {3, 2},
                                                 {2, 0}};

    Point<2>
    unit_corner(const unsigned int corner)
    {
      return {double(corner % 2), double(corner / 2)};
    }

    bool
    is_finite(const Tensor<1, 3> &point)
    {
      return std::isfinite(point[0]) && std::isfinite(point[1]) &&
             std::isfinite(point[2]);
    }

    constexpr unsigned int n_samples = 5;

    /** The Gauss points of a cell, then its corners: checked are these. */
    std::vector<Point<2>>
    sample_points()
    {
      std::vector<Point<2>> points = QGauss<2>(n_samples).get_points();
      for (unsigned int i = 0; i < 4; ++i)
        points.push_back(unit_corner(i));
      return points;
    }
  } // namespace


  ParametricSurface::ParametricSurface(SurfaceDescription &&description,
                                       const std::string   &where)
    : description_(std::move(description))
  {
    order_cells();
    find_lines();
    check_not_degenerate(where);
    check_lines_meet(where);
  }


  Point<3>
  ParametricSurface::chart(const unsigned int coarse_cell,
                           const Point<2>    &unit) const
  {
    AssertIndexRange(coarse_cell, description_.cells.size());
    const auto  &corners = description_.cells[coarse_cell].chart;
    const double x = unit[0], y = unit[1];
    Point<3>     result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = (1. - y) * ((1. - x) * corners[0][c] + x * corners[1][c]) +
                  y * ((1. - x) * corners[2][c] + x * corners[3][c]);
    return result;
  }


  Point<3>
  ParametricSurface::position(const unsigned int coarse_cell,
                              const Point<2>    &unit) const
  {
    return (*description_.map)(chart(coarse_cell, unit));
  }


  std::vector<Point<3>>
  ParametricSurface::vertices() const
  {
    std::vector<Point<3>> result(description_.n_vertices);
    for (const SurfaceDescription::Cell &cell : description_.cells)
      for (unsigned int i = 0; i < 4; ++i)
        result[cell.vertices[i]] = (*description_.map)(cell.chart[i]);
    return result;
  }


  const std::vector<SurfaceDescription::Cell> &
  ParametricSurface::cells() const
  {
    return description_.cells;
  }


  const std::vector<SurfaceDescription::Edge> &
  ParametricSurface::edges() const
  {
    return description_.edges;
  }


  const std::vector<ParametricSurface::BoundaryLine> &
  ParametricSurface::boundary_lines() const
  {
    return boundary_lines_;
  }


  /**
   * deal.II wants neighbours to agree on the direction of their common line.
   * GridTools turns cells (by quarter turns, which keep the normal); their
   * charts must turn with them.
   */
  void
  ParametricSurface::order_cells()
  {
    std::vector<CellData<2>> data(description_.cells.size());
    for (unsigned int k = 0; k < data.size(); ++k)
      data[k].vertices.assign(description_.cells[k].vertices.begin(),
                              description_.cells[k].vertices.end());
    GridTools::consistently_order_cells(data);

    for (unsigned int k = 0; k < data.size(); ++k)
      {
        const SurfaceDescription::Cell old  = description_.cells[k];
        SurfaceDescription::Cell      &cell = description_.cells[k];
        for (unsigned int i = 0; i < 4; ++i)
          {
            const auto found = std::find(old.vertices.begin(),
                                         old.vertices.end(),
                                         data[k].vertices[i]);
            Assert(found != old.vertices.end(), ExcInternalError());
            cell.vertices[i] = *found;
            cell.chart[i]    = old.chart[found - old.vertices.begin()];
          }
      }
  }


  void
  ParametricSurface::find_lines()
  {
    std::map<std::pair<unsigned int, unsigned int>, std::vector<CellLine>>
      lines;
    for (unsigned int k = 0; k < description_.cells.size(); ++k)
      for (const auto &ends : line_corners)
        {
          const auto &vertices = description_.cells[k].vertices;
          CellLine    line{k, {{ends[0], ends[1]}}, 1};
          if (vertices[ends[0]] > vertices[ends[1]])
            line = {k, {{ends[1], ends[0]}}, -1};
          lines[{vertices[line.corners[0]], vertices[line.corners[1]]}]
            .push_back(line);
        }

    for (const auto &[ends, sides] : lines)
      if (sides.size() == 1)
        {
          const auto &chart = description_.cells[sides[0].cell].chart;
          const auto  edge =
            std::find_if(description_.edges.begin(),
                         description_.edges.end(),
                         [&](const SurfaceDescription::Edge &edge) {
                           return edge.contains(chart[sides[0].corners[0]]) &&
                                  edge.contains(chart[sides[0].corners[1]]);
                         });
          AssertThrow(edge != description_.edges.end(),
                      ExcMessage("A boundary line of the surface belongs to "
                                 "none of its named edges."));
          boundary_lines_.push_back(
            {{{ends.first, ends.second}},
             static_cast<unsigned int>(edge - description_.edges.begin())});
        }
      else
        {
          // deal.II would accept both silently.
          AssertThrow(sides.size() == 2 && sides[0].side == -sides[1].side,
                      ExcMessage(
                        "The cells of the surface don't have one "
                        "orientation, or more than two share a line."));
          interior_lines_.emplace_back(sides[0], sides[1]);
        }
  }


  std::string
  ParametricSurface::describe(const unsigned int coarse_cell,
                              const Point<2>    &unit) const
  {
    const Point<3>     point = chart(coarse_cell, unit);
    std::ostringstream text;
    text << '(' << point[0] << ", " << point[1];
    // Surfaces over a rectangle have no third coordinate.
    bool rectangle = true;
    for (const SurfaceDescription::Cell &cell : description_.cells)
      for (const Point<3> &corner : cell.chart)
        rectangle = rectangle && corner[2] == 0.;
    if (!rectangle)
      text << ", " << point[2];
    text << ')';
    return (rectangle ? "(u, v) = " : "the chart point ") + text.str();
  }


  /**
   * The tangents are second-order differences taken inside of the cell, so
   * that a pole gives zero (to step^2) and a crease on a mesh line does no
   * harm.
   */
  void
  ParametricSurface::check_not_degenerate(const std::string &where) const
  {
    const double step      = 1e-5;
    const double tolerance = 1e-7;

    const std::vector<Point<2>>              points = sample_points();
    std::vector<double>                      jacobians(points.size());
    std::vector<std::array<Tensor<1, 3>, 2>> all_tangents(points.size());
    for (unsigned int k = 0; k < description_.cells.size(); ++k)
      {
        std::array<double, 2> longest{{0., 0.}};
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const Point<3> x0 = position(k, points[q]);
            AssertThrow(is_finite(x0),
                        ExcMessage(where + ": the position at " +
                                   describe(k, points[q]) + " isn't finite."));
            std::array<Tensor<1, 3>, 2> tangents;
            for (unsigned int a = 0; a < 2; ++a)
              {
                const double inward = points[q][a] < 0.5 ? step : -step;
                Point<2>     p1 = points[q], p2 = points[q];
                p1[a] += inward;
                p2[a] += 2. * inward;
                tangents[a] =
                  (4. * (position(k, p1) - x0) - (position(k, p2) - x0)) /
                  (2. * inward);
                longest[a] = std::max(longest[a], tangents[a].norm());
              }
            jacobians[q]    = cross_product_3d(tangents[0], tangents[1]).norm();
            all_tangents[q] = tangents;
          }
        for (unsigned int q = 0; q < points.size(); ++q)
          AssertThrow(jacobians[q] > tolerance * longest[0] * longest[1],
                      ExcMessage(
                        where + ": the surface is degenerate at " +
                        describe(k, points[q]) +
                        ": its area Jacobian |x,u x x,v| is zero there. Every "
                        "point needs two independent tangents (no poles, no "
                        "sides shrunk to a point or a line)."));
        // Along a line of Gauss points the surface must not turn back.
        for (unsigned int q = 0; q < n_samples * n_samples; ++q)
          for (unsigned int a = 0; a < 2; ++a)
            {
              if ((a == 0 ? q % n_samples : q / n_samples) + 1 == n_samples)
                continue;
              const unsigned int  next = q + (a == 0 ? 1 : n_samples);
              const Tensor<1, 3> &t    = all_tangents[q][a],
                                 &s    = all_tangents[next][a];
              AssertThrow(t * s > -0.9 * t.norm() * s.norm(),
                          ExcMessage(where +
                                     ": the surface is degenerate: it "
                                     "turns back on itself between " +
                                     describe(k, points[q]) + " and " +
                                     describe(k, points[next]) + "."));
            }
      }
  }


  Point<3>
  ParametricSurface::line_point(const CellLine &line, const double t) const
  {
    return position(line.cell,
                    Point<2>((1. - t) * unit_corner(line.corners[0]) +
                             t * unit_corner(line.corners[1])));
  }


  void
  ParametricSurface::check_lines_meet(const std::string &where) const
  {
    const std::vector<Point<3>> corners = vertices();
    double                      extent  = 0.;
    for (const Point<3> &corner : corners)
      extent = std::max(extent, corner.distance(corners[0]));

    for (const auto &[first, second] : interior_lines_)
      for (const double t : {0., 0.3, 0.5, 0.7, 1.})
        {
          const Point<3> a = line_point(first, t);
          const Point<3> b = line_point(second, t);
          if (a.distance(b) <= 1e-9 * extent)
            continue;
          std::ostringstream text;
          const Point<2>     unit((1. - t) * unit_corner(second.corners[0]) +
                              t * unit_corner(second.corners[1]));
          text << where << ": the closed surface doesn't meet itself: at "
               << describe(second.cell, unit) << " it is at (" << b
               << "), on the other side of the seam at (" << a
               << "). Give the range a full period, or choose Closed = none.";
          AssertThrow(false, ExcMessage(text.str()));
        }
  }
} // namespace Nacre
