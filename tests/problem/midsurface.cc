// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Surfaces: areas against closed forms, normals, edges, exact positions on
// common lines and after refinement, messages of bad input.

#include <nacre/problem/midsurface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>

using namespace Nacre;
using numbers::PI;

namespace
{
  struct Case
  {
    std::string name;
    std::string prm;
    double      area;
    /** "edge = length" of every edge, in order. */
    std::vector<std::pair<std::string, double>> edges;
    /** The unit normal at a position; empty: not checked. */
    std::function<Tensor<1, 3>(const Point<3> &)> normal;
    unsigned int                                  n_refinements = 2;
  };

  Midsurface
  make_surface(const std::string &prm)
  {
    ParameterAcceptor::clear();
    MidsurfaceParameters parameters;
    ParameterAcceptor::declare_all_parameters();
    std::string text = "subsection Mid-surface\n";
    for (const char c : prm)
      text += (c == ';' ? '\n' : c);
    ParameterAcceptor::prm.parse_input_from_string(text + "\nend\n");
    ParameterAcceptor::parse_all_parameters();
    return parameters.make({{"R", 2.}});
  }

  unsigned int n_failures = 0;

  void
  report(const bool good, const std::string &text)
  {
    n_failures += good ? 0 : 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << (good ? "OK   " : "FAIL ") << text << std::endl;
  }

  /** Largest distance between the two sides' positions on interior faces. */
  double
  mismatch(const Midsurface                        &surface,
           const parallel::TriangulationBase<2, 3> &mesh,
           bool                                    &oriented)
  {
    double largest = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        oriented = oriented && cell->direction_flag();
        if (!cell->is_locally_owned())
          continue;
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f) && cell->neighbor(f)->is_active())
            {
              // The part of the neighbour's face: a half if it is coarser.
              const auto   neighbor = cell->neighbor(f);
              unsigned int g        = 0;
              double       begin = 0., size = 1.;
              if (cell->neighbor_is_coarser(f))
                {
                  const auto [face, half] =
                    cell->neighbor_of_coarser_neighbor(f);
                  g     = face;
                  size  = 0.5;
                  begin = 0.5 * half;
                }
              else
                g = cell->neighbor_of_neighbor(f);
              for (const double t : {0., 0.2, 0.5, 1.})
                {
                  Point<2> a, b;
                  a[f / 2] = f % 2, a[1 - f / 2] = t;
                  b[g / 2] = g % 2, b[1 - g / 2] = begin + size * t;
                  largest = std::max(largest,
                                     surface.position(cell, a).distance(
                                       surface.position(neighbor, b)));
                }
            }
      }
    return Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }

  void
  check(const Case &test)
  {
    const auto surface = make_surface(test.prm);
    const auto mesh =
      surface.create_triangulation(MPI_COMM_WORLD,
                                   ReferenceCells::Quadrilateral,
                                   test.n_refinements);

    const FE_Q<2, 3>    fe(6);
    MappingQCache<2, 3> mapping(6);
    mapping.initialize(*mesh,
                       [&](const Triangulation<2, 3>::cell_iterator &cell) {
                         std::vector<Point<3>> points;
                         for (const Point<2> &unit :
                              fe.get_unit_support_points())
                           points.push_back(surface.position(cell, unit));
                         return points;
                       });
    FEValues<2, 3>      values(mapping,
                          fe,
                          QGauss<2>(8),
                          update_JxW_values | update_jacobians |
                            update_quadrature_points);
    FEFaceValues<2, 3>  face_values(mapping,
                                   fe,
                                   QGauss<1>(8),
                                   update_JxW_values);
    double              area = 0., turned = 0.;
    std::vector<double> lengths(surface.edge_names().size(), 0.);
    unsigned int        n_unnamed = 0;
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              area += values.JxW(q);
              Tensor<1, 3> a[2];
              for (unsigned int c = 0; c < 3; ++c)
                for (unsigned int d = 0; d < 2; ++d)
                  a[d][c] = values.jacobian(q)[c][d];
              const Tensor<1, 3> n = cross_product_3d(a[0], a[1]);
              if (test.normal)
                turned = std::max(turned,
                                  (n / n.norm() -
                                   test.normal(values.quadrature_point(q)))
                                    .norm());
            }
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              {
                const auto id = cell->face(f)->boundary_id();
                if (id >= lengths.size())
                  {
                    ++n_unnamed;
                    continue;
                  }
                face_values.reinit(cell, f);
                for (unsigned int q = 0; q < 8; ++q)
                  lengths[id] += face_values.JxW(q);
              }
        }
    area      = Utilities::MPI::sum(area, MPI_COMM_WORLD);
    n_unnamed = Utilities::MPI::sum(n_unnamed, MPI_COMM_WORLD);
    turned    = Utilities::MPI::max(turned, MPI_COMM_WORLD);
    Utilities::MPI::sum(lengths, MPI_COMM_WORLD, lengths);

    bool   oriented = true;
    double gap      = mismatch(surface, *mesh, oriented);
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] > 0.3)
        cell->set_refine_flag();
    const auto n_cells = mesh->n_global_active_cells();
    mesh->execute_coarsening_and_refinement();
    gap        = std::max(gap, mismatch(surface, *mesh, oriented));
    bool edges = (n_unnamed == 0 && lengths.size() == test.edges.size());
    for (unsigned int e = 0; edges && e < lengths.size(); ++e)
      edges = surface.edge_ids(test.edges[e].first, "test") ==
                std::set<types::boundary_id>{e} &&
              std::abs(lengths[e] - test.edges[e].second) < 1e-7;

    std::ostringstream text;
    text << test.name << ", " << n_cells << " cells";
    const bool good = std::abs(area / test.area - 1.) < 1e-7 && edges &&
                      oriented && gap < 1e-14 && turned < 1e-5;
    if (!good)
      {
        text << ": area " << area / test.area - 1. << ", gap " << gap
             << ", normal " << turned << ", oriented " << oriented
             << ", unnamed " << n_unnamed << ", edges";
        for (unsigned int e = 0; e < lengths.size(); ++e)
          text << ' ' << surface.edge_names()[e] << ' ' << lengths[e];
      }
    report(good, text.str());
  }

  Tensor<1, 3>
  upward(const Point<3> &)
  {
    return Point<3>(0., 0., 1.);
  }

  Tensor<1, 3>
  outward(const Point<3> &x)
  {
    return x / x.norm();
  }

  /** Outward from a coordinate axis. */
  std::function<Tensor<1, 3>(const Point<3> &)>
  radial(const unsigned int axis)
  {
    return [axis](const Point<3> &x) {
      Tensor<1, 3> n = x;
      n[axis]        = 0.;
      return n / n.norm();
    };
  }

  void
  check_flat_and_cylinders()
  {
    check({"plate",
           "set Subdivisions = 2, 3; subsection plate; set Size = R, 1; end",
           2.,
           {{"left", 1.}, {"right", 1.}, {"v = 0", 2.}, {"top", 2.}},
           upward});
    check({"graded plate",
           "set Subdivisions = 3; set Grading u = s^2; set Grading v = s^3",
           1.,
           {{"u=0", 1.}, {"u=1", 1.}, {"v=0", 1.}, {"v=1", 1.}},
           upward});
    const std::string disk = "set Surface = disk; set Subdivisions = 3; "
                             "subsection disk; set Radius = R; set Part = ";
    check({"disk", disk + "whole; end", 4. * PI, {{"rim", 4. * PI}}, upward});
    check({"half disk",
           disk + "half; end",
           2. * PI,
           {{"rim", 2. * PI}, {"x=0", 4.}},
           upward});
    check({"quarter disk",
           disk + "quarter; end",
           PI,
           {{"rim", PI}, {"x=0", 2.}, {"y=0", 2.}},
           upward});
    const std::string cylinder = "set Surface = cylinder; subsection cylinder; "
                                 "set Radius = R; set Axial range = -1, 2; ";
    check({"cylinder",
           "set Subdivisions = 3, 1; " + cylinder + "end",
           12. * PI,
           {{"v=0", 4. * PI}, {"v=1", 4. * PI}},
           radial(2)});
    for (const std::string axis : {"x", "y", "z"})
      check({"roof about " + axis,
             "set Subdivisions = 1, 2; " + cylinder +
               "set Angle range = -10*R, 40; set Axis = " + axis + "; end",
             2. * PI,
             {{"u=0", 3.},
              {"u=1", 3.},
              {"v=0", 2. * PI / 3.},
              {"v=1", 2. * PI / 3.}},
             radial(axis[0] - 'x')});
  }

  void
  check_spheres()
  {
    const std::string sphere = "set Surface = sphere; set Subdivisions = 3; "
                               "subsection sphere; set Radius = R; set Part = ";
    check({"sphere", sphere + "whole; end", 16. * PI, {}, outward});
    check({"sphere's hemisphere",
           sphere + "hemisphere; end",
           8. * PI,
           {{"equator", 4. * PI}},
           outward});
    check({"octant",
           sphere + "octant; end",
           2. * PI,
           {{"x=0", PI}, {"y=0", PI}, {"equator", PI}},
           outward});
    check({"sphere of six cells",
           "set Surface = sphere; set Subdivisions = 1",
           4. * PI,
           {},
           outward});
    const std::string hemisphere = "set Surface = hemisphere; subsection "
                                   "hemisphere; set Radius = R; ";
    check(
      {"hemisphere", hemisphere + "end", 8. * PI, {{"v=0", 4. * PI}}, outward});
    check({"hemisphere with hole",
           hemisphere + "set Hole angle = 30; end",
           8. * PI * std::sqrt(0.75),
           {{"equator", 4. * PI}, {"hole", 2. * PI}},
           outward});
    check({"quarter hemisphere",
           hemisphere + "set Azimuth range = 0, 90; end",
           2. * PI,
           {{"y=0", PI}, {"x=0", PI}, {"equator", PI}},
           outward});
    check({"quarter hemisphere with hole",
           hemisphere + "set Hole angle = 30; set Azimuth range = 0, 90; end",
           2. * PI * std::sqrt(0.75),
           {{"y=0", 2. * PI / 3.},
            {"x=0", 2. * PI / 3.},
            {"equator", PI},
            {"v=1", PI / 2.}},
           outward});
  }

  void
  check_other_surfaces()
  {
    // Throat radius and slope a: with s = sqrt(2) z/a, area = 2 pi a^2/sqrt(2)
    // [s sqrt(1 + s^2)/2 + asinh(s)/2] between the ends.
    const double s = std::sqrt(2.);
    check({"hyperboloid",
           "set Surface = hyperboloid",
           2. * PI / s * (s * std::sqrt(1. + s * s) + std::asinh(s)),
           {{"v=0", 2. * PI * s}, {"v=1", 2. * PI * s}},
           [](const Point<3> &x) {
             const Point<3> n(x[0], x[1], -x[2]);
             return n / n.norm();
           }});
    // int sqrt(1 + 4 x^2 + 4 y^2) over the square
    double          area = 0., length = 0.;
    const QGauss<2> rule(40);
    for (unsigned int q = 0; q < rule.size(); ++q)
      area +=
        rule.weight(q) *
        std::sqrt(1. + 4. * (rule.point(q) - Point<2>(.5, .5)).norm_square());
    length = std::sqrt(2.) / 2. + std::asinh(1.) / 2.;
    check({"hyperbolic paraboloid",
           "set Surface = hyperbolic paraboloid",
           area,
           {{"u=0", length}, {"u=1", length}, {"v=0", length}, {"v=1", length}},
           [](const Point<3> &x) {
             const Point<3> n(-2. * x[0], 2. * x[1], 1.);
             return n / n.norm();
           }});
    const auto torus_normal = [](const Point<3> &x) {
      const double   r = std::hypot(x[0], x[1]);
      const Point<3> n(x[0] - 2. * x[0] / r, x[1] - 2. * x[1] / r, x[2]);
      return n / n.norm();
    };
    check({"torus",
           "set Surface = torus; set Subdivisions = 3, 3",
           8. * PI * PI,
           {},
           torus_normal,
           3});
    check({"half torus",
           "set Surface = torus; subsection torus; set Major angle range = 0, "
           "180; end",
           4. * PI * PI,
           {{"u=0", 2. * PI}, {"u=1", 2. * PI}},
           torus_normal,
           3});
    check({"folded strip",
           "set Surface = folded strip; set Subdivisions = 3, 1; subsection "
           "folded strip; set Leg lengths = 1, 2; end",
           3.,
           {{"start", 1.}, {"end", 1.}, {"v=0", 3.}, {"v=1", 3.}},
           [](const Point<3> &x) {
             return x[2] > 0. ? Point<3>(-1., 0., 0.) : Point<3>(0., 0., 1.);
           }});
    const std::string expression = "set Surface = expression; subsection "
                                   "expression; set Position = ";
    check({"cone by expression",
           expression +
             "(1 + v)*cos(u), (1 + v)*sin(u), R*(1 + v); set Range u "
             "= 0, 2*pi; set Closed = u; end",
           3. * PI * std::sqrt(5.),
           {{"v=0", 2. * PI}, {"v=1", 4. * PI}},
           {}});
    check({"torus by expression",
           expression + "(2 + cos(v))*cos(u), (2 + cos(v))*sin(u), sin(v); set "
                        "Range u = 0, 2*pi; set Range v = 0, 2*pi; set Closed "
                        "= u and v; end",
           8. * PI * PI,
           {},
           torus_normal,
           3});
  }

  void
  check_message(const std::string &prm, const std::string &expected)
  {
    std::string found = "no error";
    try
      {
        make_surface(prm).edge_ids("u=0", "Edges");
      }
    catch (const std::exception &error)
      {
        // deal.II breaks long messages into lines.
        std::istringstream words(error.what());
        found.clear();
        for (std::string word; words >> word;)
          found += (found.empty() ? "" : " ") + word;
      }
    const bool good = found.find(expected) != std::string::npos;
    report(good, "message " + expected + (good ? "" : ": " + found));
  }

  void
  check_messages()
  {
    const auto in = [](const std::string &surface, const std::string &text) {
      return "set Surface = " + surface + "; subsection " + surface + "; " +
             text + "; end";
    };
    check_message("set Surface = cylindre", "unknown surface 'cylindre'");
    check_message("set Subdivisions = 0", "found 0; numbers of cells");
    check_message("set Subdivisions = 2.5", "found 2.5; numbers of cells");
    check_message("set Subdivisions = 1, 2, 3", "one or two numbers");
    check_message("set Subdivisions = 2; set Surface = torus",
                  "closed in that direction and needs at least 3");
    check_message("set Subdivisions = 2, 3; set Surface = disk",
                  "takes one number");
    check_message("set Grading u = s^2; set Surface = sphere",
                  "can't be graded");
    check_message("set Grading u = s/2", "runs from 0 at s = 0 to 0.5");
    check_message("set Grading v = s*(3*s - 2)",
                  "Grading v: 's*(3*s - 2)' doesn't grow");
    check_message(in("plate", "set Size = 1"), "plate/Size: two numbers");
    check_message(in("plate", "set Size = 1, -R"), "found -2; both");
    check_message(in("cylinder", "set Radius = 0"),
                  "Mid-surface/cylinder/Radius: found 0; it must be greater");
    check_message(in("cylinder", "set Axial range = 1, 1"),
                  "from 1 to 1 is empty or reversed");
    check_message(in("cylinder", "set Angle range = 0, 361"),
                  "from 0 to 361 degrees overlaps itself");
    check_message(in("cylinder", "set Axis = w"), "unknown choice 'w'");
    check_message("set Surface = cylinder", "unknown edge 'u=0'");
    check_message("set Surface = sphere", "is closed and has no edges");
    check_message(in("hemisphere", "set Hole angle = 90"), "found 90; it must");
    check_message(in("hemisphere", "set Azimuth range = 0, 180"),
                  "without a hole it must be 0, 90 or 0, 360");
    check_message(in("torus", "set Minor radius = 3"),
                  "less than the major radius");
    check_message(in("folded strip", "set Fold angle = 180"),
                  "between -180 and 180");
    check_message(in("expression", "set Position = u, v"),
                  "three expressions of u and v");
    check_message(in("expression", "set Position = u*v, u, 0"),
                  "degenerate at (u, v) = (0, 0)");
    check_message(in("expression", "set Position = u, u, 0"),
                  "surface is degenerate");
    check_message(in("expression", "set Position = 0, 0, 0"),
                  "surface is degenerate");
    check_message(in("expression",
                     "set Position = cos(v)*cos(u), cos(v)*sin(u), sin(v); set "
                     "Range v = 0, pi/2"),
                  "surface is degenerate");
    check_message(in("expression", "set Position = u, v, 1/u"),
                  "expression/Position");
    check_message(
      in(
        "expression",
        "set Position = cos(u), sin(u), v; set Range u = 0, 6; set Closed = u"),
      "the closed surface doesn't meet itself: at (u, v) = (6, 0)");
    check_message(in("expression", "set Closed = all"), "unknown choice 'all'");
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_flat_and_cylinders();
  check_spheres();
  check_other_surfaces();
  check_messages();
  return n_failures == 0 ? 0 : 1;
}
