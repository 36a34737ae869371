// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Deformations that can't be a step: a cell without area, a cell turned over,
// a fold that jumps beyond 180 degrees; and great ones that can.

#include "../tests_common.h"
#include <nacre/analysis/deformation_check.h>

using namespace Tests;

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  // Two cells side by side in the plane; the edge between them is x = 1.
  Mesh mesh;
  mesh.vertices             = {{0., 0., 0.},
                               {1., 0., 0.},
                               {2., 0., 0.},
                               {0., 1., 0.},
                               {1., 1., 0.},
                               {2., 1., 0.}};
  mesh.cells                = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
  const auto discretization = make_discretization(mesh, 2);

  using Map         = std::function<Point<3>(const Point<3> &)>;
  const auto deform = [&](const Map &map) {
    const auto     owned = interpolate(*discretization, [&](const Point<3> &x) {
      return Vector3(map(x) - x);
    });
    TrilinosVector ghosted(discretization->locally_owned_dofs(),
                           discretization->locally_relevant_dofs(),
                           MPI_COMM_WORLD);
    ghosted = owned;
    return ghosted;
  };
  const auto found = [&](const Map &before, const Map &after) {
    return find_impossible_deformation(*discretization,
                                       deform(before),
                                       deform(after));
  };
  /** The second cell folded up by an angle (degrees) about x = 1. */
  const auto fold = [](const double degrees) -> Map {
    const double angle = degrees * numbers::PI / 180.;
    return [angle](const Point<3> &x) {
      const double r = std::max(0., x[0] - 1.);
      return Point<3>(std::min(x[0], 1.) + r * std::cos(angle),
                      x[1],
                      r * std::sin(angle));
    };
  };
  const auto expect = [&](const std::string &name,
                          const std::string &text,
                          const char        *word) {
    const bool good =
      (*word == '\0' ? text.empty() : text.find(word) != std::string::npos);
    n_failures += (good ? 0 : 1);
    std::cout << name << ": " << (good ? "OK" : "FAILED: " + text) << std::endl;
  };

  const Map rest = [](const Point<3> &x) { return x; };
  expect("no change", found(rest, rest), "");
  expect("fold by 80 degrees", found(rest, fold(80.)), "");
  expect("on to 160 degrees", found(fold(80.), fold(160.)), "");
  expect("fold by 120 degrees in a step",
         found(rest, fold(120.)),
         "90 degrees");
  expect("fold through itself", found(fold(160.), fold(200.)), "180 degrees");
  expect("fold back", found(fold(-160.), fold(-90.)), "");
  expect("a cell without area",
         found(rest,
               [](const Point<3> &x) {
                 return Point<3>(x[0] > 1. ? 1. + 1e-5 * (x[0] - 1.) : x[0],
                                 x[1],
                                 x[2]);
               }),
         "of its area");
  expect("a cell turned over",
         found(rest,
               [](const Point<3> &x) { return Point<3>(-x[0], x[1], x[2]); }),
         "turned over");
  return n_failures == 0 ? 0 : 1;
}
