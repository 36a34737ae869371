// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>
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
    bool
    is_finite(const Tensor<1, 3> &point)
    {
      return std::isfinite(point[0]) && std::isfinite(point[1]) &&
             std::isfinite(point[2]);
    }

    constexpr unsigned int n_samples = 5;

    /** The Gauss points of a cell, then its corners: checked are these. */
    std::vector<Point<2>>
    sample_points(const unsigned int n_corners)
    {
      std::vector<Point<2>> points = n_corners == 3 ?
                                       QGaussSimplex<2>(4).get_points() :
                                       QGauss<2>(n_samples).get_points();
      for (unsigned int i = 0; i < n_corners; ++i)
        points.push_back(CoarseCell::unit_corner(n_corners, i));
      return points;
    }
  } // namespace


  ParametricSurface::ParametricSurface(SurfaceDescription &&description,
                                       const std::string   &where)
    : description_(std::move(description))
  {
    order_cells();
    find_lines();
    if (description_.has_parameter_lines)
      find_parameter_lines();
    if (!description_.is_checked)
      {
        check_not_degenerate(where);
        check_lines_meet(where);
      }
  }


  Point<3>
  ParametricSurface::chart(const unsigned int coarse_cell,
                           const Point<2>    &unit) const
  {
    AssertIndexRange(coarse_cell, description_.cells.size());
    return CoarseCell::position(description_.cells[coarse_cell].chart, unit);
  }


  Point<3>
  ParametricSurface::position(const unsigned int coarse_cell,
                              const Point<2>    &unit) const
  {
    return (*description_.map)(chart(coarse_cell, unit));
  }


  bool
  ParametricSurface::has_triangles() const
  {
    return description_.cells.front().vertices.size() == 3;
  }


  std::vector<Point<3>>
  ParametricSurface::vertices() const
  {
    std::vector<Point<3>> result(description_.n_vertices);
    for (const SurfaceDescription::Cell &cell : description_.cells)
      for (unsigned int i = 0; i < cell.vertices.size(); ++i)
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


  const EdgeNames &
  ParametricSurface::edge_names() const
  {
    return description_.edge_names;
  }


  const MeshRegions &
  ParametricSurface::regions() const
  {
    return description_.regions;
  }


  const std::vector<std::string> &
  ParametricSurface::notes() const
  {
    return description_.notes;
  }


  void
  ParametricSurface::find_parameter_lines()
  {
    auto &regions = description_.regions;
    Assert(regions.regions.size() == 1, ExcNotImplemented());
    for (auto &cell : description_.cells)
      {
        std::array<std::array<double, 2>, 2> lines{};
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          {
            const auto         side = cell.chart[alpha + 1] - cell.chart[0];
            const unsigned int parameter =
              std::abs(side[1]) > std::abs(side[0]) ? 1 : 0;
            lines[parameter][alpha] = side[parameter] > 0. ? 1. : -1.;
          }
        auto      &known = regions.parameter_lines;
        const auto found = std::find(known.begin(), known.end(), lines);
        cell.region      = found - known.begin();
        if (found == known.end())
          known.push_back(lines);
      }
    regions.regions.resize(regions.parameter_lines.size());
  }


  /**
   * deal.II wants neighbouring quadrilaterals to agree on the direction of
   * their common line. GridTools turns cells (by quarter turns, which keep the
   * normal); their charts must turn with them.
   */
  void
  ParametricSurface::order_cells()
  {
    if (has_triangles())
      return;
    std::vector<CellData<2>> data(description_.cells.size());
    for (unsigned int k = 0; k < data.size(); ++k)
      data[k].vertices.assign(description_.cells[k].vertices.begin(),
                              description_.cells[k].vertices.end());
    GridTools::consistently_order_cells(data);

    const auto &sides = CoarseCell::sides(4);
    for (unsigned int k = 0; k < data.size(); ++k)
      {
        const SurfaceDescription::Cell old  = description_.cells[k];
        SurfaceDescription::Cell      &cell = description_.cells[k];
        std::array<unsigned int, 4>    old_corner;
        for (unsigned int i = 0; i < 4; ++i)
          {
            const auto found = std::find(old.vertices.begin(),
                                         old.vertices.end(),
                                         data[k].vertices[i]);
            Assert(found != old.vertices.end(), ExcInternalError());
            old_corner[i]    = found - old.vertices.begin();
            cell.vertices[i] = *found;
            cell.chart[i]    = old.chart[old_corner[i]];
          }
        if (cell.chart.size() == 4)
          continue;
        for (const CoarseCell::Side &side : sides)
          for (const CoarseCell::Side &old_side : sides)
            if (std::minmax(old_corner[side.corners[0]],
                            old_corner[side.corners[1]]) ==
                std::minmax(old_side.corners[0], old_side.corners[1]))
              cell.chart[side.middle] = old.chart[old_side.middle];
      }
  }


  unsigned int
  ParametricSurface::edge_of(const CellLine &line) const
  {
    const SurfaceDescription::Cell &cell  = description_.cells[line.cell];
    const auto                      found = description_.edge_of_line.find(
      {cell.vertices[line.corners[0]], cell.vertices[line.corners[1]]});
    if (found != description_.edge_of_line.end())
      return found->second;
    for (unsigned int e = 0; e < description_.edges.size(); ++e)
      {
        const auto &contains = description_.edges[e].contains;
        if (contains && contains(cell.chart[line.corners[0]]) &&
            contains(cell.chart[line.corners[1]]))
          return e;
      }
    AssertThrow(false,
                ExcMessage("A boundary line of the surface belongs to none of "
                           "its named edges."));
    return numbers::invalid_unsigned_int;
  }


  void
  ParametricSurface::find_lines()
  {
    std::map<SurfaceDescription::Line, std::vector<CellLine>> lines;
    for (unsigned int k = 0; k < description_.cells.size(); ++k)
      {
        const auto &vertices = description_.cells[k].vertices;
        for (const auto &[ends, middle] : CoarseCell::sides(vertices.size()))
          {
            (void)middle;
            CellLine line{k, ends, 1};
            if (vertices[ends[0]] > vertices[ends[1]])
              line = {k, {{ends[1], ends[0]}}, -1};
            lines[{vertices[line.corners[0]], vertices[line.corners[1]]}]
              .push_back(line);
          }
      }

    for (const auto &[ends, sides] : lines)
      if (sides.size() == 1)
        boundary_lines_.push_back(
          {{{ends.first, ends.second}}, edge_of(sides[0])});
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
    if (!description_.cell_names.empty())
      {
        text << description_.cell_names[coarse_cell] << " at (" << point << ')';
        return text.str();
      }
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
   * Second-order differences taken inside of the cell, so that a pole gives
   * zero (to step^2) and a crease on a mesh line does no harm.
   */
  std::array<Tensor<1, 3>, 2>
  ParametricSurface::tangents(const unsigned int coarse_cell,
                              const Point<2>    &unit) const
  {
    const double                step = 1e-5;
    const Point<3>              x0   = position(coarse_cell, unit);
    std::array<Tensor<1, 3>, 2> result;
    for (unsigned int a = 0; a < 2; ++a)
      {
        const double inward = unit[a] < 0.5 ? step : -step;
        Point<2>     p1 = unit, p2 = unit;
        p1[a] += inward;
        p2[a] += 2. * inward;
        result[a] = (4. * (position(coarse_cell, p1) - x0) -
                     (position(coarse_cell, p2) - x0)) /
                    (2. * inward);
      }
    return result;
  }


  void
  ParametricSurface::check_not_degenerate(const std::string &where) const
  {
    const double tolerance = 1e-7;

    const unsigned int          n_corners = has_triangles() ? 3 : 4;
    const std::vector<Point<2>> points    = sample_points(n_corners);
    std::vector<std::array<Tensor<1, 3>, 2>> t(points.size());
    for (unsigned int k = 0; k < description_.cells.size(); ++k)
      {
        std::array<double, 2> longest{{0., 0.}};
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            AssertThrow(is_finite(position(k, points[q])),
                        ExcMessage(where + ": the position at " +
                                   describe(k, points[q]) + " isn't finite."));
            t[q] = tangents(k, points[q]);
            for (unsigned int a = 0; a < 2; ++a)
              longest[a] = std::max(longest[a], t[q][a].norm());
          }
        for (unsigned int q = 0; q < points.size(); ++q)
          AssertThrow(cross_product_3d(t[q][0], t[q][1]).norm() >
                        tolerance * longest[0] * longest[1],
                      ExcMessage(
                        where + ": the surface is degenerate at " +
                        describe(k, points[q]) +
                        ": its area Jacobian |x,u x x,v| is zero there. Every "
                        "point needs two independent tangents (no poles, no "
                        "sides shrunk to a point or a line)."));
        if (n_corners == 3)
          continue;
        // Along a line of Gauss points the surface must not turn back.
        for (unsigned int q = 0; q < n_samples * n_samples; ++q)
          for (unsigned int a = 0; a < 2; ++a)
            {
              if ((a == 0 ? q % n_samples : q / n_samples) + 1 == n_samples)
                continue;
              const unsigned int next = q + (a == 0 ? 1 : n_samples);
              AssertThrow(t[q][a] * t[next][a] >
                            -0.9 * t[q][a].norm() * t[next][a].norm(),
                          ExcMessage(where +
                                     ": the surface is degenerate: it "
                                     "turns back on itself between " +
                                     describe(k, points[q]) + " and " +
                                     describe(k, points[next]) + "."));
            }
      }
  }


  Point<2>
  ParametricSurface::unit_point(const CellLine &line, const double t) const
  {
    const unsigned int n = description_.cells[line.cell].vertices.size();
    return Point<2>((1. - t) * CoarseCell::unit_corner(n, line.corners[0]) +
                    t * CoarseCell::unit_corner(n, line.corners[1]));
  }


  Point<3>
  ParametricSurface::line_point(const CellLine &line, const double t) const
  {
    return position(line.cell, unit_point(line, t));
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
          text << where << ": the closed surface doesn't meet itself: at "
               << describe(second.cell, unit_point(second, t)) << " it is at ("
               << b << "), on the other side of the seam at (" << a
               << "). Give the range a full period, or choose Closed = none.";
          AssertThrow(false, ExcMessage(text.str()));
        }
  }
} // namespace Nacre
