// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_surface_axes_h
#define nacre_mechanics_surface_axes_h

#include <nacre/base/expression.h>
#include <nacre/mechanics/surface_frame.h>

#include <array>
#include <optional>
#include <string>

namespace Nacre
{
  /** "(x, y, z)" of a point (length), for messages. */
  std::string
  point_text(const Point<3> &point);

  /**
   * A direction of a parameter @p where: three expressions of x, y, z, or the
   * name of an axis, x, y or z. Throws if it is zero.
   */
  VectorExpression
  read_direction(const std::string &text,
                 const std::string &where,
                 const Constants   &constants);

  /**
   * The unit vector along the projection d - (d . t0) t0 of a @p direction d
   * onto the surface with the unit normal @p t0. Throws where there is none,
   * with the parameter @p where and the @p point.
   */
  Tensor<1, 3>
  projected_direction(const Tensor<1, 3> &direction,
                      const Tensor<1, 3> &t0,
                      const Point<3>     &point,
                      const std::string  &where);

  /**
   * +1 if the vector @p top points to the side of the unit normal @p t0, -1 if
   * to the other. Throws where it is tangent to the surface, with the parameter
   * @p where and the @p point.
   */
  double
  side_of(const Tensor<1, 3> &top,
          const Tensor<1, 3> &t0,
          const Point<3>     &point,
          const std::string  &where);

  /**
   * The axes in which results are given: unit vectors 1 and 2 of the tangent
   * plane and the normal, 2 = normal x 1. By default 1 is along the covariant
   * vector a_1 of the cell and the normal is t0, which both depend on the
   * numbering of the cell; a direction and a vector that points to the top
   * make them the same for any mesh.
   */
  struct SurfaceAxes
  {
    struct Axes
    {
      /** The axes 1 and 2 (1). */
      std::array<Tensor<1, 3>, 2> e;
      /** The unit normal on the side of the top. */
      Tensor<1, 3> normal;
      /** +1 if the normal is t0, -1 if it is -t0. */
      double side;
    };

    /** The axis 1 is its projection onto the surface; none: a_1. */
    std::optional<VectorExpression> direction = {};
    /** Points to the top; none: the top is on the side of t0. */
    std::optional<VectorExpression> top = {};
    /** The parameters of both, for messages. */
    std::string direction_parameter = "the reference direction";
    std::string top_parameter       = "the top";

    /**
     * The axes at a @p point of the surface (length). Throws where the
     * direction is normal to the surface or zero, and where the vector to the
     * top is tangent to it or zero.
     */
    Axes
    at(const SurfaceFrame<> &frame, const Point<3> &point) const;
  };
} // namespace Nacre

#endif
