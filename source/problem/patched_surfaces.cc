// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/surfaces.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Nacre
{
  namespace
  {
    bool
    equal(const double a, const double b)
    {
      return std::abs(a - b) < 1e-10;
    }

    /** Patches whose common vertices are recognised by their chart points. */
    class Patches
    {
    public:
      /**
       * Add @p n_x by @p n_y cells to the bilinear patch with the @p corners
       * in lexicographic order.
       */
      void
      add(const std::array<Point<3>, 4> &corners,
          const unsigned int             n_x,
          const unsigned int             n_y)
      {
        for (unsigned int j = 0; j < n_y; ++j)
          for (unsigned int i = 0; i < n_x; ++i)
            {
              SurfaceDescription::Cell cell;
              for (unsigned int k = 0; k < 4; ++k)
                {
                  const double x = double(i + k % 2) / n_x;
                  const double y = double(j + k / 2) / n_y;
                  Point<3>     chart;
                  for (unsigned int c = 0; c < 3; ++c)
                    chart[c] =
                      (1. - y) *
                        ((1. - x) * corners[0][c] + x * corners[1][c]) +
                      y * ((1. - x) * corners[2][c] + x * corners[3][c]);
                  cell.vertices[k] = vertex(chart);
                  cell.chart[k]    = charts_[cell.vertices[k]];
                }
              cells_.push_back(cell);
            }
      }

      SurfaceDescription
      finish(std::vector<SurfaceDescription::Edge> &&edges,
             std::unique_ptr<const ChartMap>         map)
      {
        SurfaceDescription surface;
        surface.n_vertices = charts_.size();
        surface.cells      = std::move(cells_);
        surface.edges      = std::move(edges);
        surface.map        = std::move(map);
        return surface;
      }

    private:
      unsigned int
      vertex(const Point<3> &chart)
      {
        std::array<long long, 3> key;
        for (unsigned int c = 0; c < 3; ++c)
          key[c] = std::llround(chart[c] * 1e9);
        const auto [entry, is_new] = indices_.try_emplace(key, charts_.size());
        if (is_new)
          charts_.push_back(chart);
        return entry->second;
      }

      std::map<std::array<long long, 3>, unsigned int> indices_;
      std::vector<Point<3>>                            charts_;
      std::vector<SurfaceDescription::Cell>            cells_;
    };

    std::function<bool(const Point<3> &)>
    coordinate_is_zero(const unsigned int coordinate)
    {
      return [coordinate](const Point<3> &chart) {
        return equal(chart[coordinate], 0.);
      };
    }

    /** See make_disk(). */
    Point<3>
    disk_position(const Point<3> &chart, const double radius)
    {
      const double inner = 0.4 * radius;
      const double m     = std::max(std::abs(chart[0]), std::abs(chart[1]));
      if (m <= 0.5)
        return Point<3>(2. * inner * chart[0], 2. * inner * chart[1], 0.);

      const unsigned int major = std::abs(chart[0]) == m ? 0 : 1;
      const double       sign  = chart[major] < 0. ? -1. : 1.;
      const double       t     = chart[1 - major] / m;
      const double       outer = 2. * m - 1.;
      Point<3>           result;
      result[major] = sign * ((1. - outer) * inner +
                              outer * radius * std::cos(t * numbers::PI_4));
      result[1 - major] =
        (1. - outer) * inner * t + outer * radius * std::sin(t * numbers::PI_4);
      return result;
    }

    /** See make_sphere(). */
    std::unique_ptr<const ChartMap>
    sphere_map(const double radius)
    {
      return make_chart_map([radius](const Point<3> &chart) {
        Tensor<1, 3> direction;
        for (unsigned int c = 0; c < 3; ++c)
          direction[c] = std::tan(chart[c] * numbers::PI_4);
        return Point<3>(radius / direction.norm() * direction);
      });
    }

    /**
     * The faces of the cube that a box [lower, 1] of [-1, 1]^3 has in common
     * with it, @p n cells along each coordinate, normals outward.
     */
    Patches
    cube_patches(const Point<3> &lower, const std::array<unsigned int, 3> &n)
    {
      Patches patches;
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (const double side : {-1., 1.})
          if (side == 1. || lower[axis] == -1.)
            {
              unsigned int a = (axis + 1) % 3, b = (axis + 2) % 3;
              if (side == -1.)
                std::swap(a, b);
              std::array<Point<3>, 4> corners;
              for (unsigned int k = 0; k < 4; ++k)
                {
                  corners[k][axis] = side;
                  corners[k][a]    = k % 2 == 0 ? lower[a] : 1.;
                  corners[k][b]    = k / 2 == 0 ? lower[b] : 1.;
                }
              patches.add(corners, n[a], n[b]);
            }
      return patches;
    }

    SurfaceDescription
    make_whole_hemisphere(const double                            radius,
                          const unsigned int                      n,
                          std::vector<SurfaceDescription::Edge> &&edges)
    {
      return cube_patches(Point<3>(-1., -1., 0.), {{n, n, (n + 1) / 2}})
        .finish(std::move(edges), sphere_map(radius));
    }

    SurfaceDescription
    make_octant(const double                            radius,
                const unsigned int                      n,
                std::vector<SurfaceDescription::Edge> &&edges)
    {
      return cube_patches(Point<3>(0., 0., 0.), {{n, n, n}})
        .finish(std::move(edges), sphere_map(radius));
    }

    SurfaceDescription
    make_hemisphere_with_hole(const SurfaceInput        &input,
                              const double               radius,
                              const double               hole,
                              const SurfaceInput::Range &azimuths)
    {
      const bool closed  = std::abs(azimuths[1] - azimuths[0] - 360.) < 1e-9;
      const bool quarter = azimuths[0] == 0. && equal(azimuths[1], 90.);

      ChartRectangle rectangle;
      rectangle.u       = input.mesh_lines(0, azimuths, closed);
      rectangle.v       = input.mesh_lines(1, {{0., 90. - hole}});
      rectangle.closed  = {{closed, false}};
      rectangle.aliases = {{{}, {}, {"equator", "z=0"}, {"hole"}}};
      if (quarter)
        {
          rectangle.aliases[0] = {"y=0"};
          rectangle.aliases[1] = {"x=0"};
        }
      return make_rectangle(rectangle,
                            make_chart_map([radius](const Point<3> &c) {
                              const double u = c[0] * numbers::PI / 180.;
                              const double v = c[1] * numbers::PI / 180.;
                              return Point<3>(radius * std::cos(v) *
                                                std::cos(u),
                                              radius * std::cos(v) *
                                                std::sin(u),
                                              radius * std::sin(v));
                            }));
    }
  } // namespace


  namespace
  {
    /** Of a disk. */
    enum class DiskPart
    {
      whole,
      half,
      quarter
    };

    const Selection<DiskPart> &
    selection(DiskPart)
    {
      static const Selection<DiskPart> table = {{DiskPart::whole, "whole"},
                                                {DiskPart::half, "half"},
                                                {DiskPart::quarter, "quarter"}};
      return table;
    }

    /** Of a sphere. */
    enum class SpherePart
    {
      whole,
      hemisphere,
      octant
    };

    const Selection<SpherePart> &
    selection(SpherePart)
    {
      static const Selection<SpherePart> table = {
        {SpherePart::whole, "whole"},
        {SpherePart::hemisphere, "hemisphere"},
        {SpherePart::octant, "octant"}};
      return table;
    }
  } // namespace

  SurfaceDescription
  make_disk(const SurfaceInput &input)
  {
    const double       radius = input.positive("Radius");
    const auto         part   = input.choice<DiskPart>("Part");
    const unsigned int n      = input.n_patch_cells();

    // Lower ends of the chart, and cells along x and y.
    const double       x0  = part == DiskPart::whole ? -1. : 0.;
    const double       y0  = part == DiskPart::quarter ? 0. : -1.;
    const unsigned int n_x = part == DiskPart::half ? (n + 1) / 2 : n;
    const unsigned int n_y = n;
    const auto         p   = [](const double x, const double y) {
      return Point<3>(x, y, 0.);
    };

    Patches patches;
    patches.add({{p(x0 / 2, y0 / 2), p(.5, y0 / 2), p(x0 / 2, .5), p(.5, .5)}},
                n_x,
                n_y);
    patches.add({{p(.5, y0 / 2), p(1., y0), p(.5, .5), p(1., 1.)}}, n, n_y);
    patches.add({{p(x0 / 2, .5), p(.5, .5), p(x0, 1.), p(1., 1.)}}, n_x, n);
    if (x0 < 0.)
      patches.add({{p(-1., y0), p(-.5, y0 / 2), p(-1., 1.), p(-.5, .5)}},
                  n,
                  n_y);
    if (y0 < 0.)
      patches.add({{p(x0, -1.), p(1., -1.), p(x0 / 2, -.5), p(.5, -.5)}},
                  n_x,
                  n);

    std::vector<SurfaceDescription::Edge> edges;
    edges.push_back({"rim", {}, [](const Point<3> &c) {
                       return equal(std::max(std::abs(c[0]), std::abs(c[1])),
                                    1.);
                     }});
    if (x0 == 0.)
      edges.push_back({"x=0", {}, coordinate_is_zero(0)});
    if (y0 == 0.)
      edges.push_back({"y=0", {}, coordinate_is_zero(1)});
    return patches.finish(std::move(edges),
                          make_chart_map([radius](const Point<3> &chart) {
                            return disk_position(chart, radius);
                          }));
  }


  std::vector<SurfaceParameter>
  disk_parameters()
  {
    return {
      {"Radius",
       "1",
       "Radius of the disk about the origin in the plane z = 0, normal +z. "
       "Units: length"},
      {"Part",
       "whole",
       "whole | half (x >= 0) | quarter (x >= 0, y >= 0). Edges: rim; x=0 of "
       "a half; x=0 and y=0 of a quarter. Subdivisions takes one number: "
       "cells along each side of the square inside of the disk, and from "
       "there to the rim. Units: none"}};
  }


  SurfaceDescription
  make_l_shaped_plate(const SurfaceInput &input)
  {
    const double       a = input.positive("Size");
    const unsigned int n = input.n_patch_cells();
    Patches            patches;
    for (const auto &[x, y] : {std::make_pair(-a, -a),
                               std::make_pair(-a, 0.),
                               std::make_pair(0., 0.)})
      patches.add({{Point<3>(x, y, 0.),
                    Point<3>(x + a, y, 0.),
                    Point<3>(x, y + a, 0.),
                    Point<3>(x + a, y + a, 0.)}},
                  n,
                  n);
    const auto line = [a](const unsigned int c, const double value) {
      return
        [=](const Point<3> &chart) { return equal(chart[c] / a, value / a); };
    };
    std::vector<SurfaceDescription::Edge> edges;
    edges.push_back({"x=0", {}, line(0, 0.)});
    edges.push_back({"y=0", {}, line(1, 0.)});
    edges.push_back({"left", {}, line(0, -a)});
    edges.push_back({"right", {}, line(0, a)});
    edges.push_back({"bottom", {}, line(1, -a)});
    edges.push_back({"top", {}, line(1, a)});
    return patches.finish(std::move(edges),
                          make_chart_map([](const Point<3> &c) {
                            return Point<3>(c[0], c[1], 0.);
                          }));
  }


  std::vector<SurfaceParameter>
  l_shaped_plate_parameters()
  {
    return {
      {"Size",
       "1",
       "Side a of the three squares of the plate: [-a,a] x [-a,a] in the plane "
       "z = 0 without its quarter x > 0, y < 0; normal +z. Edges: x=0 and y=0, "
       "which meet at the re-entrant corner at the origin, left, right, "
       "bottom, top. Subdivisions takes one number: cells along each side of a "
       "square. Units: length"}};
  }


  SurfaceDescription
  make_sphere(const SurfaceInput &input)
  {
    const double       radius = input.positive("Radius");
    const unsigned int n      = input.n_patch_cells();
    const auto         part   = input.choice<SpherePart>("Part");

    if (part == SpherePart::hemisphere)
      return make_whole_hemisphere(
        radius,
        n,
        {{"equator", {"z=0"}, coordinate_is_zero(2)}});
    if (part == SpherePart::octant)
      return make_octant(radius,
                         n,
                         {{"x=0", {}, coordinate_is_zero(0)},
                          {"y=0", {}, coordinate_is_zero(1)},
                          {"z=0", {"equator"}, coordinate_is_zero(2)}});
    return cube_patches(Point<3>(-1., -1., -1.), {{n, n, n}})
      .finish({}, sphere_map(radius));
  }


  std::vector<SurfaceParameter>
  sphere_parameters()
  {
    return {
      {"Radius",
       "1",
       "Radius of the sphere about the origin; the normal points outward. "
       "Units: length"},
      {"Part",
       "whole",
       "whole | hemisphere (z >= 0) | octant (x, y, z >= 0). Edges: equator "
       "or z=0 of a hemisphere; x=0, y=0, z=0 or equator of an octant. "
       "Subdivisions takes one number: cells along each edge of the six, five "
       "or three patches (half as many up the sides of a hemisphere). Units: "
       "none"}};
  }


  SurfaceDescription
  make_hemisphere(const SurfaceInput &input)
  {
    const double              radius   = input.positive("Radius");
    const double              hole     = input.number("Hole angle");
    const SurfaceInput::Range azimuths = input.angle_range("Azimuth range");
    AssertThrow(hole >= 0. && hole < 90.,
                ExcMessage(input.where("Hole angle") + ": found " +
                           input.text("Hole angle") +
                           "; it must be at least 0 (no hole) and less than "
                           "90 degrees."));
    if (hole > 0.)
      return make_hemisphere_with_hole(input, radius, hole, azimuths);

    const bool quarter = azimuths[0] == 0. && equal(azimuths[1], 90.);
    const bool whole   = azimuths[0] == 0. && equal(azimuths[1], 360.);
    AssertThrow(quarter || whole,
                ExcMessage(input.where("Azimuth range") + ": found '" +
                           input.text("Azimuth range") +
                           "'; without a hole it must be 0, 90 or 0, 360."));
    const unsigned int n = input.n_patch_cells();
    if (whole)
      return make_whole_hemisphere(
        radius,
        n,
        {{"v=0", {"equator", "z=0"}, coordinate_is_zero(2)}});
    return make_octant(radius,
                       n,
                       {{"u=0", {"y=0"}, coordinate_is_zero(1)},
                        {"u=1", {"x=0"}, coordinate_is_zero(0)},
                        {"v=0", {"equator", "z=0"}, coordinate_is_zero(2)}});
  }


  std::vector<SurfaceParameter>
  hemisphere_parameters()
  {
    return {
      {"Radius",
       "1",
       "Radius of the hemisphere z >= 0 about the origin; the normal points "
       "outward. Units: length"},
      {"Hole angle",
       "0",
       "Angle between the z axis and the rim of the hole at the pole, from 0 "
       "(no hole) to less than 90. With a hole: u is the azimuth, v runs from "
       "the equator to the hole; edges u=0, u=1, v=0 or equator, v=1 or hole. "
       "Without: patches as of the sphere's octant or hemisphere, Subdivisions "
       "takes one number; edges u=0, u=1, v=0 or equator. Units: degrees"},
      {"Azimuth range",
       "0, 360",
       "Begin and end of the azimuth, 0 at the x axis; 0, 90 for a quarter "
       "(edges u=0 or y=0, u=1 or x=0). Without a hole only 0, 90 and 0, 360 "
       "are possible. Units: degrees"}};
  }
} // namespace Nacre
