// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/controlled_quantity.h>

namespace Nacre
{
  ControlledQuantity::Value
  ControlledQuantity::with_gradient(const double  value,
                                    const Vector &gradient,
                                    const double  rate)
  {
    const auto slope = [gradient](const Vector &v) -> Slope {
      return {gradient * v, 1e-12 * gradient.l2_norm() * v.l2_norm()};
    };
    return {value, slope, rate};
  }

  ControlledQuantity::Value
  ControlledQuantity::by_differences(
    const std::function<double(const Vector &u, const double t)> &evaluate,
    const Vector                                                 &u,
    const double                                                  time,
    const double                                                  reach,
    const double                                                  dt)
  {
    const double here = evaluate(u, time);
    const auto   over = [=](const double s, const Vector &v) -> Slope {
      const auto change = [&](const double distance) {
        Vector end(u);
        end.add(distance, v);
        return (evaluate(end, time) - here) / distance;
      };
      const double near = change(s), far = change(2. * s);
      return {2. * near - far, 10. * std::abs(near - far)};
    };
    const auto slope = [=](const Vector &v) -> Slope {
      const double size = v.linfty_norm();
      if (size == 0.)
        return {};
      Slope found;
      for (const double share : {1., 0.1, 0.01, 0.001})
        if (!found.is_known())
          found = over(share * reach / size, v);
      return found;
    };
    return {here,
            slope,
            (evaluate(u, time + dt) - evaluate(u, time - dt)) / (2. * dt)};
  }
} // namespace Nacre
