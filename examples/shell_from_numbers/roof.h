// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_examples_roof_h
#define nacre_examples_roof_h

// The Scordelis-Lo roof, a quarter of it, as values: no parameter file and no
// text but the names of edges.

#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/problem/shell_model.h>
#include <nacre/problem/surfaces.h>

#include <cmath>
#include <memory>

namespace Roof
{
  using namespace Nacre;

  constexpr double R      = 25.;                      // radius
  constexpr double length = 50.;                      // along the axis
  constexpr double angle  = 40. * numbers::PI / 180.; // from crown to edge
  constexpr double E      = 4.32e8;                   // Young's modulus
  constexpr double nu     = 0.;                       // Poisson's ratio
  constexpr double h      = 0.25;                     // thickness

  /**
   * n x n coarse cells of the quarter between the crown, the free edge, an end
   * and the middle; the chart is (angle from the crown, axial coordinate).
   */
  inline Midsurface
  make_midsurface(const unsigned int n)
  {
    ChartRectangle rectangle;
    for (unsigned int i = 0; i <= n; ++i)
      {
        rectangle.u.push_back(angle * i / n);
        rectangle.v.push_back(0.5 * length * i / n);
      }
    return Midsurface(
      make_rectangle(rectangle, make_chart_map([](const Point<3> &c) {
                       return Point<3>(R * std::sin(c[0]),
                                       c[1],
                                       R * std::cos(c[0]));
                     })));
  }

  inline ShellModel
  make_model(const unsigned int degree)
  {
    ShellModel model{make_midsurface(2),
                     std::make_shared<LinearElasticSection>(E, nu, h)};
    const auto edge = [&](const char *const name) {
      return model.midsurface.edge_ids(name, "the roof");
    };
    // Planes of symmetry: the crown, and the middle.
    for (const auto *const name : {"u=0", "v=1"})
      {
        model.supports.prescribe(edge(name), Direction::plane_normal);
        model.supports.prescribe_rotation(edge(name));
      }
    // A rigid diaphragm at the end.
    model.supports.prescribe(edge("v=0"), Direction::within_plane);
    model.loads.force    = VectorExpression(Tensor<1, 3>({0., 0., -90.}));
    model.element.degree = degree;
    return model;
  }
} // namespace Roof

#endif
