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

    struct Value
    {
      /** Q */
      double value = 0.;
      /** Q,u */
      Vector gradient;
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
  };
} // namespace Nacre

#endif
