// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A strip under a thrust beyond its buckling load, which the coarser mesh
// doesn't buckle under: no load in its plane excites the mode, and the solver
// must find the negative eigenvalue all the same.

#include "multigrid_case.h"
#include <nacre/solvers/direct_solver.h>

using namespace MultigridTests;

// E h^3/12 = 1, clamped at one end: it buckles at the thrust pi^2/4.
const std::string strip = R"(
subsection Mid-surface
  set Surface      = plate
  set Subdivisions = 2, 1
  subsection plate
    set Size = 1, 0.1
  end
end
subsection Section
  set Young's modulus = 1.5e9
  set Poisson's ratio = 0
  set Thickness       = 0.002
end
subsection Boundary conditions
  set Edges = u=0: clamped
end
)";

/** Negative eigenvalues by both solvers at a share of Euler's load. */
void
test(const double load, const unsigned int expected)
{
  Case       shell(strip);
  const auto discretization = shell.discretize({ElementType::lagrange, 2}, 1);
  shell.model.kinematics.model   = KinematicsModel::finite;
  shell.model.kinematics.tangent = TangentType::symmetric;
  TrilinosVector u(discretization->locally_owned_dofs(),
                   discretization->locally_relevant_dofs(),
                   MPI_COMM_WORLD);
  const double   strain = load * numbers::PI * numbers::PI / 4. / 3e6;
  u = Tests::interpolate(*discretization, [&](const Point<spacedim> &x) {
    Tensor<1, spacedim> value;
    value[0] = -strain * x[0];
    return value;
  });
  const System system(shell.model, *discretization, &u);
  DirectSolver direct(MPI_COMM_WORLD);
  direct.factorize(system.matrix);
  const std::string name = std::to_string(load) + " of Euler's load: ";
  if (is_root())
    std::cout << name << *direct.n_negative_pivots() << " negative pivots\n";

  MultigridSolver::Parameters parameters;
  parameters.coarse_dofs = 50;
  MultigridSolver solver(*discretization, shell.model, parameters);
  solver.prepare({system.matrix, system.conditions.constraints(), &u});
  bool is_found = false;
  try
    {
      is_found = *solver.count_negative_eigenvalues() > 0;
    }
  catch (const ExcIterationFailed &)
    {
      is_found = true;
    }
  Tests::check_below(name + "multigrid",
                     is_found == (expected > 0) ? 0. : 1.,
                     0.5);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (!is_root())
    std::cout.setstate(std::ios::failbit);
  test(0.9, 0);
  test(1.03, 1);
  return Tests::n_failures > 0;
}
