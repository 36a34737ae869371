// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/time_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Nacre
{
  namespace
  {
    /** A rest of a step that is not worth a step of its own. */
    constexpr double sliver = 1e-3;
  } // namespace

  TimeGrid::TimeGrid(const double               step,
                     const double               end,
                     const std::vector<double> &listed)
    : step_(step)
    , end_(end)
    , listed_(listed)
    // Far below a step, but above the rounding of the largest time.
    , tolerance_(std::max(1e-10 * std::min(step, end),
                          8. * std::numeric_limits<double>::epsilon() * end))
  {
    std::sort(listed_.begin(), listed_.end());
  }

  double
  TimeGrid::multiples_until(const double time) const
  {
    return std::floor((time + tolerance_) / step_);
  }

  double
  TimeGrid::next(const double time, const double size) const
  {
    const double ahead = (multiples_until(time) + 1.) * step_;
    double       until = time + size;
    if (until > ahead - sliver * size)
      until = std::max(ahead, multiples_until(until) * step_);
    auto stop =
      std::upper_bound(listed_.begin(), listed_.end(), time + tolerance_);
    const double required =
      stop == listed_.end() ? end_ : std::min(*stop, end_);
    return until > required - sliver * size ? required : until;
  }

  bool
  TimeGrid::is_end(const double time) const
  {
    return time >= end_ - tolerance_;
  }

  bool
  TimeGrid::is_listed(const double time) const
  {
    const auto near =
      std::lower_bound(listed_.begin(), listed_.end(), time - tolerance_);
    return near != listed_.end() && *near <= time + tolerance_;
  }

  double
  TimeGrid::n_steps_left(const double time, const double size) const
  {
    const double usual = std::max(size, step_);
    // After two good steps the size doubles.
    return std::ceil((end_ - time) / usual - sliver) +
           2. * std::log2(usual / size);
  }
} // namespace Nacre
