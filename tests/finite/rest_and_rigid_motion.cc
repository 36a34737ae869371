// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Finite rotations: no force under finite rigid motions, with and without
// conditions that move along; the linear form at rest.

#include "finite_shell.h"

/** Residual of @p field, relative to that of a deformation as large. */
double
relative_force(const Discretization &discretization,
               const ShellOperator  &shell_operator,
               const VectorField    &field)
{
  auto force = zero_vector(discretization);
  auto scale = zero_vector(discretization);
  shell_operator.residual(interpolate(discretization, field), force);
  shell_operator.residual(interpolate(discretization, some_field), scale);
  return force.linfty_norm() / scale.linfty_norm();
}

void
test_rigid_motion(const Parameters &parameters)
{
  const auto motion =
    rigid_motion(Vector3{{1.9, -1.2, 0.8}}, Vector3{{0.3, -2., 1.}});
  for (const unsigned int degree : {2, 3})
    {
      const auto discretization =
        make_discretization(difficult_mesh(true), degree);
      for (const auto strain : {MembraneStrain::tied,
                                MembraneStrain::full,
                                MembraneStrain::reduced})
        {
          const ShellOperator shell_operator(*discretization,
                                             parameters.section,
                                             parameters.conditions,
                                             parameters.loads,
                                             finite(strain),
                                             10.);
          check_below("rigid motion, p = " + std::to_string(degree) + ", " +
                        name_of(strain),
                      relative_force(*discretization, shell_operator, motion),
                      1e-12);
        }
    }
}

/** A surface that conditions hold while it moves as a rigid body. */
double
relative_force(const std::string &position,
               const std::string &edges,
               const Vector3     &rotation)
{
  const Shell shell("subsection Mid-surface\n set Surface = expression\n"
                    " set Subdivisions = 2, 2\n subsection expression\n"
                    "  set Position = " +
                      position +
                      "\n  set Range u = -1, 1\n  set Range v = 0, 1\n"
                      " end\nend\n" +
                      edges_parameter + edges + "\nend\n" +
                      section_text(100., 0.3, 0.2),
                    {ElementType::lagrange, 2});
  return relative_force(*shell.discretization,
                        *shell.make_operator(finite(MembraneStrain::tied)),
                        rigid_motion(rotation, Vector3()));
}

void
test_rigid_motion_with_conditions()
{
  // theta > 0 turns the outward conormal -y to the normal z: about -x.
  for (const double angle : {1.1, 4.})
    {
      const auto edges = "v=0: rotation = " + std::to_string(angle);
      const auto name  = "rotation " + std::to_string(angle);
      check_below(name + " prescribed and done",
                  relative_force("u, v, 0", edges, Vector3{{-angle, 0., 0.}}),
                  1e-12);
      check_above(name + " prescribed, the opposite done",
                  relative_force("u, v, 0", edges, Vector3{{angle, 0., 0.}}),
                  1e-3);
    }
  // The plane's edge turns within it; that the surface meets the plane at an
  // angle is no matter. A rotation out of the plane is not free.
  const std::string vault = "u, v + 0.2*v^2, 0.5*abs(u) + 0.3*u^2 - 0.3*u*v";
  for (const double angle : {1.7, 3.5})
    check_below("symmetry plane, rotation " + std::to_string(angle) + " in it",
                relative_force(vault,
                               "v=0: symmetry",
                               Vector3{{0., angle, 0.}}),
                1e-12);
  check_above("symmetry plane, rotation about its edge",
              relative_force("u, v, 0",
                             "v=0: symmetry",
                             Vector3{{0.7, 0., 0.}}),
              1e-3);
}

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
    test_rigid_motion(parameters);
  }
  test_rigid_motion_with_conditions();
  test_linearisation();
  return n_failures > 0;
}
