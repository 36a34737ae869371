// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Energy and residual of a given displacement are the same numbers on any
// number of ranks, in Debug and in Release: curved and creased cells, hanging
// nodes, a rotation condition.

#include "../tests_common.h"

#include <iomanip>

using namespace Tests;

Point<3>
bend_and_crease(const Point<3> &x)
{
  Point<3> y = bend(x);
  y[2] += 0.4 * std::abs(x[0] - 1.);
  return y;
}

Vector3
other_field(const Point<3> &x)
{
  Vector3 u;
  u[0] = x[1] * x[2];
  u[1] = std::sin(x[0]);
  u[2] = x[0] * x[1] * x[1];
  return u;
}

/** 3 x 2 cells, two of them refined. */
Mesh
panel_mesh()
{
  Mesh mesh;
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i < 4; ++i)
      mesh.vertices.emplace_back(i, j, 0.);
  for (unsigned int j = 0; j < 2; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      mesh.cells.push_back(
        {{4 * j + i, 4 * j + i + 1, 4 * j + i + 4, 4 * j + i + 5}});
  mesh.map     = bend_and_crease;
  mesh.refined = {1, 3};
  return mesh;
}

TrilinosVector
owned_interpolant(const Discretization &discretization,
                  const VectorField    &field)
{
  TrilinosVector u(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  std::vector<types::global_dof_index> dofs(discretization.node_dofs().size());
  for (const auto &cell : discretization.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        cell->get_dof_indices(dofs);
        const auto nodes = discretization.node_positions(cell);
        for (unsigned int k = 0; k < dofs.size(); ++k)
          {
            const auto dof = dofs[discretization.node_dofs()[k]];
            if (discretization.locally_owned_dofs().is_element(dof))
              u(dof) = field(nodes[k / 3])[k % 3];
          }
      }
  u.compress(VectorOperation::insert);
  discretization.node_constraints().distribute(u);
  return u;
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (!root)
    std::cout.setstate(std::ios::failbit);

  // Membrane, bending and edge energy, work of the residual on another field,
  // norm of the residual; from a run on one rank in Release.
  const std::vector<std::array<double, 5>> expected = {{{958.87676478493688,
                                                         1.888085968509758,
                                                         3.2588282200955243,
                                                         215.93543525099801,
                                                         199.78835764746066}},
                                                       {{946.85290943603468,
                                                         2.3835527089558624,
                                                         3.9832935794672957,
                                                         224.57361952550366,
                                                         181.32944505934452}},
                                                       {{946.44255275782416,
                                                         2.1989615947301311,
                                                         4.3627041776457984,
                                                         223.10121683406692,
                                                         198.86698360697739}},
                                                       {{941.89640970517883,
                                                         1.5401449600628077,
                                                         4.1366904397088069,
                                                         232.00401062883176,
                                                         213.05318379853315}},
                                                       {{968.33413931900918,
                                                         1.7580852169925762,
                                                         26.079718097972997,
                                                         217.88303660979923,
                                                         224.95995319896198}}};

  const Parameters           parameters(section_text(100., 0.3, 0.2));
  const std::vector<Element> elements = {{ElementType::lagrange, 2},
                                         {ElementType::lagrange, 3},
                                         {ElementType::lagrange, 4},
                                         serendipity,
                                         triangle};
  for (unsigned int e = 0; e < elements.size(); ++e)
    {
      auto mesh = panel_mesh();
      if (elements[e].type == ElementType::triangle)
        mesh.refined.clear();
      const auto     discretization = make_discretization(mesh, elements[e]);
      const Assembly assembly(*discretization,
                              ShellParts(parameters.section,
                                         parameters.conditions,
                                         parameters.loads,
                                         default_membrane_strain(
                                           elements[e].type),
                                         6. * elements[e].degree));
      TrilinosVector u(discretization->locally_owned_dofs(),
                       discretization->locally_relevant_dofs(),
                       MPI_COMM_WORLD);
      // A temporary would be moved, and with it go the ghosts.
      const auto owned = owned_interpolant(*discretization, some_field);
      u                = owned;
      TrilinosVector              residual(discretization->locally_owned_dofs(),
                              MPI_COMM_WORLD);
      const Energies              energies = assembly.residual(u, residual);
      const std::array<double, 5> found    = {
           {energies.membrane,
            energies.bending,
            energies.edge,
            residual * owned_interpolant(*discretization, other_field),
            residual.l2_norm()}};
      const char *const names[] = {"membrane energy",
                                   "bending energy",
                                   "edge energy",
                                   "work",
                                   "norm"};
      for (unsigned int k = 0; k < found.size(); ++k)
        {
          if (std::getenv("NACRE_TEST_VALUES") != nullptr && root)
            std::cout << std::setprecision(17) << found[k] << ", ";
          check_below(label(elements[e]) + ", " + names[k],
                      std::abs(found[k] / expected[e][k] - 1.),
                      1e-12);
        }
    }
  return n_failures > 0;
}
