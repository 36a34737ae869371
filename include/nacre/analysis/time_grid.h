// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_time_grid_h
#define nacre_analysis_time_grid_h

#include <vector>

namespace Nacre
{
  /**
   * Where the steps of a path end: at the multiples of the step asked for, at
   * the times listed, and at the end. Steps that were halved fill the gap up
   * to the next such time; longer ones leave multiples out, but no listed time.
   * Times are the same numbers however the path gets there: nothing is summed.
   */
  class TimeGrid
  {
  public:
    /**
     * @param step asked for, positive
     * @param end of the path, positive
     * @param listed times between 0 and the end, in any order
     */
    TimeGrid(const double               step,
             const double               end,
             const std::vector<double> &listed = {});

    /** Where a step of about the @p size ends that begins at @p time. */
    double
    next(const double time, const double size) const;

    /** Whether @p time is the end, or beyond it. */
    bool
    is_end(const double time) const;

    /** Whether @p time is one of the list. */
    bool
    is_listed(const double time) const;

    /**
     * About how many steps are left from @p time, of which the next has the
     * @p size: halved steps grow again.
     */
    double
    n_steps_left(const double time, const double size) const;

  private:
    /** The last multiple of the step up to @p time, in steps. */
    double
    multiples_until(const double time) const;

    double              step_;
    double              end_;
    std::vector<double> listed_;
    /** Times closer than this are the same. */
    double tolerance_;
  };
} // namespace Nacre

#endif
