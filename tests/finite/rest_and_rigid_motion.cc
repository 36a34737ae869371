// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Finite rotations: no force under finite rigid motions, with and without
// conditions that move along; the linear form at rest.

#include "finite_shell.h"

void
test_linearisation()
{
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              serendipity,
                              triangle})
    for (const auto strain :
         {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
      {
        const Shell shell(creased_text("u=0: clamped; v=0: rotation = 0"),
                          element);
        const auto  name = case_name(element, strain);
        const auto  u    = zero_vector(*shell.discretization);
        const auto  linear =
          dense_tangent(*shell.discretization, *shell.make_operator(strain), u);
        const auto [matrix, force] =
          dense_tangent(*shell.discretization,
                        *shell.make_operator(finite(strain)),
                        u);
        check_below(name + "tangent at rest is the linear matrix",
                    relative_difference(matrix, linear.first),
                    1e-12);
        check_below(name + "no force at rest",
                    force.linfty_norm() / matrix.linfty_norm(),
                    1e-15);
      }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  {
    const Parameters parameters(section_text(100., 0.3, 0.2));
    const auto       options = [](const MembraneStrain strain) {
      return finite(strain);
    };
    test_rigid_motion(parameters, options);
  }
  test_rigid_motion_with_conditions(finite(MembraneStrain::tied));
  test_linearisation();
  return n_failures > 0;
}
