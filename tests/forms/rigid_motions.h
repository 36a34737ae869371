// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_rigid_motions_h
#define nacre_tests_rigid_motions_h

// Shells that move as rigid bodies, for all kinematics of large rotations.

#include "corotational_shell.h"

#include <functional>

/** 2 x 2 curved cells with a crease along u = 0. */
inline std::string
creased_text(const std::string &edges)
{
  return "subsection Mid-surface\n set Surface = expression\n"
         " set Subdivisions = 2, 2\n subsection expression\n"
         "  set Position = u + 0.1*v^2, v + 0.1*sin(2*u), "
         "0.5*abs(u) + 0.3*u^2 - 0.2*v^2 + 0.15*u*v\n"
         "  set Range u = -1, 1\n  set Range v = 0, 2\n end\nend\n" +
         edges_parameter + edges + "\nend\n" + section_text(100., 0.3, 0.2);
}

/** A curved crease, neighbours of opposite orientation, hanging nodes. */
inline Mesh
difficult_mesh(const bool refined)
{
  Mesh mesh;
  for (const double y : {0., 0.9, 2.})
    {
      mesh.vertices.emplace_back(-1. + 0.1 * y, y, 0.);
      mesh.vertices.emplace_back(0., y, 0.);
      mesh.vertices.emplace_back(std::cos(1.2), 1.1 * y, std::sin(1.2));
    }
  mesh.cells = {{{0, 1, 3, 4}}, {{1, 4, 2, 5}}, {{3, 4, 6, 7}}, {{4, 5, 7, 8}}};
  mesh.map   = bend;
  if (refined)
    mesh.refined = {0};
  return mesh;
}

/** The rotation by |w| about w, with a shift. */
inline VectorField
rigid_motion(const Vector3 &w, const Vector3 &shift)
{
  return [w, shift](const Point<3> &X) {
    const double  angle = w.norm();
    const Vector3 k     = w / angle;
    const Vector3 X0(X);
    const Vector3 x = std::cos(angle) * X0 +
                      std::sin(angle) * cross_product_3d(k, X0) +
                      (1. - std::cos(angle)) * (k * X0) * k;
    return Vector3(x - X0 + shift);
  };
}

/** Residual of @p field, relative to that of a deformation as large. */
inline double
relative_force(const Discretization &discretization,
               const Assembly       &assembly,
               const VectorField    &field)
{
  auto force = zero_vector(discretization);
  auto scale = zero_vector(discretization);
  assembly.residual(interpolate(discretization, field), force);
  assembly.residual(interpolate(discretization, some_field), scale);
  return force.linfty_norm() / scale.linfty_norm();
}

/** @param options_of of a way to integrate the membrane strain */
inline void
test_rigid_motion(
  const Parameters                                       &parameters,
  const std::function<KinematicsOptions(MembraneStrain)> &options_of)
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
          const Assembly assembly(*discretization,
                                  ShellParts(parameters.section,
                                             parameters.conditions,
                                             parameters.loads,
                                             options_of(strain),
                                             10.));
          check_below("rigid motion, p = " + std::to_string(degree) + ", " +
                        name_of(strain),
                      relative_force(*discretization, assembly, motion),
                      1e-12);
        }
    }
}

/** A surface that conditions hold while it moves as a rigid body. */
inline double
relative_force(const std::string       &position,
               const std::string       &edges,
               const Vector3           &rotation,
               const KinematicsOptions &options)
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
                        *shell.make_operator(options),
                        rigid_motion(rotation, Vector3()));
}

inline void
test_rigid_motion_with_conditions(const KinematicsOptions &options)
{
  // theta > 0 turns the outward conormal -y to the normal z: about -x.
  for (const double angle : {1.1, 4.})
    {
      const auto edges = "v=0: rotation = " + std::to_string(angle);
      const auto name  = "rotation " + std::to_string(angle);
      check_below(
        name + " prescribed and done",
        relative_force("u, v, 0", edges, Vector3{{-angle, 0., 0.}}, options),
        1e-12);
      check_above(
        name + " prescribed, the opposite done",
        relative_force("u, v, 0", edges, Vector3{{angle, 0., 0.}}, options),
        1e-3);
    }
  // The plane's edge turns within it; that the surface meets the plane at an
  // angle is no matter. A rotation out of the plane is not free.
  const std::string vault = "u, v + 0.2*v^2, 0.5*abs(u) + 0.3*u^2 - 0.3*u*v";
  for (const double angle : {1.7, 3.5})
    check_below(
      "symmetry plane, rotation " + std::to_string(angle) + " in it",
      relative_force(vault, "v=0: symmetry", Vector3{{0., angle, 0.}}, options),
      1e-12);
  check_above(
    "symmetry plane, rotation about its edge",
    relative_force("u, v, 0", "v=0: symmetry", Vector3{{0.7, 0., 0.}}, options),
    1e-3);
}

#endif
