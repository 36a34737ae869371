// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A shell stated by numbers gives what its parameter file gives; loads and
// conditions take the time as an argument and keep nothing of it.

#include "../../examples/shell_from_numbers/roof.h"
#include "../tests_common.h"
#include <nacre/base/log.h>
#include <nacre/simulation/linear_analysis.h>

using namespace Tests;

const std::string roof_text =
  "subsection Mid-surface\n set Surface = cylinder\n"
  " set Subdivisions = 2, 2\n subsection cylinder\n  set Radius = 25\n"
  "  set Axis = y\n  set Angle range = 0, 40\n  set Axial range = 0, 25\n"
  " end\nend\n"
  "subsection Boundary conditions\n"
  " set Edges = u=0, v=1: symmetry; v=0: diaphragm\nend\n"
  "subsection Loads\n set Force per area = 0, 0, -90\nend\n" +
  section_text(4.32e8, 0., 0.25);

void
test_roof()
{
  Log       log(MPI_COMM_WORLD, true);
  TextModel text(roof_text);
  text.model.element.degree = 3;
  const ShellProblem   from_text{std::move(text.model), 1};
  const ShellProblem   from_numbers{Roof::make_model(3), 1};
  DiscreteShell        text_shell(MPI_COMM_WORLD, from_text, nullptr, 1, log);
  DiscreteShell        shell(MPI_COMM_WORLD, from_numbers, nullptr, 1, log);
  const LinearSolution text_solution(text_shell, nullptr, 0., log);
  const LinearSolution solution(shell, nullptr, 0., log);
  const auto          &expected = text_solution.solved().displacement;
  TrilinosVector       u(solution.solved().displacement);
  const double         w = u.linfty_norm();
  check_below("w of the free edge", std::abs(w / 0.30059246 - 1.), 2e-3);
  u -= expected;
  check_below("difference from the parameter file", u.linfty_norm() / w, 1e-9);
  check_below("U = 1/2 f . u",
              std::abs(2. * solution.solved().energies.total() /
                         text_solution.solved().energies.total() -
                       2.),
              1e-9);
}

/** A sheared plate whose loads and supports vary with time. */
void
test_times()
{
  TextModel   text("subsection Mid-surface\n set Surface = plate\n"
                   " set Subdivisions = 2\nend\n"
                   "subsection Boundary conditions\n"
                   " set Edges = u=0: x = 0.1*t, rotation = 0.2*t*y\nend\n"
                   "subsection Loads\n set Force per area = t, 2*t^2, x\n"
                   " set Edge moments = u=1: 3*t\nend\n" +
                 section_text(100., 0.3, 0.1));
  ShellModel &model = text.model;
  model.load_factor.emplace("1 + t^2", "test", Constants(), "x,y,z,t");
  const Instant instant = model.at(2.);
  check_below("factor at t = 2", std::abs(instant.factor - 5.), 1e-14);
  const Point<3> X(0.5, 0.25, 0.);
  const auto     f = model.loads.force_per_area(X, Vector3(), 0., instant);
  check_below("force per area", (f - Vector3({10., 40., 2.5})).norm(), 1e-12);

  const Discretization discretization(model.midsurface,
                                      MPI_COMM_WORLD,
                                      model.element,
                                      0,
                                      0);
  const Assembly       assembly(discretization, model);
  TrilinosVector at_start(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  TrilinosVector later(at_start), again(at_start), zero(at_start);
  assembly.residual(zero, assembly.actions({0., 1.}), at_start);
  assembly.residual(zero, assembly.actions(instant), later);
  assembly.residual(zero, assembly.actions({0., 1.}), again);
  later -= at_start;
  check_above("loads grow", later.linfty_norm(), 0.1);
  again -= at_start;
  check_below("and nothing remembers it", again.linfty_norm(), 1e-300);

  // x = 0.1 t times the factor on the edge u = 0
  const DisplacementConditions conditions(discretization,
                                          model.supports,
                                          instant);
  double                       largest = 0.;
  for (const auto &line : conditions.constraints().get_lines())
    largest = std::max(largest, line.inhomogeneity);
  check_below("prescribed displacement", std::abs(largest - 1.), 1e-14);
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_roof();
  test_times();
  return n_failures > 0;
}
