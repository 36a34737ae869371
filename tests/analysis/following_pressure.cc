// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A pressure that follows the surface: its derivative against differences, and
// its resultant on a closed surface.

#include "loaded_shell.h"

using namespace Tests;

const std::string text = R"(
subsection Mid-surface
  set Surface = sphere
  set Subdivisions = 2
  subsection sphere
    set Radius = 1
  end
end
subsection Loads
  set Pressure = 2 + x
  set Pressure follows = true
end
)";

TrilinosVector
residual(const LoadedShell &shell, const TrilinosVector &u)
{
  const Discretization &discretization = shell.discretization;
  TrilinosVector        ghosted(discretization.locally_owned_dofs(),
                         discretization.locally_relevant_dofs(),
                         MPI_COMM_WORLD);
  ghosted = u;
  TrilinosVector result(u);
  shell.assembly.residual(ghosted, result);
  return result;
}

void
test_derivative(const LoadedShell &shell)
{
  const Discretization &discretization = shell.discretization;
  const auto           &constraints    = discretization.node_constraints();
  TrilinosWrappers::SparseMatrix matrix;
  shell.assembly.reinit_matrix(constraints, matrix);
  const TrilinosVector u         = interpolate(discretization, some_field);
  const TrilinosVector direction = shell.direction();
  TrilinosVector       force(u), ghosted(discretization.locally_owned_dofs(),
                                   discretization.locally_relevant_dofs(),
                                   MPI_COMM_WORLD);
  ghosted = u;
  shell.assembly.assemble(ghosted, constraints, matrix, force);
  TrilinosVector derivative(u), trial(u);
  matrix.vmult(derivative, direction);
  const double h = 1e-3; // quadratic in u: central differences are exact
  trial.add(h, direction);
  TrilinosVector difference = residual(shell, trial);
  trial.add(-2. * h, direction);
  difference -= residual(shell, trial);
  difference /= 2. * h;
  difference -= derivative;
  check_below("derivative against differences",
              difference.linfty_norm() / derivative.linfty_norm(),
              1e-9);
}

/** The sum of the loads on the shell that a displacement deforms. */
Vector3
resultant(const LoadedShell &shell, const VectorField &displacement)
{
  const auto r =
    residual(shell, interpolate(shell.discretization, displacement));
  Vector3 sum;
  for (unsigned int c = 0; c < 3; ++c)
    sum[c] = -(r * interpolate(shell.discretization, [c](const Point<3> &) {
                 Vector3 e;
                 e[c] = 1.;
                 return e;
               }));
  return sum;
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const LoadedShell shell(text, KinematicsModel::linear, 0);
  test_derivative(shell);
  // A rigid motion brings no strain in; the load turns with the surface.
  const Vector3 sum =
    resultant(shell, [](const Point<3> &) { return Vector3(); });
  // int (2 + x) n dA = int grad(2 + x) dV = 4 pi/3 e_x, quadratic geometry
  check_below("resultant on a closed surface",
              std::abs(sum[0] - 4. * numbers::PI / 3.) + std::abs(sum[1]) +
                std::abs(sum[2]),
              2e-2);
  const Vector3 turned = resultant(shell, [](const Point<3> &x) {
    return Vector3({-x[1] - x[0], x[0] - x[1], 0.});
  });
  check_below("turned by 90 degrees", std::abs(turned[1] - sum[0]), 1e-9);
  return n_failures > 0;
}
