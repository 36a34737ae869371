// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_arc_length_step_h
#define nacre_analysis_arc_length_step_h

#include <nacre/analysis/shell_system.h>

namespace Nacre
{
  /**
   * A step along the curve (u(s), t(s)) of equilibria r(u, t) = 0, whose time t
   * isn't prescribed: loads and prescribed displacements are those of t, which
   * rises and falls. Newton's method with the normal plane of the predictor
   * (E. Riks, An incremental approach to the solution of snapping and buckling
   * problems, Int. J. Solids Structures 15 (1979) 529-551):
   *
   *   K du = -r - r,t dt,   n . du = 0 after the first iteration,
   *
   * n = du/ds the unit tangent of the curve at the start. Both right-hand sides
   * share a factorisation, so that K may be singular in between.
   */
  class ArcLengthStep
  {
  public:
    using Vector = ShellSystem::Vector;

    /**
     * @param u in equilibrium at @p time
     * @param direction a vector on whose side the step goes; zero: t rises
     * @param length |du| of the step (length), sum over all dofs; for a
     *   direction of zero the change of t
     * @param rate_step for ShellSystem::rate()
     */
    ArcLengthStep(ShellSystem  &system,
                  const Vector &u,
                  const double  time,
                  const Vector &direction,
                  const double  length,
                  const double  rate_step);

    /**
     * Begin with @p predictor (length) instead, at the same time: at a
     * bifurcation point the mode of the tangent leads to the other branch.
     */
    void
    set_predictor(const Vector &predictor);

    /**
     * Solve for the end of the step. Fails as NewtonSolver does, and if the
     * curve turns by more than 60 degrees within the step, which may have
     * jumped to another curve then.
     */
    NewtonSolver::Result
    solve(const NewtonSolver::Parameters &parameters);

    /** The displacement at the end (length). */
    const Vector &
    displacement() const
    {
      return u_;
    }

    double
    time() const
    {
      return time_;
    }

    /** du of the first iteration: along the tangent at the start (length). */
    const Vector &
    predictor() const
    {
      return predictor_;
    }

  private:
    NewtonSolver::Step
    linearise(const Vector &u, Vector &du);

    ShellSystem  &system_;
    const Vector  start_;
    const double  start_time_;
    const Vector &direction_;
    const double  length_;
    const double  rate_step_;
    Vector        u_;
    double        time_;
    Vector        predictor_;
    bool          has_predictor_ = false;
  };
} // namespace Nacre

#endif
