// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_controlled_quantity_h
#define nacre_analysis_controlled_quantity_h

#include <nacre/analysis/shell_system.h>

#include <cmath>
#include <functional>
#include <utility>

namespace Nacre
{
  /** The quantity Q(u) that displacement control prescribes. */
  struct ControlledQuantity
  {
    using Vector = ShellSystem::Vector;

    /** Q and its gradient at owned entries u; collective. */
    std::function<std::pair<double, Vector>(const Vector &u)> evaluate;
    /** Q is known up to multiples of it, as an angle is; 0: it is unique. */
    double period = 0.;

    /** From @p start to @p end, the shortest way if there is a period. */
    double
    change(const double start, const double end) const
    {
      return period > 0. ? std::remainder(end - start, period) : end - start;
    }
  };
} // namespace Nacre

#endif
