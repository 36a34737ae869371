// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Residual and tangent of large rotations cost at most 2.5 (co-rotational)
// and twice (finite) as much as the linear assembly of the same mesh.

#include "../tests_common.h"
#include <nacre/base/cpu_timer.h>

using namespace Tests;

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Parameters                 parameters(section_text(100., 0.3, 0.2));
  constexpr unsigned int           n_cells = 12;
  Mesh                             mesh;
  for (unsigned int j = 0; j <= n_cells; ++j)
    for (unsigned int i = 0; i <= n_cells; ++i)
      mesh.vertices.emplace_back(-1. + 2. * i / n_cells, 2. * j / n_cells, 0.);
  for (unsigned int j = 0; j < n_cells; ++j)
    for (unsigned int i = 0; i < n_cells; ++i)
      {
        const unsigned int v = j * (n_cells + 1) + i;
        mesh.cells.push_back({{v, v + 1, v + n_cells + 1, v + n_cells + 2}});
      }
  mesh.map = bend;

  for (const unsigned int degree : {2, 3, 4})
    {
      const auto discretization = make_discretization(mesh, degree);
      AffineConstraints<double> constraints;
      constraints.close();
      const auto            u = interpolate(*discretization, some_field);
      std::array<double, 3> seconds{{1e100, 1e100, 1e100}};
      std::array<std::unique_ptr<Assembly>, 3> operators;
      for (const auto model : {KinematicsModel::linear,
                               KinematicsModel::corotational,
                               KinematicsModel::finite})
        operators[static_cast<int>(model)] = std::make_unique<Assembly>(
          *discretization,
          ShellParts(parameters.section,
                     parameters.conditions,
                     parameters.loads,
                     KinematicsOptions(MembraneStrain::tied,
                                       EdgeForm::rotation_jump,
                                       model),
                     10.));
      TrilinosWrappers::SparseMatrix matrix;
      TrilinosVector                 force(discretization->locally_owned_dofs(),
                           MPI_COMM_WORLD);
      operators[0]->reinit_matrix(constraints, matrix);
      // By turns, the best of several: other programs disturb all.
      for (unsigned int k = 0; k < 8; ++k)
        for (unsigned int m = 0; m < 3; ++m)
          {
            // deal.II's Timer knows the steps of the scheduler only.
            CpuTimer timer(MPI_COMM_WORLD);
            operators[m]->assemble(u, constraints, matrix, force);
            seconds[m] = std::min(seconds[m], timer.lap());
          }
      if (std::getenv("NACRE_TEST_VALUES") != nullptr)
        std::cout << "microseconds a cell: "
                  << 1e6 * seconds[0] / (n_cells * n_cells) << ", "
                  << 1e6 * seconds[1] / (n_cells * n_cells) << ", "
                  << 1e6 * seconds[2] / (n_cells * n_cells) << std::endl;
      check_below("p = " + std::to_string(degree) +
                    ": co-rotational / linear assembly",
                  seconds[1] / seconds[0],
                  2.5);
      check_below("p = " + std::to_string(degree) +
                    ": finite / linear assembly",
                  seconds[2] / seconds[0],
                  2.);
    }
  return n_failures > 0;
}
