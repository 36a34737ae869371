// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/step_control.h>

#include <algorithm>

namespace Nacre
{
  StepControl::StepControl(const double       minimum,
                           const double       maximum,
                           const unsigned int max_iterations)
    : minimum_(minimum)
    , maximum_(maximum)
    , max_iterations_(max_iterations)
  {}

  bool
  StepControl::reject(StepSize &size, const double dt) const
  {
    size.next_step    = 0.5 * dt;
    size.n_good_steps = 0;
    return !(size.next_step < minimum_);
  }

  void
  StepControl::accept(StepSize &size, const unsigned int n_iterations) const
  {
    if (n_iterations > max_iterations_ / 2)
      size.n_good_steps = 0;
    else
      ++size.n_good_steps;
    if (size.n_good_steps >= 2 && size.next_step < maximum_)
      {
        size.next_step    = std::min(2. * size.next_step, maximum_);
        size.n_good_steps = 0;
      }
  }
} // namespace Nacre
