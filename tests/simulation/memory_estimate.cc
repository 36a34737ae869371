// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The closed formula of a matrix' entries against a matrix, and what is said
// where memory is short.

#include "../tests_common.h"
#include <nacre/base/mpi_errors.h>
#include <nacre/simulation/memory_estimate.h>

using namespace Tests;

namespace
{
  /** n x n cells: fewer entries at the boundary, a share of about 1/n. */
  void
  test_entries(const unsigned int degree)
  {
    const unsigned int n = 24;
    const Parameters   parameters(section_text(1., 0., 0.1));
    Mesh               mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        mesh.vertices.emplace_back(i, j, 0.);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int v = j * (n + 1) + i;
          mesh.cells.push_back({{v, v + 1, v + n + 1, v + n + 2}});
        }
    const auto     discretization = make_discretization(mesh, degree);
    const Assembly assembly(*discretization,
                            ShellParts(parameters.section,
                                       parameters.conditions,
                                       parameters.loads,
                                       MembraneStrain::tied,
                                       {}));
    TrilinosWrappers::SparseMatrix matrix;
    assembly.reinit_matrix(discretization->node_constraints(), matrix);
    const double entries = 1. * matrix.n_nonzero_elements() / matrix.m();
    const double share   = 1. - entries / entries_per_row(degree);
    check_above("p = " + std::to_string(degree) +
                  ": entries below a large mesh'",
                share,
                0.);
    check_below("p = " + std::to_string(degree) + ": by no more than 3/n",
                share,
                3. / n);
  }

  void
  test_messages()
  {
    const auto estimate =
      estimate_memory(1000000, 27000, 3, 4, SolverStorage::factors);
    check_below("room enough, no warning",
                check_memory(estimate, SolverStorage::factors, 1000.).size(),
                0.5);
    const std::string warning =
      check_memory(estimate, SolverStorage::factors, 0.8 * estimate.total());
    check_below("tight: a warning with the parts",
                warning.find("factors") != std::string::npos &&
                    warning.find("are free") != std::string::npos ?
                  0. :
                  1.,
                0.5);
    std::string error;
    try
      {
        check_memory(estimate, SolverStorage::factors, 0.5 * estimate.total());
      }
    catch (const std::exception &exception)
      {
        error = error_text(exception);
      }
    check_below("far too much: an error with a remedy",
                error.find("fewer refinements") != std::string::npos ? 0. : 1.,
                0.5);
    const auto levels =
      estimate_memory(1000000, 27000, 3, 4, SolverStorage::multigrid);
    check_below("a million dofs: levels take less than factors",
                levels.solver / estimate.solver,
                0.5);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {2, 3, 4})
    test_entries(degree);
  test_messages();
  return n_failures == 0 ? 0 : 1;
}
