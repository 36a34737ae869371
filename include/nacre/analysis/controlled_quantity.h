// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_controlled_quantity_h
#define nacre_analysis_controlled_quantity_h

#include <nacre/analysis/shell_system.h>

#include <cmath>
#include <functional>

namespace Nacre
{
  /** The quantity Q(u, t) that displacement control prescribes. */
  struct ControlledQuantity
  {
    using Vector = ShellSystem::Vector;

    /** A derivative, and by how much it may be wrong. */
    struct Slope
    {
      double value = 0.;
      double error = 0.;

      bool
      is_known() const
      {
        return std::abs(value) > error;
      }
    };

    struct Value
    {
      /** Q */
      double value = 0.;
      /** Q,u . v along a vector v of owned entries; collective. */
      std::function<Slope(const Vector &v)> slope;
      /** Q,t, the displacement held. */
      double rate = 0.;
    };

    /** At owned entries u and the time t; collective. */
    std::function<Value(const Vector &u, const double time)> evaluate;
    /** Q is known up to multiples of it, as an angle is; 0: it is unique. */
    double period = 0.;
    /** Share of a step to which Q reaches its values. */
    double accuracy = 1e-9;

    /** From @p start to @p end, the shortest way if there is a period. */
    double
    change(const double start, const double end) const
    {
      return period > 0. ? std::remainder(end - start, period) : end - start;
    }

    /** Q whose @p gradient is Q,u. */
    static Value
    with_gradient(const double  value,
                  const Vector &gradient,
                  const double  rate = 0.);

    /**
     * Any Q(u, t), by differences. Those along v are taken on its side, for Q
     * may have a kink at u, as the size of a stress has at zero:
     *
     *   Q,u . v = (4 Q(u + s v) - Q(u + 2 s v) - 3 Q(u)) / (2 s),
     *
     * s v being of the size @p reach (length), for the largest entry. What
     * this may be wrong by is ten times that by which the differences over s
     * and 2 s differ. Where that is all of it, Q has no slope, or a metal
     * yields within the reach: a tenth of it is tried, down to a thousandth.
     *
     * @param evaluate Q(u, t); collective
     * @param dt the differences in t are taken over it to both sides
     */
    static Value
    by_differences(
      const std::function<double(const Vector &u, const double t)> &evaluate,
      const Vector                                                 &u,
      const double                                                  time,
      const double                                                  reach,
      const double                                                  dt);
  };
} // namespace Nacre

#endif
