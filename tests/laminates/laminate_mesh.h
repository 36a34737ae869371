// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_laminates_laminate_mesh_h
#define nacre_tests_laminates_laminate_mesh_h

#include "laminate_parameters.h"

namespace Tests
{
  /** 3 x 2 cells of the rectangle [0, 3] x [0, 2]. */
  inline Mesh
  make_mesh(const std::function<Point<3>(const Point<3> &)> &map)
  {
    Mesh mesh;
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        mesh.vertices.emplace_back(i, j, 0.);
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int i = 0; i < 3; ++i)
        mesh.cells.push_back(
          {{4 * j + i, 4 * j + i + 1, 4 * j + i + 4, 4 * j + i + 5}});
    mesh.map = map;
    return mesh;
  }

  inline Point<3>
  fold(const Point<3> &x)
  {
    return {x[0], x[1], -1.5 * std::abs(x[0] - 2.)};
  }

  inline Element
  lagrange(const unsigned int degree)
  {
    return {ElementType::lagrange, degree};
  }

  /** A stack that couples everything. */
  const std::string coupled_stack =
    laminate_text("[0/30/-60]",
                  "0.1",
                  "  set Material direction = 1, 0.4, 0\n"
                  "  set Top = 0.1, 0, 1\n");

} // namespace Tests

#endif
