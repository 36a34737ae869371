// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_step_control_h
#define nacre_analysis_step_control_h

namespace Nacre
{
  /** What the size of a path's next step follows from. Units: of time. */
  struct StepSize
  {
    double next_step = 0.;
    /** Good steps since the last change of size. */
    unsigned int n_good_steps = 0;
  };

  /**
   * Adapts the steps of a path: a step that fails is halved; after two good
   * steps, which took at most half of the iterations that are allowed, the next
   * one is twice as long.
   */
  class StepControl
  {
  public:
    /**
     * @param minimum,maximum size of a step (time); a first step beyond the
     *   maximum is kept, but doesn't grow
     * @param max_iterations that a step may take
     */
    StepControl(const double       minimum,
                const double       maximum,
                const unsigned int max_iterations);

    /**
     * A step of size @p dt has failed. Returns whether half of it may be
     * tried, which is the next step in either case.
     */
    bool
    reject(StepSize &size, const double dt) const;

    /** A step has converged within @p n_iterations. */
    void
    accept(StepSize &size, const unsigned int n_iterations) const;

  private:
    const double       minimum_;
    const double       maximum_;
    const unsigned int max_iterations_;
  };
} // namespace Nacre

#endif
