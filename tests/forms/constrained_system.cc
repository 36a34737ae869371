// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Pattern and elimination of constraints, on any number of ranks: with u = C x
// + g, hanging nodes, prescribed and coupled displacements,
// C^T (f - K u) of the matrix without constraints is f - K x of the one with
// constraints eliminated, and the rows hold what the form couples.

#include "../tests_common.h"

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/sparsity_tools.h>

using namespace Tests;

/** 4 x 3 curved cells, some of them refined. */
Mesh
panel_mesh(const bool refined)
{
  Mesh mesh;
  for (unsigned int j = 0; j < 4; ++j)
    for (unsigned int i = 0; i < 5; ++i)
      mesh.vertices.emplace_back(i, j, 0.);
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i < 4; ++i)
      mesh.cells.push_back(
        {{5 * j + i, 5 * j + i + 1, 5 * j + i + 5, 5 * j + i + 6}});
  mesh.map = bend;
  if (refined)
    mesh.refined = {1, 6, 7};
  return mesh;
}

/** Hanging nodes; every seventh dof prescribed, some a multiple of another. */
AffineConstraints<double>
make_constraints(const Discretization &discretization)
{
  const auto               &relevant = discretization.locally_relevant_dofs();
  AffineConstraints<double> constraints(relevant);
  constraints.merge(discretization.node_constraints());
  for (const auto dof : relevant)
    if (dof % 7 == 0 && !constraints.is_constrained(dof))
      {
        constraints.add_line(dof);
        constraints.set_inhomogeneity(dof, 0.1 + 0.01 * (dof % 5));
      }
  constraints.close();
  return constraints;
}

TrilinosVector
owned_vector(const Discretization &discretization)
{
  return TrilinosVector(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
}

/** C^T r on this rank's free dofs, zero on the others. */
TrilinosVector
condense(const Discretization            &discretization,
         const AffineConstraints<double> &constraints,
         const TrilinosVector            &r)
{
  TrilinosVector result = owned_vector(discretization);
  for (const auto dof : discretization.locally_owned_dofs())
    if (!constraints.is_constrained(dof))
      result(dof) += r(dof);
    else
      for (const auto &[master, weight] :
           *constraints.get_constraint_entries(dof))
        result(master) += weight * r(dof);
  result.compress(VectorOperation::add);
  return result;
}

/** Number of entries that deal.II's pattern of dofs has. */
types::global_dof_index
reference_entries(const Discretization            &discretization,
                  const AffineConstraints<double> &constraints)
{
  const auto            &relevant = discretization.locally_relevant_dofs();
  DynamicSparsityPattern pattern(relevant);
  DoFTools::make_flux_sparsity_pattern(discretization.dof_handler(),
                                       pattern,
                                       constraints,
                                       false);
  SparsityTools::distribute_sparsity_pattern(
    pattern,
    discretization.locally_owned_dofs(),
    MPI_COMM_WORLD,
    relevant);
  types::global_dof_index n = 0;
  for (const auto dof : discretization.locally_owned_dofs())
    n += pattern.row_length(dof);
  return Utilities::MPI::sum(n, MPI_COMM_WORLD);
}

void
test(const Parameters &parameters, const Element &element, const bool refined)
{
  const auto discretization = make_discretization(panel_mesh(refined), element);
  const auto constraints    = make_constraints(*discretization);
  AffineConstraints<double> none(discretization->locally_relevant_dofs());
  none.close();
  const Assembly                 assembly(*discretization,
                          ShellParts(parameters.section,
                                     parameters.conditions,
                                     parameters.loads,
                                     default_membrane_strain(element.type),
                                     6. * element.degree));
  TrilinosWrappers::SparseMatrix K, K_free;
  auto f = owned_vector(*discretization), f_free = f, x = f, r = f, r_free = f;
  assembly.reinit_matrix(none, K);
  assembly.reinit_matrix(constraints, K_free);
  assembly.assemble_system(none, K, f);
  assembly.assemble_system(constraints, K_free, f_free);

  for (const auto dof : discretization->locally_owned_dofs())
    if (!constraints.is_constrained(dof))
      x(dof) = std::sin(3. * dof);
  x.compress(VectorOperation::insert);
  auto u = x;
  constraints.distribute(u);
  K.vmult(r, u);
  r.sadd(-1., 1., f);
  K_free.vmult(r_free, x);
  r_free.sadd(-1., 1., f_free);
  // Of the constrained rows there is the diagonal only.
  for (const auto dof : discretization->locally_owned_dofs())
    if (constraints.is_constrained(dof))
      r_free(dof) = 0.;
  r_free.compress(VectorOperation::insert);
  auto         difference = condense(*discretization, constraints, r);
  const double size       = difference.linfty_norm();
  difference -= r_free;
  const std::string name =
    label(element) + (refined ? ", hanging nodes" : "") + ": ";
  check_below(name + "C^T (f - K u)", difference.linfty_norm() / size, 1e-12);

  // Blocks that hanging nodes depend on count as a whole.
  const double entries   = K_free.n_nonzero_elements();
  const double reference = reference_entries(*discretization, constraints);
  check_below(name + "missing entries", reference - entries, 0.5);
  check_below(name + "more entries",
              entries / reference - 1.,
              refined ? 0.15 : 1e-12);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.setstate(std::ios::failbit);
  const Parameters parameters(section_text(100., 0.3, 0.2));
  for (const Element &element : {Element{ElementType::lagrange, 2},
                                 Element{ElementType::lagrange, 3},
                                 serendipity,
                                 triangle})
    for (const bool refined : {false, true})
      if (!refined || element.type != ElementType::triangle)
        test(parameters, element, refined);
  return n_failures > 0;
}
