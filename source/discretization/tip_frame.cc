// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/plane_geometry.h>
#include <nacre/discretization/tip_frame.h>

namespace Nacre
{
  FieldDerivatives
  surface_at(const FiniteElement<dim, spacedim> &fe,
             const std::vector<Point<spacedim>> &nodes,
             const Point<dim>                   &unit)
  {
    FieldDerivatives x;
    for (unsigned int a = 0; a < nodes.size(); ++a)
      {
        x.value += fe.shape_value(a, unit) * nodes[a];
        const auto dN = fe.shape_grad(a, unit);
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          x.first[alpha] += dN[alpha] * nodes[a];
      }
    return x;
  }

  TipFunctions::Tip
  tip_frame(const CutTrace::Tip &tip, const FieldDerivatives &surface)
  {
    Tensor<1, 3> e_3 = cross_product_3d(surface.first[0], surface.first[1]);
    e_3 /= e_3.norm();
    Tensor<1, 3> e_1 = tip.direction - (tip.direction * e_3) * e_3;
    e_1 /= e_1.norm();
    return {tip.position, {{e_1, cross_product_3d(e_3, e_1), e_3}}};
  }

  Tensor<1, dim>
  backward_from_tip(const TipFunctions::Tip &frame,
                    const FieldDerivatives  &surface)
  {
    const auto    &a   = surface.first;
    const double   a11 = a[0] * a[0], a22 = a[1] * a[1], a12 = a[0] * a[1];
    const double   b1 = -(a[0] * frame.axes[0]);
    const double   b2 = -(a[1] * frame.axes[0]);
    Tensor<1, dim> backward;
    backward[0] = a22 * b1 - a12 * b2;
    backward[1] = a11 * b2 - a12 * b1;
    return backward / backward.norm();
  }

  bool
  holds_tip(const CutTrace::Tip &tip, const CellPart &part)
  {
    if (part.cell->id() != tip.cell)
      return false;
    const auto polygon = part.outline();
    if (!polygon.contains(tip.unit, 0.))
      return false;
    for (unsigned int i = 0; i < polygon.n_vertices(); ++i)
      if (PlaneGeometry::nearest_on_segment(polygon.vertex(i),
                                            polygon.vertex(
                                              (i + 1) % polygon.n_vertices()),
                                            tip.unit)
            .distance(tip.unit) < 1e-8)
        return false;
    return true;
  }
} // namespace Nacre
