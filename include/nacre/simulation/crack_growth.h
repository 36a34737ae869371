// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_crack_growth_h
#define nacre_simulation_crack_growth_h

#include <nacre/discretization/cut_growth.h>
#include <nacre/postprocess/shell_state.h>
#include <nacre/simulation/shell_problem.h>
#include <nacre/simulation/stress_criterion.h>

#include <array>
#include <string>
#include <vector>

namespace Nacre
{
  class Log;

  /** An end of a cut that grows. */
  struct GrowingTip
  {
    /** "tear end" */
    std::string name;
    Growth::Tip end;
    /** Whether it is still a tip that may advance. */
    bool is_alive = true;
    /** Length by which it has advanced, along the surface (length). */
    double advanced = 0.;
    /** @name As CrackGrowth::observe() has found them */
    //@{
    Point<spacedim> position;
    /** Of the next step (length). */
    double step = 0.;
    /** G (force), where the criterion asks for it. */
    double rate = 0.;
    /** CrackTip::closed (length). */
    double closed = 0.;
    /** TipRelease::intensities, if they are known. */
    bool                  has_intensities = false;
    std::array<double, 4> intensities{{0., 0., 0., 0.}};
    /** G/(G_c h), or the averaged stress over the strength (1). */
    double drive = 0.;
    /** Of the next step, from ahead to t0 x ahead (rad). */
    double angle = 0.;
    //@}
  };

  /** The cuts that growth has made, and what it knows of their tips. */
  struct GrowthState
  {
    /** All of the shell. */
    std::vector<CutCurve>   curves;
    std::vector<GrowingTip> tips;
    /** CrackGrowth::starts() */
    std::vector<CrackStart> starts;
    /** Cracks that have started. */
    unsigned int n_started = 0;
    unsigned int n_steps   = 0;
  };

  /**
   * Which tips of a problem's cuts advance, and whereto: doc/growth.md. It
   * lengthens the cuts of the problem; who solves discretises anew.
   */
  class CrackGrowth
  {
  public:
    /** @p problem must live as long */
    CrackGrowth(ShellProblem &problem, Log &log);

    bool
    is_on() const
    {
      return problem_.growth.is_on();
    }

    /** Throws for an end that is no tip on @p discretization. */
    void
    check(const Discretization &discretization) const;

    /** Look at the tips of a solution. Collective. */
    void
    observe(const SolvedShell &shell);

    /**
     * In linear analyses: the factor of all loads and prescribed values at
     * which the first tip advances, (largest_drive())^-1/2 by energy,
     * 1/largest_drive() by strength, 1 if growth is prescribed. Throws if
     * loads don't open anything.
     */
    double
    critical_factor() const;

    /** All loads and prescribed values take a factor. */
    void
    scale(const double factor);

    const std::vector<GrowingTip> &
    tips() const
    {
      return tips_;
    }

    /** Where cracks would start next, as observe() has found it. */
    const std::vector<CrackStart> &
    starts() const
    {
      return starts_;
    }

    /** Steps so far. */
    unsigned int
    n_steps() const
    {
      return n_steps_;
    }

    /** Whether there are tips that may advance, or start. */
    bool
    has_tips() const;

    /** Whether none is left, or all steps are taken. */
    bool
    has_ended() const
    {
      return !has_tips() || n_steps_ >= problem_.growth.maximum_steps;
    }

    /** The largest GrowingTip::drive or CrackStart::drive (1). */
    double
    largest_drive() const;

    /** Whether tips advance by what observe() has found, at @p time. */
    bool
    is_due(const double time) const;

    /**
     * Lengthen the cuts by a step: of the tips that are the first to advance,
     * or of all that are behind the prescribed length at @p time. Tells what
     * happens. Collective.
     * @param takes_all whether a prescribed length doesn't matter
     */
    void
    advance(const Discretization &discretization,
            const double          time,
            const bool            takes_all);

    /** Take back the last step: the cuts and tips are those before it. */
    void
    undo()
    {
      set_state(before_);
    }

    /** The cuts of now, and what is known of their tips. */
    GrowthState
    state() const;

    /**
     * Go on from the state @p then of a run whose cuts began as those of now;
     * throws if they didn't.
     */
    void
    resume(const GrowthState &then);

  private:
    void
    set_state(const GrowthState &state);

    CutTrace::Tip
    find(const Discretization &discretization, const GrowingTip &tip) const;

    bool
    is_behind(const GrowingTip &tip, const double time) const;

    /** How many cracks may start still. */
    unsigned int
    n_starts_left() const
    {
      return problem_.growth.starting_cracks - n_started_;
    }

    void
    measure_energy(const SolvedShell   &shell,
                   const CutTrace::Tip &end,
                   GrowingTip          &tip) const;

    void
    measure_stress(const SolvedShell   &shell,
                   const CutTrace::Tip &end,
                   GrowingTip          &tip) const;

    /** Tell, as "growth step 1: TEXT". */
    void
    tell(const std::string &text) const;

    void
    advance_tip(const Discretization &discretization, GrowingTip &tip);

    /** Add the cut of a crack that starts, and its tips. Collective. */
    void
    start(const Discretization &discretization, const CrackStart &place);

    double
    chosen_angle(const Discretization &discretization,
                 const CutTrace::Tip  &end,
                 const GrowingTip     &tip,
                 const double          time) const;

    ShellProblem           &problem_;
    Log                    &log_;
    std::vector<GrowingTip> tips_;
    std::vector<CrackStart> starts_;
    unsigned int            n_started_ = 0;
    unsigned int            n_steps_   = 0;
    /** The last step. */
    GrowthState before_;
  };

  /** Throws for analyses that can't lengthen the cuts of @p problem. */
  void
  check_growth(const ShellProblem &problem);
} // namespace Nacre

#endif
