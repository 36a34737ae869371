// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/surface_projection.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Nacre
{
  SurfaceProjection::SurfaceProjection(SurfaceDescription &&surface,
                                       const std::string   &where)
    : surface_(std::move(surface), where)
    , where_(where)
  {
    const unsigned int n = 6;
    for (unsigned int k = 0; k < surface_.cells().size(); ++k)
      for (unsigned int i = 0; i < n * n; ++i)
        {
          const Point<2> unit((i % n + 0.5) / n, (i / n + 0.5) / n);
          samples_.push_back({k, unit, surface_.position(k, unit)});
        }
  }


  /** By differences of the fourth order, good to 1e-12. */
  std::array<Tensor<1, 3>, 2>
  SurfaceProjection::tangents(const unsigned int cell,
                              const Point<2>    &unit) const
  {
    const double                step = 2e-3;
    std::array<Tensor<1, 3>, 2> result;
    for (unsigned int a = 0; a < 2; ++a)
      {
        const auto difference = [&](const double h) {
          Point<2> forward = unit, backward = unit;
          forward[a] += h;
          backward[a] -= h;
          return surface_.position(cell, forward) -
                 surface_.position(cell, backward);
        };
        result[a] =
          (8. * difference(step) - difference(2. * step)) / (12. * step);
      }
    return result;
  }


  /** Gauss-Newton in the coordinates of the coarse cell that is nearest. */
  Point<3>
  SurfaceProjection::operator()(const Point<3> &point) const
  {
    const auto start =
      std::min_element(samples_.begin(),
                       samples_.end(),
                       [&](const auto &a, const auto &b) {
                         return (point - a.position).norm_square() <
                                (point - b.position).norm_square();
                       });
    Point<2> unit = start->unit;
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        const auto         t = tangents(start->cell, unit);
        const Tensor<1, 3> difference =
          point - surface_.position(start->cell, unit);
        const double a_11 = t[0] * t[0], a_22 = t[1] * t[1], a_12 = t[0] * t[1];
        const double b_1 = t[0] * difference, b_2 = t[1] * difference;
        const double det = a_11 * a_22 - a_12 * a_12;
        const Point<2> change((a_22 * b_1 - a_12 * b_2) / det,
                              (a_11 * b_2 - a_12 * b_1) / det);
        if (!std::isfinite(change.norm()))
          break;
        // Far steps leave the part where the tangents mean something.
        const double length = change.norm();
        unit += (length > 0.5 ? 0.5 / length : 1.) * change;
        if (length < 1e-12)
          return surface_.position(start->cell, unit);
      }
    std::ostringstream text;
    text << where_ << ": the point (" << point[0] << ", " << point[1] << ", "
         << point[2] << ") of the mesh can't be projected onto this surface.";
    AssertThrow(false, ExcMessage(text.str()));
    return point;
  }
} // namespace Nacre
