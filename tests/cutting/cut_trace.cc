// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Cuts of a parameter file, and how they run through the cells of meshes:
// lengths against closed forms, crossings that both cells of an edge have in
// common bit for bit, no ends but tips and those on the surface's boundary,
// tips, messages.

#include "traced_shell.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

using namespace Tests;
using numbers::PI;

namespace
{
  unsigned int n_failures = 0;

  void
  report(const bool good, const std::string &text)
  {
    n_failures += good ? 0 : 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << (good ? "OK   " : "FAIL ") << text << std::endl;
  }

  Cuts
  one_cut(const CutCurve::Coordinates coordinates,
          const Points               &points,
          const bool                  is_closed = false)
  {
    Cuts cuts;
    cuts.curves.push_back({"cut", coordinates, points, is_closed});
    return cuts;
  }

  constexpr auto uv  = CutCurve::Coordinates::chart;
  constexpr auto xyz = CutCurve::Coordinates::space;

  /** What is to be found. */
  struct Expected
  {
    double       length;
    double       tolerance;
    unsigned int n_tips;
    unsigned int n_loose_ends;
    int          n_chains = -1;
    int          n_opened = -1;
  };

  void
  check(const std::string &name,
        const Shell       &shell,
        const Cuts        &cuts,
        const Expected    &expected)
  {
    const CutTrace     trace(*shell.mesh, shell.maps, cuts);
    const Summary      found = summarise(shell, trace);
    const unsigned int n     = n_different_edges(shell, trace);
    const double       error = std::abs(found.length - expected.length);
    std::ostringstream text;
    text << name << ": " << found.n_chains << " chains, " << found.n_opened
         << " opened edges, " << trace.tips().size() << " tips, "
         << found.loose_ends.size() << " loose ends, " << n << " edges differ";
    bool good =
      n == 0 && error <= expected.tolerance &&
      trace.tips().size() == expected.n_tips &&
      found.loose_ends.size() == expected.n_loose_ends &&
      (expected.n_chains < 0 ||
       found.n_chains == unsigned(expected.n_chains)) &&
      (expected.n_opened < 0 || found.n_opened == unsigned(expected.n_opened));
    for (const auto &tip : trace.tips())
      good = good && std::abs(tip.direction.norm() - 1.) < 1e-12 &&
             std::any_of(found.loose_ends.begin(),
                         found.loose_ends.end(),
                         [&](const auto &x) {
                           return x.distance(tip.position) < 1e-9;
                         });
    if (!good || std::getenv("NACRE_TEST_VALUES") != nullptr)
      text << ", length " << found.length << ", error " << error;
    report(good, text.str());
  }

  const char *const plate = "set Subdivisions = 4, 3; subsection plate; "
                            "set Size = 4, 3; end";

  void
  check_plates()
  {
    const Shell  shell(plate, 0);
    const double round_off = 1e-13;
    check("oblique cut",
          shell,
          one_cut(uv, {{-1., 0.3, 0.}, {5., 2.9, 0.}}),
          {4. * std::hypot(1., 2.6 / 6.), round_off, 0, 2});
    check("through vertices but for round-off",
          shell,
          one_cut(uv, {{-1., -1. + 1e-12, 0.}, {5., 5. - 1e-12, 0.}}),
          {3. * std::sqrt(2.), 1e-11, 0, 2, 3, 0});
    check("snapped to vertices",
          shell,
          one_cut(uv, {{-1., -1.015, 0.}, {5., 4.985, 0.}}),
          {3. * std::sqrt(2.), round_off, 0, 2, 3, 0});
    check("along edges, to the middle of one",
          shell,
          one_cut(uv, {{2. + 1e-12, -0.1, 0.}, {2. - 1e-12, 1.5, 0.}}),
          {1.5, 1e-11, 1, 2, 0, 2});
    check("along edges with a turn",
          shell,
          one_cut(uv, {{1., 1., 0.}, {2., 1., 0.}, {2., 2., 0.}}),
          {2., round_off, 2, 2, 0, 2});
    check("along edges within one",
          shell,
          one_cut(uv, {{1., 1.2, 0.}, {1., 1.7, 0.}}),
          {0.5, round_off, 2, 2, 0, 1});
    check("near to edges",
          shell,
          one_cut(uv, {{0.5, 1.01, 0.}, {1.5, 0.995, 0.}, {3.5, 1.007, 0.}}),
          {3., 1e-2, 2, 2});
    check(
      "kinks and tips inside",
      shell,
      one_cut(uv,
              {{0.3, 0.4, 0.}, {0.6, 0.7, 0.}, {1.4, 0.5, 0.}, {1.5, 1.8, 0.}}),
      {std::hypot(0.3, 0.3) + std::hypot(0.8, 0.2) + std::hypot(0.1, 1.3),
       round_off,
       2,
       2,
       3,
       0});
    check("closed inside one cell",
          shell,
          one_cut(uv, {{0.3, 0.4, 0.}, {0.6, 0.4, 0.}, {0.6, 0.8, 0.}}, true),
          {1.2, round_off, 0, 0, 1, 0});
    Points circle;
    for (unsigned int i = 0; i < 64; ++i)
      circle.emplace_back(2.1 + 0.9 * std::cos(i * PI / 32.),
                          1.4 + 0.9 * std::sin(i * PI / 32.),
                          0.);
    check("circle",
          shell,
          one_cut(uv, circle, true),
          {128. * 0.9 * std::sin(PI / 64.), 1e-2, 0, 0});
    check("in space, out and in again",
          shell,
          one_cut(xyz, {{0.5, 0.6, 0.}, {2.5, -0.6, 0.}, {2.6, 1.4, 0.}}),
          {std::hypot(1., 0.6) + 1.4 * std::hypot(1., 0.05), round_off, 2, 4});

    Cuts crossing = one_cut(uv, {{0.2, 1.3, 0.}, {3.7, 1.4, 0.}});
    crossing.curves.push_back({"other", xyz, {{2.1, 0.2, 0.}, {1.9, 2.9, 0.}}});
    check("two that cross",
          shell,
          crossing,
          {std::hypot(3.5, 0.1) + std::hypot(0.2, 2.7), round_off, 4, 4});

    Cuts joined = one_cut(uv, {{0.2, 1.3, 0.}, {3.7, 1.3, 0.}});
    joined.curves.push_back({"stem", uv, {{2.1, 1.3, 0.}, {2.3, 2.4, 0.}}});
    joined.curves.push_back(
      {"hook",
       uv,
       {{1.2, 1.9, 0.}, {1.8, 1.9, 0.}, {1.5, 2.5, 0.}, {1.5, 1.9, 0.}}});
    joined.curves.push_back({"rail", uv, {{3., 1., 0.}, {3., 3.1, 0.}}});
    joined.curves.push_back({"spur", uv, {{3., 2.6, 0.}, {3.6, 2.6, 0.}}});
    check("ends on other cuts and on its own",
          shell,
          joined,
          {7.3 + std::hypot(0.2, 1.1) + std::hypot(0.3, 0.6), 1e-12, 6, 7});
  }

  void
  check_shells()
  {
    const Shell distorted("set Surface = expression; set Subdivisions = 5, 4; "
                          "subsection expression; set Position = u + "
                          "0.1*sin(3*v), v + 0.1*u*v, 0.2*u*u; end",
                          1);
    double      length = 0.;
    const auto  x      = [](const double s) {
      const double u = 0.15 + 0.7 * s, v = 0.1 + 0.75 * s;
      return Point<3>(u + 0.1 * std::sin(3. * v), v + 0.1 * u * v, 0.2 * u * u);
    };
    for (unsigned int i = 0; i < 10000; ++i)
      length += x(i / 10000.).distance(x((i + 1) / 10000.));
    check("distorted plate",
          distorted,
          one_cut(uv, {{0.15, 0.1, 0.}, {0.85, 0.85, 0.}}),
          {length, 1e-5, 2, 2});

    const std::string cylinder = "set Surface = cylinder; set Subdivisions = "
                                 "5, 3; subsection cylinder; set Radius = R; "
                                 "end";
    const Shell       closed(cylinder, 1);
    const double      degree = 2. * PI / 180.;
    check("over the seam",
          closed,
          one_cut(uv, {{340., 0.2, 0.}, {385., 0.45, 0.}}),
          {std::hypot(45. * degree, 0.25), 1e-3, 2, 2});
    check("helix, around twice",
          closed,
          one_cut(uv, {{-33., -0.1, 0.}, {700., 0.9, 0.}}),
          {0.9 * std::hypot(733. * degree, 1.), 1e-2, 1, 2});
    check("ring",
          closed,
          one_cut(uv, {{0., 0.4, 0.}, {360., 0.4, 0.}}),
          {4. * PI, 1e-2, 0, 0, 10, 0});
    check("ring along edges",
          closed,
          one_cut(uv, {{0., 0.5, 0.}, {360., 0.5, 0.}}),
          {4. * PI, 1e-2, 0, 0, 0, 10});
    check("along the axis, in space",
          closed,
          one_cut(xyz,
                  {{2. * std::cos(1.), 2. * std::sin(1.), -0.2},
                   {2. * std::cos(1.), 2. * std::sin(1.), 1.2}}),
          {1., 1e-12, 0, 2, 6, 0});
    check("on the seam, in space",
          closed,
          one_cut(xyz, {{2., 0., -0.2}, {2., 0., 1.2}}),
          {1., 1e-12, 0, 2, 0, 6});

    const Shell tube("set Surface = cylinder; set Subdivisions = 5, 3; "
                     "subsection cylinder; set Radius = 0.2; end",
                     0);
    check("along a tube, not on its far side",
          tube,
          one_cut(xyz, {{0.2, 0., -0.2}, {0.2, 0., 1.2}}),
          {1., 1e-12, 0, 2, 0, 3});

    const Shell triangles(plate, 1, ReferenceCells::Triangle);
    check("triangles",
          triangles,
          one_cut(uv, {{-1., 0.3, 0.}, {3.1, 2.6, 0.}}),
          {3.1 * std::hypot(1., 2.3 / 4.1), 1e-12, 1, 2});
    check("triangles, along their diagonals and across",
          triangles,
          one_cut(uv, {{-1., -1., 0.}, {5., 5., 0.}}),
          {3. * std::sqrt(2.), 1e-12, 0, 2});

    const auto great_circle = [](const double angle) {
      return Point<3>(2. * std::cos(angle),
                      2. * std::sin(angle) * 0.8,
                      2. * std::sin(angle) * 0.6);
    };
    Points arc;
    for (unsigned int i = 0; i <= 4; ++i)
      arc.push_back(great_circle(0.13 + 0.5 * i));
    const std::string sphere = "set Surface = sphere; set Subdivisions = 4; "
                               "subsection sphere; set Radius = R; end";
    for (const unsigned int n : {0, 1, 2})
      check("great circle, refined " + std::to_string(n) + " times",
            Shell(sphere, n),
            one_cut(xyz, arc),
            {4., 4e-3 * std::pow(0.25, n), 2, 2});
    const Shell folded("set Surface = folded strip; set Subdivisions = 3, 2",
                       0);
    check("over a crease, in space",
          folded,
          one_cut(xyz, {{0.4, 0.1, 0.}, {1., 0.3, 0.7}}),
          {std::hypot(0.6, 0.2 * 6. / 13.) + std::hypot(0.7, 0.2 * 7. / 13.),
           1e-12,
           2,
           2});
  }

  /** Points on vertices, edges and in cells, but for round-off. */
  void
  check_random_cuts()
  {
    std::mt19937                     random(1);
    std::uniform_real_distribution<> noise(-1e-12, 1e-12);
    unsigned int                     n_bad = 0, n_traced = 0;
    const Shell                      quadrilaterals(plate, 0);
    const Shell triangles(plate, 0, ReferenceCells::Triangle);
    for (unsigned int run = 0; run < 400; ++run)
      {
        Points points;
        while (points.size() < 2 + run % 3)
          {
            const Point<3> x(0.25 * int(random() % 19) - 0.25 + noise(random),
                             0.25 * int(random() % 15) - 0.25 + noise(random),
                             0.);
            if (points.empty() || points.back().distance(x) > 0.1)
              points.push_back(x);
          }
        const Shell &shell = run % 2 == 0 ? quadrilaterals : triangles;
        Cuts         cuts  = one_cut(uv, points);
        cuts.snap          = run % 4 < 2 ? 0.02 : 0.;
        try
          {
            const CutTrace trace(*shell.mesh, shell.maps, cuts);
            const Summary  found = summarise(shell, trace);
            bool           good  = n_different_edges(shell, trace) == 0;
            for (const auto &end : found.loose_ends)
              good =
                good && (end[0] < 1e-9 || end[0] > 4. - 1e-9 || end[1] < 1e-9 ||
                         end[1] > 3. - 1e-9 ||
                         std::any_of(trace.tips().begin(),
                                     trace.tips().end(),
                                     [&](const auto &tip) {
                                       return tip.position.distance(end) < 1e-9;
                                     }));
            ++n_traced;
            n_bad += good ? 0 : 1;
          }
        catch (const ExceptionBase &)
          {}
      }
    report(n_bad == 0 && n_traced > 350,
           "random cuts: " + std::to_string(n_bad) + " of " +
             std::to_string(n_traced) + " bad");
  }

  /** The curves of a text, as CutParameters reads them. */
  void
  check_parameters()
  {
    const Shell shell(plate, 0);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream("flap.dat") << "# u, v\n0 .5\n1, .5\n2;.6 # end\n\n\n"
                                   "0 0 0\n1 0 0\n1 1 0\n0 0 0\n";
    ParameterAcceptor::clear();
    CutParameters parameters;
    parameters.set_files(MPI_COMM_WORLD, ".");
    ParameterAcceptor::declare_all_parameters();
    ParameterAcceptor::prm.parse_input_from_string(
      "subsection Cuts\n set Cuts = slit: uv (2*a, -0.1) (2.3, 3.1); "
      "hole: uv closed expression 1 + cos(2*pi*s), a*sin(2*pi*s), 8 points; "
      "arc: xyz expression s, s^2, 0, 5 points; flap: file flap.dat; "
      "ring: xyz closed (0, 0, a), (0, 1, 1) (1, 0, 1)\n"
      "set Remove = (1, a, 0); (0, 0, 1)\n set Snap = 0.1\nend\n");
    ParameterAcceptor::parse_all_parameters();
    const Cuts         cuts = parameters.make({{"a", 0.5}}, *shell.surface);
    std::ostringstream text;
    for (const CutCurve &curve : cuts.curves)
      text << curve.name << ' ' << (curve.coordinates == uv ? "uv" : "xyz")
           << (curve.is_closed ? " closed " : " ") << curve.points.size()
           << ", ";
    report(text.str() == "slit uv 2, hole uv closed 8, arc xyz 5, flap-1 uv 3, "
                         "flap-2 xyz closed 3, ring xyz closed 3, ",
           "curves: " + text.str());
    const auto is_at =
      [&](const unsigned int curve, const unsigned int i, const Point<3> &x) {
        return cuts.curves[curve].points[i].distance(x) < 1e-14;
      };
    report(is_at(0, 0, {1., -0.1, 0.}) && is_at(1, 2, {1., 0.5, 0.}) &&
             is_at(2, 4, {1., 1., 0.}) && is_at(2, 1, {0.25, 0.0625, 0.}) &&
             is_at(3, 2, {2., 0.6, 0.}) && is_at(4, 2, {1., 1., 0.}) &&
             is_at(5, 0, {0., 0., 0.5}) && cuts.remove.size() == 2 &&
             cuts.remove[0] == Point<3>(1., 0.5, 0.) && cuts.snap == 0.1 &&
             cuts.smallest_part == 0.25,
           "their points");
  }

  void
  check_message(const std::string &name,
                const Shell       &shell,
                const Cuts        &cuts,
                const std::string &text)
  {
    std::string message;
    try
      {
        const CutTrace trace(*shell.mesh, shell.maps, cuts);
      }
    catch (const ExceptionBase &exception)
      {
        std::istringstream words(exception.what());
        for (std::string word; words >> word;)
          message += word + ' ';
      }
    const bool good = message.find(text) != std::string::npos;
    report(good, "message, " + name + (good ? "" : ": " + message));
  }

  void
  check_messages()
  {
    Shell shell(plate, 1);
    check_message("off the surface",
                  shell,
                  one_cut(xyz, {{1., 1., 0.}, {2., 1., 0.2}}),
                  "'cut': the point 2, (2, 1, 0.2), lies off the surface by "
                  "0.2;");
    check_message("outside",
                  shell,
                  one_cut(uv, {{1., 4., 0.}, {2., 4., 0.}}),
                  "no part of the cut lies inside");
    check_message("along the boundary",
                  shell,
                  one_cut(uv, {{1., 3., 0.}, {2., 3., 0.}}),
                  "no part of the cut lies inside");
    const Shell cylinder("set Surface = cylinder", 1);
    check_message("too long a chord",
                  cylinder,
                  one_cut(xyz, {{1., 0., 0.5}, {-0.5, std::sqrt(0.75), 0.5}}),
                  "normal turns by more than 90 degrees");
    const Shell disk("set Surface = disk", 1);
    check_message("no chart",
                  disk,
                  one_cut(uv, {{0., 0., 0.}, {1., 0., 0.}}),
                  "isn't described over a rectangle");
    for (const auto &cell : shell.mesh->active_cell_iterators())
      if (cell->is_locally_owned() &&
          cell->center().distance(Point<3>(1.25, 1.25, 0.)) < 0.1)
        cell->set_refine_flag();
    shell.mesh->execute_coarsening_and_refinement();
    check_message("hanging edges",
                  shell,
                  one_cut(uv, {{0.1, 1.3, 0.}, {3.9, 1.3, 0.}}),
                  "must be of one size; refine them alike");
    check("away from hanging edges",
          shell,
          one_cut(uv, {{0.1, 2.3, 0.}, {3.9, 2.3, 0.}}),
          {3.8, 1e-12, 2, 2});
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_parameters();
  check_plates();
  check_shells();
  check_random_cuts();
  check_messages();
  return n_failures == 0 ? 0 : 1;
}
