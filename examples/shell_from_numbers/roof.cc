// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Solve the roof of roof.h on finer and finer meshes.

#include "roof.h"

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/simulation/linear_analysis.h>

#include <deal.II/base/mpi.h>

#include <iomanip>
#include <iostream>

namespace Roof
{
  int
  run()
  {
    Log log(MPI_COMM_WORLD, true);
    for (unsigned int n_refinements = 1; n_refinements < 4; ++n_refinements)
      {
        const ShellProblem   problem{make_model(3), n_refinements};
        DiscreteShell        shell(MPI_COMM_WORLD, problem, nullptr, 1, log);
        const LinearSolution solution(shell, nullptr, 0., log);
        // The middle of the free edge moves most, downwards.
        auto u         = shell.owned_vector();
        u              = solution.solved().displacement;
        const double w = u.linfty_norm();
        log.results() << shell.discretization().dof_handler().n_dofs()
                      << " dofs: w = " << std::setprecision(6) << w
                      << ", converged: 0.300592" << std::endl;
      }
    return 0;
  }
} // namespace Roof


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return Nacre::run_guarded(MPI_COMM_WORLD, []() { return Roof::run(); });
}
