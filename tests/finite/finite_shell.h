// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_finite_shell_h
#define nacre_tests_finite_shell_h

// What the tests of finite rotations share.

#include "../forms/corotational_shell.h"

inline KinematicsOptions
finite(const MembraneStrain membrane_strain,
       const TangentType    tangent = TangentType::consistent)
{
  return {membrane_strain, EdgeForm::hinge, KinematicsModel::finite, tangent};
}

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

#endif
