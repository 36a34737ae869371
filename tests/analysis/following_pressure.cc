// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A pressure that follows the surface: its derivative against differences, and
// its resultant on a closed surface.

#include "../tests_common.h"
#include <nacre/problem/midsurface.h>

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

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  TextModel                              parameters(text);
  ShellModel                            &model = parameters.model;
  model.kinematics.tangent                     = TangentType::consistent;
  model.eta                                    = 5.;

  const Discretization           discretization(model.midsurface,
                                      MPI_COMM_WORLD,
                                      Element{ElementType::lagrange, 2},
                                      0,
                                      0);
  const Assembly                 shell(discretization, model);
  TrilinosWrappers::SparseMatrix matrix;
  shell.reinit_matrix(discretization.node_constraints(), matrix);

  const auto ghosted = [&](const TrilinosVector &owned) {
    TrilinosVector result(discretization.locally_owned_dofs(),
                          discretization.locally_relevant_dofs(),
                          MPI_COMM_WORLD);
    result = owned;
    return result;
  };
  const TrilinosVector u = interpolate(discretization, some_field);
  TrilinosVector       direction(u), force(u);
  for (const auto i : discretization.locally_owned_dofs())
    direction(i) = std::sin(1. + 3. * i);
  direction.compress(VectorOperation::insert);

  shell.assemble(ghosted(u), discretization.node_constraints(), matrix, force);
  TrilinosVector derivative(u), plus(u), minus(u), trial(u);
  matrix.vmult(derivative, direction);
  const double h = 1e-3; // quadratic in u: central differences are exact
  trial.add(h, direction);
  shell.residual(ghosted(trial), plus);
  trial.add(-2. * h, direction);
  shell.residual(ghosted(trial), minus);
  plus -= minus;
  plus /= 2. * h;
  plus -= derivative;
  check_below("derivative against differences",
              plus.linfty_norm() / derivative.linfty_norm(),
              1e-9);

  // A rigid motion brings no strain in; the load turns with the surface.
  TrilinosVector zero(u), undeformed(u);
  zero = 0.;
  shell.residual(ghosted(zero), undeformed);
  Vector3    sum;
  const auto rotated = interpolate(discretization, [](const Point<3> &x) {
    return Vector3(Point<3>(-x[1] - x[0], x[0] - x[1], 0.));
  });
  for (unsigned int c = 0; c < 3; ++c)
    {
      const auto unit = interpolate(discretization, [c](const Point<3> &) {
        Vector3 e;
        e[c] = 1.;
        return e;
      });
      sum[c]          = -(undeformed * unit);
    }
  // int (2 + x) n dA = int grad(2 + x) dV = 4 pi/3 e_x, quadratic geometry
  check_below("resultant on a closed surface",
              std::abs(sum[0] - 4. * numbers::PI / 3.) + std::abs(sum[1]) +
                std::abs(sum[2]),
              2e-2);
  TrilinosVector turned(u);
  shell.residual(ghosted(rotated), turned);
  double     y      = 0.;
  const auto unit_y = interpolate(discretization, [](const Point<3> &) {
    Vector3 e;
    e[1] = 1.;
    return e;
  });
  y                 = -(turned * unit_y);
  check_below("turned by 90 degrees", std::abs(y - sum[0]), 1e-9);
  return n_failures == 0 ? 0 : 1;
}
