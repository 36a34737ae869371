// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/text.h>
#include <nacre/problem/surfaces.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    constexpr double degree = numbers::PI / 180.;

    const char *const angle_documentation =
      "Begin and end of the angle u, at most 360 apart; with 360 the surface "
      "is closed and has no edges u=0 and u=1. Units: degrees";

    bool
    is_full_circle(const SurfaceInput::Range &degrees)
    {
      return std::abs(degrees[1] - degrees[0] - 360.) < 1e-9;
    }

    /** x = (u, v, 0), 0 <= u <= a, 0 <= v <= b; normal +z. */
    SurfaceDescription
    make_plate(const SurfaceInput &input)
    {
      const auto [a, b] = input.positive_pair("Size");
      ChartRectangle rectangle;
      rectangle.u       = input.mesh_lines(0, {{0., a}});
      rectangle.v       = input.mesh_lines(1, {{0., b}});
      rectangle.aliases = {{{"left"}, {"right"}, {"bottom"}, {"top"}}};
      return make_rectangle(rectangle, make_chart_map([](const Point<3> &c) {
                              return Point<3>(c[0], c[1], 0.);
                            }));
    }

    std::vector<SurfaceParameter>
    plate_parameters()
    {
      return {
        {"Size",
         "1, 1",
         "Lengths a, b of the plate [0,a] x [0,b] in the plane z = 0, normal "
         "+z. Edges: u=0 or left, u=1 or right, v=0 or bottom, v=1 or top. "
         "Units: length"}};
    }

    /** The axis of a cylinder. */
    enum class Axis
    {
      x,
      y,
      z
    };

    const Selection<Axis> &
    selection(Axis)
    {
      static const Selection<Axis> table = {{Axis::x, "x"},
                                            {Axis::y, "y"},
                                            {Axis::z, "z"}};
      return table;
    }

    /** Directions in which a surface of an expression is closed. */
    enum class Closed
    {
      none,
      u,
      v,
      u_and_v
    };

    const Selection<Closed> &
    selection(Closed)
    {
      static const Selection<Closed> table = {{Closed::none, "none"},
                                              {Closed::u, "u"},
                                              {Closed::v, "v"},
                                              {Closed::u_and_v, "u and v"}};
      return table;
    }

    /**
     * u: angle (degrees), v: axial coordinate; about the axis
     *   z: (R cos u, R sin u, v)   y: (R sin u, v, R cos u)
     *   x: (v, R sin u, R cos u);  normal outward.
     */
    SurfaceDescription
    make_cylinder(const SurfaceInput &input)
    {
      const double              radius = input.positive("Radius");
      const SurfaceInput::Range angles = input.angle_range("Angle range");
      const auto                axis   = input.choice<Axis>("Axis");
      const bool                closed = is_full_circle(angles);

      ChartRectangle rectangle;
      rectangle.u      = input.mesh_lines(0, angles, closed);
      rectangle.v      = input.mesh_lines(1, input.range("Axial range"));
      rectangle.closed = {{closed, false}};
      rectangle.flip   = (axis == Axis::x);
      return make_rectangle(rectangle,
                            make_chart_map([radius, axis](const Point<3> &c) {
                              const double cosine =
                                radius * std::cos(c[0] * degree);
                              const double sine =
                                radius * std::sin(c[0] * degree);
                              return axis == Axis::z ?
                                       Point<3>(cosine, sine, c[1]) :
                                     axis == Axis::y ?
                                       Point<3>(sine, c[1], cosine) :
                                       Point<3>(c[1], sine, cosine);
                            }));
    }

    std::vector<SurfaceParameter>
    cylinder_parameters()
    {
      return {
        {"Radius", "1", "Radius R of the cylinder. Units: length"},
        {"Angle range", "0, 360", angle_documentation},
        {"Axial range",
         "0, 1",
         "Begin and end of the axial coordinate v. Units: length"},
        {"Axis",
         "z",
         "The axis: z: (R cos u, R sin u, v) | y: (R sin u, v, R cos u) | "
         "x: (v, R sin u, R cos u). The normal points outward. Units: none"}};
    }

    /**
     * u: angle (degrees), v = z; r = a sqrt(1 + z^2/c^2),
     * x = (r cos u, r sin u, v); normal outward.
     */
    SurfaceDescription
    make_hyperboloid(const SurfaceInput &input)
    {
      const double              throat = input.positive("Throat radius");
      const double              slope  = input.positive("Slope parameter");
      const SurfaceInput::Range angles = input.angle_range("Angle range");
      const bool                closed = is_full_circle(angles);

      ChartRectangle rectangle;
      rectangle.u      = input.mesh_lines(0, angles, closed);
      rectangle.v      = input.mesh_lines(1, input.range("Axial range"));
      rectangle.closed = {{closed, false}};
      return make_rectangle(rectangle,
                            make_chart_map([throat, slope](const Point<3> &c) {
                              const double r =
                                throat * std::hypot(1., c[1] / slope);
                              return Point<3>(r * std::cos(c[0] * degree),
                                              r * std::sin(c[0] * degree),
                                              c[1]);
                            }));
    }

    std::vector<SurfaceParameter>
    hyperboloid_parameters()
    {
      return {{"Throat radius",
               "1",
               "Radius a at z = 0 of x^2 + y^2 = a^2 (1 + z^2/c^2); the normal "
               "points outward. Units: length"},
              {"Slope parameter",
               "1",
               "The length c of the equation. Units: length"},
              {"Axial range", "-1, 1", "Begin and end of v = z. Units: length"},
              {"Angle range", "0, 360", angle_documentation}};
    }

    /** x = (u, v, C (u^2 - v^2)); normal upward. */
    SurfaceDescription
    make_hyperbolic_paraboloid(const SurfaceInput &input)
    {
      const double   coefficient = input.number("Coefficient");
      ChartRectangle rectangle;
      rectangle.u = input.mesh_lines(0, input.range("Range x"));
      rectangle.v = input.mesh_lines(1, input.range("Range y"));
      return make_rectangle(rectangle,
                            make_chart_map([coefficient](const Point<3> &c) {
                              return Point<3>(c[0],
                                              c[1],
                                              coefficient * (c[0] - c[1]) *
                                                (c[0] + c[1]));
                            }));
    }

    std::vector<SurfaceParameter>
    hyperbolic_paraboloid_parameters()
    {
      return {
        {"Coefficient",
         "1",
         "C of z = C (x^2 - y^2); the normal points upward. Units: 1/length"},
        {"Range x", "-1/2, 1/2", "Begin and end of u = x. Units: length"},
        {"Range y", "-1/2, 1/2", "Begin and end of v = y. Units: length"}};
    }

    /**
     * u: angle about the z axis, v: angle about the tube (degrees), from the
     * outermost circle upward;
     *   x = ((R + r cos v) cos u, (R + r cos v) sin u, r sin v);
     * normal outward.
     */
    SurfaceDescription
    make_torus(const SurfaceInput &input)
    {
      const double major = input.positive("Major radius");
      const double minor = input.positive("Minor radius");
      AssertThrow(minor < major,
                  ExcMessage(input.where("Minor radius") +
                             ": it must be less than the major radius, or "
                             "the torus meets itself."));
      const SurfaceInput::Range angles_u =
        input.angle_range("Major angle range");
      const SurfaceInput::Range angles_v =
        input.angle_range("Minor angle range");

      ChartRectangle rectangle;
      rectangle.closed = {{is_full_circle(angles_u), is_full_circle(angles_v)}};
      rectangle.u      = input.mesh_lines(0, angles_u, rectangle.closed[0]);
      rectangle.v      = input.mesh_lines(1, angles_v, rectangle.closed[1]);
      return make_rectangle(rectangle,
                            make_chart_map([major, minor](const Point<3> &c) {
                              const double r =
                                major + minor * std::cos(c[1] * degree);
                              return Point<3>(r * std::cos(c[0] * degree),
                                              r * std::sin(c[0] * degree),
                                              minor * std::sin(c[1] * degree));
                            }));
    }

    std::vector<SurfaceParameter>
    torus_parameters()
    {
      return {
        {"Major radius",
         "2",
         "Radius of the circle that the tube follows around the z axis. Units: "
         "length"},
        {"Minor radius",
         "1",
         "Radius of the tube; the normal points outward. Units: length"},
        {"Major angle range", "0, 360", angle_documentation},
        {"Minor angle range",
         "0, 360",
         "Begin and end of the angle v about the tube, 0 at the outermost "
         "circle, 90 at the top; closed with 360. Units: degrees"}};
    }

    /**
     * u: length along the strip (legs a and b), v = y across; fold angle f,
     *   u <= a: x = (u, v, 0)
     *   u >= a: x = (a + (u - a) cos f, v, (u - a) sin f);
     * the crease u = a is a line of the mesh. Normal upward on the first leg.
     */
    SurfaceDescription
    make_folded_strip(const SurfaceInput &input)
    {
      const auto [a, b]  = input.positive_pair("Leg lengths");
      const double width = input.positive("Width");
      const double fold  = input.number("Fold angle");
      AssertThrow(std::abs(fold) < 180.,
                  ExcMessage(input.where("Fold angle") + ": found " +
                             input.text("Fold angle") +
                             "; it must be between -180 and 180 degrees."));

      ChartRectangle            rectangle;
      const std::vector<double> second = input.mesh_lines(0, {{a, a + b}});
      rectangle.u                      = input.mesh_lines(0, {{0., a}});
      rectangle.u.insert(rectangle.u.end(), second.begin() + 1, second.end());
      rectangle.v       = input.mesh_lines(1, {{0., width}});
      rectangle.aliases = {{{"start"}, {"end"}, {}, {}}};

      const double cosine = std::cos(fold * degree);
      const double sine   = std::sin(fold * degree);
      return make_rectangle(
        rectangle,
        make_chart_map([crease = a, cosine, sine](const Point<3> &c) {
          const double beyond = std::max(c[0] - crease, 0.);
          return Point<3>(c[0] - beyond + beyond * cosine, c[1], beyond * sine);
        }));
    }

    std::vector<SurfaceParameter>
    folded_strip_parameters()
    {
      return {
        {"Leg lengths",
         "1, 1",
         "Lengths of the two legs; the first lies on the x axis from the "
         "origin. Edges: u=0 or start, u=1 or end, v=0, v=1. Subdivisions are "
         "cells along each leg and across. Units: length"},
        {"Width", "1", "Width of the strip along y from 0. Units: length"},
        {"Fold angle",
         "90",
         "Angle by which the second leg turns upward at the crease; 0: flat. "
         "Units: degrees"}};
    }

    /** x = (f(u, v), g(u, v), h(u, v)) with the user's f, g, h. */
    SurfaceDescription
    make_expression(const SurfaceInput &input)
    {
      const std::string              where = input.where("Position");
      const std::vector<std::string> parts =
        Text::split(input.text("Position"), ',', where);
      AssertThrow(parts.size() == 3,
                  ExcMessage(where +
                             ": three expressions of u and v, "
                             "separated by commas, are needed; "
                             "found '" +
                             input.text("Position") + "'."));
      std::array<Expression, 3> components;
      for (unsigned int c = 0; c < 3; ++c)
        components[c] = Expression(parts[c], where, input.constants(), "u,v");

      const auto     closed = input.choice<Closed>("Closed");
      ChartRectangle rectangle;
      rectangle.closed = {{closed == Closed::u || closed == Closed::u_and_v,
                           closed == Closed::v || closed == Closed::u_and_v}};
      rectangle.u =
        input.mesh_lines(0, input.range("Range u"), rectangle.closed[0]);
      rectangle.v =
        input.mesh_lines(1, input.range("Range v"), rectangle.closed[1]);
      return make_rectangle(
        rectangle,
        make_chart_map([components = std::move(components)](const Point<3> &c) {
          return Point<3>(components[0](c), components[1](c), components[2](c));
        }));
    }

    std::vector<SurfaceParameter>
    expression_parameters()
    {
      return {
        {"Position",
         "u, v, 0",
         "x, y, z as expressions of u, v and the constants; the normal is "
         "x,u cross x,v. Units: length"},
        {"Range u", "0, 1", "Begin and end of u. Units: those of u"},
        {"Range v", "0, 1", "Begin and end of v. Units: those of v"},
        {"Closed",
         "none",
         "Where the surface closes: none | u | v | u and v; its begin and end "
         "in that direction must meet. Units: none"}};
    }
  } // namespace


  SurfaceDescription
  make_rectangle(const ChartRectangle           &rectangle,
                 std::unique_ptr<const ChartMap> map)
  {
    const auto        &u   = rectangle.u;
    const auto        &v   = rectangle.v;
    const unsigned int n_u = u.size() - (rectangle.closed[0] ? 1 : 0);
    const unsigned int n_v = v.size() - (rectangle.closed[1] ? 1 : 0);

    SurfaceDescription surface;
    surface.n_vertices          = n_u * n_v;
    surface.map                 = std::move(map);
    surface.has_parameter_lines = true;
    for (unsigned int j = 0; j + 1 < v.size(); ++j)
      for (unsigned int i = 0; i + 1 < u.size(); ++i)
        {
          SurfaceDescription::Cell cell;
          for (unsigned int k = 0; k < 4; ++k)
            {
              const unsigned int column = i + k % 2, row = j + k / 2;
              cell.vertices[k] = column % n_u + n_u * (row % n_v);
              cell.chart[k]    = Point<3>(u[column], v[row], 0.);
            }
          if (rectangle.flip)
            {
              std::swap(cell.vertices[1], cell.vertices[2]);
              std::swap(cell.chart[1], cell.chart[2]);
            }
          surface.cells.push_back(cell);
        }

    const std::array<std::string, 4> names{{"u=0", "u=1", "v=0", "v=1"}};
    const std::array<double, 4>      values{
      {u.front(), u.back(), v.front(), v.back()}};
    for (unsigned int e = 0; e < 4; ++e)
      if (!rectangle.closed[e / 2])
        surface.edges.push_back(
          {names[e],
           rectangle.aliases[e],
           [direction = e / 2, value = values[e]](const Point<3> &chart) {
             return chart[direction] == value;
           }});
    return surface;
  }


  const std::vector<SurfaceKind> &
  surface_kinds()
  {
    static const std::vector<SurfaceKind> kinds = {
      {"plate", plate_parameters(), make_plate},
      {"disk", disk_parameters(), make_disk},
      {"L-shaped plate", l_shaped_plate_parameters(), make_l_shaped_plate},
      {"cylinder", cylinder_parameters(), make_cylinder},
      {"sphere", sphere_parameters(), make_sphere},
      {"hemisphere", hemisphere_parameters(), make_hemisphere},
      {"hyperboloid", hyperboloid_parameters(), make_hyperboloid},
      {"hyperbolic paraboloid",
       hyperbolic_paraboloid_parameters(),
       make_hyperbolic_paraboloid},
      {"torus", torus_parameters(), make_torus},
      {"folded strip", folded_strip_parameters(), make_folded_strip},
      {"expression", expression_parameters(), make_expression},
      {"file", file_surface_parameters(), make_file_surface}};
    return kinds;
  }
} // namespace Nacre
