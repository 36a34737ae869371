// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The work of all forces on a virtual displacement of an edge, a reaction: its
// gradient and its rate against differences, with loads that change in time.

#include "loaded_shell.h"
#include <nacre/analysis/shell_system.h>
#include <nacre/solvers/direct_solver.h>

using namespace Tests;

const std::string text = R"(
subsection Mid-surface
  set Surface      = cylinder
  set Subdivisions = 2, 2
  subsection cylinder
    set Angle range = 0, 90
  end
end
subsection Section
  set Young's modulus = 100
  set Poisson's ratio = 0.3
  set Thickness       = 0.1
end
subsection Boundary conditions
  set Edges = u=0: clamped; u=1: z = t
end
subsection Loads
  set Pressure    = t*(1 + x)
  set Edge forces = u=1: t^2, 0, 3*t
end
)";

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  LoadedShell           shell(text, KinematicsModel::finite, 1);
  const Discretization &discretization = shell.discretization;
  DirectSolver          solver(MPI_COMM_WORLD);
  ShellSystem system(discretization, shell.assembly, shell.model, solver);

  TrilinosVector v = interpolate(discretization, [](const Point<3> &x) {
    return Vector3({0., 0., x[1] > 0.9 ? 1. : 0.});
  });
  TrilinosVector u = interpolate(discretization, some_field);
  u *= 0.1;
  const TrilinosVector direction = shell.direction();
  const double         time = 0.7, dt = 1e-3;
  const auto           work  = system.virtual_work(u, v, time, dt);
  const auto           moved = [&](const double step) {
    TrilinosVector at(u);
    at.add(step, direction);
    return system.virtual_work(at, v, time, dt).value;
  };
  // Central differences of two steps, extrapolated
  const double s = 1e-4;
  const double slope =
    (8. * (moved(s) - moved(-s)) - (moved(2. * s) - moved(-2. * s))) /
    (12. * s);
  check_below("gradient",
              std::abs(slope / (work.gradient * direction) - 1.),
              1e-8);
  // Quadratic in time: central differences are exact.
  const double later   = system.virtual_work(u, v, time + 0.2, dt).value;
  const double earlier = system.virtual_work(u, v, time - 0.2, dt).value;
  check_below("rate", std::abs((later - earlier) / 0.4 / work.rate - 1.), 1e-8);
  check_above("its size", std::abs(work.rate), 1e-2);
  return n_failures > 0;
}
