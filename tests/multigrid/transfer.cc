// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Transfer between a mesh and the coarsened one: polynomials on a plate are
// reproduced both ways, restriction is the transpose, interpolation undoes
// prolongation; with hanging nodes, supports and cuts, for all elements, on any
// number of ranks.

#include "multigrid_case.h"
#include <nacre/multigrid/coarse_mesh.h>
#include <nacre/multigrid/level_transfer.h>

using namespace MultigridTests;
using DistributedVector = LevelTransfer::Vector;

/** A polynomial of degree @p p without any symmetry. */
Tensor<1, spacedim>
polynomial(const Point<spacedim> &x, const unsigned int p)
{
  Tensor<1, spacedim> u;
  u[0] = 1. + std::pow(x[0] - 2. * x[1], p);
  u[1] = x[0] * std::pow(x[1], p - 1) - 0.5;
  u[2] = std::pow(x[0] + 0.3, p) + 2. * x[1];
  return u;
}

/** Above this line the polynomial is another one, if the plate is cut. */
double
height_of_cut(const double x)
{
  return 0.31 + 0.17 * x;
}

/** All dofs of this rank, constrained ones included. */
TrilinosVector
interpolate_polynomial(const Discretization &discretization)
{
  TrilinosVector u(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  std::vector<types::global_dof_index> dofs;
  const bool is_cut = !discretization.cell_parts().is_empty();
  for (const CellPart &part : discretization.owned_parts())
    {
      discretization.get_dof_indices(part, dofs);
      const auto   x      = discretization.point_inside(part);
      const double factor = is_cut && x[1] > height_of_cut(x[0]) ? -0.7 : 1.;
      const auto   nodes  = discretization.node_positions(part);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          if (const auto i = dofs[discretization.node_dofs()[3 * a + c]];
              discretization.locally_owned_dofs().is_element(i))
            u(i) = factor * polynomial(nodes[a], discretization.degree())[c];
    }
  u.compress(VectorOperation::insert);
  return u;
}

/** Numbers on the unconstrained dofs, the same on any number of ranks. */
DistributedVector
some_vector(const Discretization            &discretization,
            const AffineConstraints<double> &constraints)
{
  DistributedVector v(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  for (const auto i : discretization.locally_owned_dofs())
    if (!constraints.is_constrained(i))
      v(i) = std::sin(1. + 17. * i);
  return v;
}

/** Largest difference on the unconstrained dofs. */
double
difference(const DistributedVector         &x,
           const TrilinosVector            &y,
           const AffineConstraints<double> &constraints)
{
  double largest = 0.;
  for (const auto i : y.locally_owned_elements())
    if (!constraints.is_constrained(i))
      largest = std::max(largest, std::abs(x(i) - y(i)));
  return Utilities::MPI::max(largest, MPI_COMM_WORLD);
}

void
test(const Element &element,
     const bool     is_adaptive,
     const bool     is_held,
     const Cuts    &cuts = {})
{
  const Case          shell("subsection Mid-surface\n set Surface = plate\n"
                            " set Subdivisions = 3, 2\nend\n" +
                   std::string(is_held ? "subsection Boundary conditions\n"
                                                  " set Edges = "
                                                  "u=0: x = 0, z = 0\nend" :
                                         ""));
  std::vector<Marker> markers;
  if (is_adaptive)
    for (const double radius : {0.6, 0.3})
      markers.emplace_back([radius](const Point<spacedim> &x) {
        return x.distance(Point<spacedim>(0.1, 0.4, 0.)) < radius;
      });
  const auto           fine = shell.discretize(element, 2, markers, cuts);
  const Discretization coarse(coarsen(shell.model.midsurface,
                                      fine->triangulation()),
                              shell.model.midsurface,
                              element,
                              0,
                              cuts);
  const DisplacementConditions fine_conditions(*fine, shell.model.supports);
  const DisplacementConditions coarse_conditions(coarse, shell.model.supports);
  const auto                  &fine_constraints = fine_conditions.constraints();
  const auto         &coarse_constraints = coarse_conditions.constraints();
  const LevelTransfer transfer(*fine,
                               fine_constraints,
                               coarse,
                               coarse_constraints);
  const std::string   name =
    Tests::label(element) + (is_adaptive ? ", hanging nodes" : "") +
    (is_held ? ", held" : "") + (cuts.is_empty() ? "" : ", cut");
  Tests::check_below(name + ": cells",
                     double(coarse.triangulation().n_global_active_cells()) /
                       fine->triangulation().n_global_active_cells(),
                     0.5);

  const TrilinosVector fine_u   = interpolate_polynomial(*fine);
  const TrilinosVector coarse_u = interpolate_polynomial(coarse);
  DistributedVector    x        = some_vector(coarse, coarse_constraints);
  DistributedVector    Px(fine->locally_owned_dofs(), MPI_COMM_WORLD);
  if (!is_held)
    {
      DistributedVector free_u(x);
      std::copy(coarse_u.begin(), coarse_u.end(), free_u.begin());
      for (const auto &line : coarse_constraints.get_lines())
        if (coarse.locally_owned_dofs().is_element(line.index))
          free_u(line.index) = 1e3;
      transfer.prolongate_and_add(Px, free_u);
      Tests::check_below(name + ": polynomial",
                         difference(Px, fine_u, fine_constraints),
                         1e-11);
    }

  TrilinosVector ghosted(fine->locally_owned_dofs(),
                         fine->locally_relevant_dofs(),
                         MPI_COMM_WORLD);
  ghosted = fine_u;
  TrilinosVector restricted(coarse.locally_owned_dofs(), MPI_COMM_WORLD);
  const auto     interpolate = [&]() {
    const TrilinosVector with_ghosts = transfer.interpolate(ghosted);
    for (const auto i : coarse.locally_owned_dofs())
      restricted(i) = with_ghosts(i);
    restricted.compress(VectorOperation::insert);
  };
  interpolate();
  restricted -= coarse_u;
  Tests::check_below(name + ": interpolation", restricted.linfty_norm(), 1e-11);

  Px = 0.;
  transfer.prolongate_and_add(Px, x);
  TrilinosVector prolongated(fine->locally_owned_dofs(), MPI_COMM_WORLD);
  std::copy(Px.begin(), Px.end(), prolongated.begin());
  fine_constraints.distribute(prolongated);
  ghosted = prolongated;
  interpolate();
  Tests::check_below(name + ": there and back",
                     difference(x, restricted, coarse_constraints),
                     cuts.is_empty() ? 1e-12 : 1e-10); // phantom nodes

  const DistributedVector y = some_vector(*fine, fine_constraints);
  DistributedVector       Rty(x);
  transfer.restrict_to(Rty, y);
  Tests::check_below(name + ": transpose",
                     std::abs(Px * y - x * Rty) / (Px.l2_norm() * y.l2_norm()),
                     1e-14);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (!is_root())
    std::cout.setstate(std::ios::failbit);
  for (const unsigned int p : {2, 3, 4})
    test({ElementType::lagrange, p}, p == 3, false);
  test({ElementType::lagrange, 2}, true, false);
  test(Tests::serendipity, true, false);
  test(Tests::triangle, false, false);
  test({ElementType::lagrange, 3}, true, true);
  Cuts cuts;
  cuts.curves.push_back(
    {"cut",
     CutCurve::Coordinates::chart,
     {{-0.1, height_of_cut(-0.1), 0.}, {1.1, height_of_cut(1.1), 0.}}});
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              Tests::serendipity,
                              Tests::triangle})
    test(element, false, element.degree == 3, cuts);
}
