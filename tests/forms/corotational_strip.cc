// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Newton's method with the co-rotational tangent: a cantilever's end shear in
// one step, a strip rolled up to a circle.

#include "corotational_shell.h"
#include <nacre/discretization/displacement_conditions.h>

/** Newton's method; returns iterations until |du| <= 1e-8 |u|. */
unsigned int
newton(const Shell &shell, const Assembly &assembly, TrilinosVector &u)
{
  const DisplacementConditions conditions(*shell.discretization,
                                          *shell.conditions);
  for (unsigned int k = 1; k <= 20; ++k)
    {
      auto [matrix, force]       = dense_tangent(*shell.discretization,
                                           assembly,
                                           u,
                                           conditions.constraints());
      const unsigned int       n = force.size();
      LAPACKFullMatrix<double> lapack(n, n);
      lapack = matrix;
      lapack.compute_lu_factorization();
      force *= -1.;
      lapack.solve(force);
      double change = 0.;
      for (unsigned int i = 0; i < n; ++i)
        if (!conditions.constraints().is_constrained(i))
          {
            u(i)   = u(i) + force[i];
            change = std::max(change, std::abs(force[i]));
          }
      u.compress(VectorOperation::insert);
      if (change <= 1e-8 * u.linfty_norm())
        return k;
    }
  return 100;
}

/** Displacement of the node at @p point. */
Vector3
node_displacement(const Discretization &discretization,
                  const TrilinosVector &u,
                  const Point<3>       &point)
{
  const auto                          &node_dofs = discretization.node_dofs();
  std::vector<types::global_dof_index> dofs(node_dofs.size());
  for (const auto &cell : discretization.dof_handler().active_cell_iterators())
    {
      const auto nodes = discretization.node_positions(cell);
      cell->get_dof_indices(dofs);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        if ((nodes[a] - point).norm() < 1e-10)
          return Vector3{{u(dofs[node_dofs[3 * a]]),
                          u(dofs[node_dofs[3 * a + 1]]),
                          u(dofs[node_dofs[3 * a + 2]])}};
    }
  AssertThrow(false, ExcInternalError());
  return Vector3();
}

const std::string strip_text =
  "subsection Mid-surface\n set Surface = plate\n set Subdivisions = 8, 1\n"
  " subsection plate\n  set Size = 10, 1\n end\nend\n" +
  section_text(1.2e6, 0., 0.1) + edges_parameter;

/** The end shear P = 4 in one step, against the elastica. */
void
test_cantilever(const Element       &element,
                const MembraneStrain strain,
                const double         tolerance)
{
  const Shell shell(
    strip_text + "u=0: clamped\nend\n"
                 "subsection Loads\n set Edge forces = u=1: 0, 0, 4\nend\n",
    element);
  for (const auto tangent : {TangentType::symmetric, TangentType::consistent})
    {
      const auto name =
        case_name(element, strain) + "cantilever, " + name_of(tangent) + ": ";
      const auto assembly =
        shell.make_operator(corotational(strain, tangent), 5.);
      auto u = zero_vector(*shell.discretization);
      check_below(name + "iterations", newton(shell, *assembly, u), 8.5);
      const auto end =
        node_displacement(*shell.discretization, u, Point<3>(10., 0., 0.));
      check_below(name + "deflection",
                  std::abs(end[2] / 6.6996 - 1.),
                  tolerance);
      check_below(name + "shortening",
                  std::abs(-end[0] / 3.2894 - 1.),
                  tolerance);
    }
}

/**
 * A strip rolled up to a circle, 30 degrees a step, by the rotation of its end
 * or by a moment.
 */
void
test_roll_up(const Element       &element,
             const MembraneStrain strain,
             const bool           by_moment)
{
  const auto name = case_name(element, strain) + "roll-up by " +
                    (by_moment ? "moment, " : "rotation, ");
  // A moment finds 45 degrees a cell too stiff for p = 2.
  const bool     coarse = by_moment && element.degree == 2;
  TrilinosVector u;
  unsigned int   most = 0;
  for (unsigned int step = 1; step <= 12; ++step)
    {
      // M = E I theta / L, E I = 100; l(v) = -int m theta(v)
      const auto  angle = std::to_string(step) + "*pi/6";
      const Shell shell(strip_text + "u=0: clamped" +
                          (by_moment ?
                             "\nend\nsubsection Loads\n set Edge moments = "
                             "u=1: -10*" +
                               angle :
                             "; u=1: rotation = " + angle) +
                          "\nend\n",
                        element);
      const auto  assembly = shell.make_operator(corotational(strain), 5.);
      if (step == 1)
        u = zero_vector(*shell.discretization);
      most = std::max(most, newton(shell, *assembly, u));
      if (step == 12)
        {
          const auto end =
            node_displacement(*shell.discretization, u, Point<3>(10., 0., 0.));
          check_below(name + "distance of the ends",
                      (end + Vector3{{10., 0., 0.}}).norm() / 10.,
                      coarse ? 0.05 : 2e-3);
          // E I (2 pi)^2 / (2 L)
          const double energy = assembly->energies(u).total();
          check_below(name + "energy",
                      std::abs(energy / (20. * numbers::PI * numbers::PI) - 1.),
                      coarse ? 0.09 : 5e-3);
        }
    }
  check_below(name + "iterations a step", most, 8.5);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto type :
       {ElementType::lagrange, ElementType::serendipity, ElementType::triangle})
    {
      test_cantilever({type, 2}, default_membrane_strain(type), 5e-3);
      test_roll_up({type, 2}, default_membrane_strain(type), false);
      test_roll_up({type, 2}, default_membrane_strain(type), true);
    }
  test_roll_up({ElementType::lagrange, 3}, MembraneStrain::tied, true);
  test_cantilever({ElementType::lagrange, 3}, MembraneStrain::tied, 1e-4);
  return n_failures > 0;
}
