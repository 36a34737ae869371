// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Newton's method converges quadratically with finite rotations: strips bent by
// an end force, and rolled up by the rotation of their ends.

#include "finite_shell.h"
#include <nacre/discretization/displacement_conditions.h>

/** The largest changes of a displacement, iteration by iteration. */
std::vector<double>
newton(const Shell &shell, const Assembly &assembly, TrilinosVector &u)
{
  const DisplacementConditions conditions(*shell.discretization,
                                          *shell.conditions);
  std::vector<double>          changes;
  for (unsigned int k = 1; k <= 30; ++k)
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
      changes.push_back(change);
      if (change <= 1e-9 * u.linfty_norm())
        break;
    }
  return changes;
}

/**
 * The order from the last three changes: log(c_3/c_2) / log(c_2/c_1), of which
 * c_3 is the first below 1e-5 of the first change, far above round-off.
 */
double
observed_order(const std::vector<double> &changes)
{
  for (unsigned int k = 2; k < changes.size(); ++k)
    if (changes[k] < 1e-5 * changes[0])
      return std::log(changes[k] / changes[k - 1]) /
             std::log(changes[k - 1] / changes[k - 2]);
  return 0.;
}

void
report(const std::string &name, const std::vector<double> &changes)
{
  if (std::getenv("NACRE_TEST_VALUES") == nullptr)
    return;
  std::cout << name << ":";
  for (const double change : changes)
    std::cout << ' ' << change;
  std::cout << std::endl;
}

Shell
strip(const double       thickness,
      const std::string &edges,
      const std::string &loads)
{
  return Shell(
    "subsection Mid-surface\n set Surface = plate\n set Subdivisions = 8, 1\n"
    " subsection plate\n  set Size = 10, 1\n end\nend\n" +
      section_text(1.2e6, 0., thickness) + edges_parameter + "u=0: clamped" +
      edges + "\nend\n" + loads,
    {ElementType::lagrange, 3});
}

void
test_end_force()
{
  const Shell shell =
    strip(0.1, "", "subsection Loads\n set Edge forces = u=1: 0, 0, 4\nend\n");
  auto       u = zero_vector(*shell.discretization);
  const auto changes =
    newton(shell,
           *shell.make_operator(
             finite(MembraneStrain::tied, TangentType::symmetric)),
           u);
  report("end force", changes);
  check_above("end force: order", observed_order(changes), 1.7);
  check_below("end force: iterations", changes.size(), 20.5);
}

/** A strip rolled up to half a circle by the rotation of its end. */
void
test_roll(const KinematicsModel model, const double thickness)
{
  constexpr unsigned int n_steps = 12;
  TrilinosVector         u;
  std::vector<double>    changes;
  unsigned int           most = 0;
  for (unsigned int step = 1; step <= n_steps; ++step)
    {
      const Shell shell =
        strip(thickness,
              "; v=0, v=1: y = 0; u=1: rotation = " + std::to_string(step) +
                "*pi/" + std::to_string(n_steps),
              "");
      KinematicsOptions options(
        finite(MembraneStrain::tied, TangentType::symmetric));
      options.model = model;
      if (step == 1)
        u = zero_vector(*shell.discretization);
      changes = newton(shell, *shell.make_operator(options), u);
      most    = std::max<unsigned int>(most, changes.size());
    }
  const auto name =
    name_of(model) + ", thickness " + std::to_string(thickness) + ": ";
  report(name + "last step", changes);
  check_below(name + "iterations", most, 12.5);
  if (model == KinematicsModel::finite)
    check_above(name + "order", observed_order(changes), 1.7);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_end_force();
  for (const double thickness : {0.1, 1.})
    {
      test_roll(KinematicsModel::finite, thickness);
      test_roll(KinematicsModel::corotational, thickness);
    }
  return n_failures > 0;
}
