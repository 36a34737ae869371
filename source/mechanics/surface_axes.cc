// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/surface_axes.h>

#include <cmath>

namespace Nacre
{
  std::string
  point_text(const Point<3> &point)
  {
    return "(" + Text::number(point[0]) + ", " + Text::number(point[1]) + ", " +
           Text::number(point[2]) + ")";
  }

  VectorExpression
  read_direction(const std::string &text,
                 const std::string &where,
                 const Constants   &constants)
  {
    const std::string plain = Text::trim(text);
    if (plain == "x" || plain == "y" || plain == "z")
      return VectorExpression(plain == "x" ? "1, 0, 0" :
                              plain == "y" ? "0, 1, 0" :
                                             "0, 0, 1",
                              where,
                              constants);
    VectorExpression direction(text, where, constants);
    AssertThrow(!direction.is_zero(),
                ExcMessage(where + ": the direction " + plain +
                           " has no length."));
    return direction;
  }

  Tensor<1, 3>
  projected_direction(const Tensor<1, 3> &direction,
                      const Tensor<1, 3> &t0,
                      const Point<3>     &point,
                      const std::string  &where)
  {
    const auto   projection = direction - (direction * t0) * t0;
    const double length     = projection.norm();
    AssertThrow(length > 1e-8 * direction.norm(),
                ExcMessage(where + ": at the point " + point_text(point) +
                           " it is normal to the surface or zero; its "
                           "projection onto the surface must have a "
                           "direction."));
    return projection / length;
  }

  double
  side_of(const Tensor<1, 3> &top,
          const Tensor<1, 3> &t0,
          const Point<3>     &point,
          const std::string  &where)
  {
    const double height = top * t0;
    AssertThrow(std::abs(height) > 1e-8 * top.norm(),
                ExcMessage(where + ": at the point " + point_text(point) +
                           " it is tangent to the surface or zero, so that "
                           "it names no side of it."));
    return height > 0. ? 1. : -1.;
  }

  SurfaceAxes::Axes
  SurfaceAxes::at(const SurfaceFrame<> &frame, const Point<3> &point) const
  {
    const double side =
      top ? side_of((*top)(point), frame.t0, point, top_parameter) : 1.;
    Axes axes{{}, side * frame.t0, side};
    axes.e[0] = direction ? projected_direction((*direction)(point),
                                                frame.t0,
                                                point,
                                                direction_parameter) :
                            frame.a_cov[0] / frame.a_cov[0].norm();
    axes.e[1] = cross_product_3d(axes.normal, axes.e[0]);
    return axes;
  }
} // namespace Nacre
