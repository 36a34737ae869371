// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_arc_length_step_h
#define nacre_analysis_arc_length_step_h

#include <nacre/analysis/controlled_quantity.h>

namespace Nacre
{
  /**
   * A step along the curve (u(s), t(s)) of equilibria r(u, t) = 0, whose time t
   * isn't prescribed: loads and prescribed displacements are those of t, which
   * rises and falls. The step ends in a plane,
   *
   *   K du = -r - r,t dt,   n . (u + du - u_0) = d,
   *
   * u_0 being the displacement at the start. With n the tangent of the curve
   * there, this is the arc-length method with the normal plane (E. Riks, An
   * incremental approach to the solution of snapping and buckling problems,
   * Int. J. Solids Structures 15 (1979) 529-551). Or it ends where a quantity
   * Q(u, t) has a value q,
   *
   *   K du = -r - r,t dt,   Q,u . du + Q,t dt = q - Q(u, t):
   *
   * for a displacement, which is linear, this is displacement control (J.-L.
   * Batoz, G. Dhatt, Incremental displacement algorithms for nonlinear
   * problems, Int. J. Numer. Meth. Engng 14 (1979) 1262-1267). Both right-hand
   * sides share a factorisation, so that K may be singular in between.
   */
  class ArcLengthStep
  {
  public:
    using Vector = ShellSystem::Vector;

    /**
     * @param u in equilibrium at @p time
     * @param rate_step for ShellSystem::rate()
     */
    ArcLengthStep(ShellSystem  &system,
                  const Vector &u,
                  const double  time,
                  const double  rate_step);

    /**
     * To the plane normal to the tangent.
     * @param direction a vector on whose side the step goes; zero: t rises
     * @param length |du| of the step (length), sum over all dofs; for a
     *   direction of zero the change of t, whose sign may be negative
     */
    void
    go_along_tangent(const Vector &direction, const double length);

    /** To where @p quantity, which must live as long, has the @p value. */
    void
    go_to_value(const ControlledQuantity &quantity, const double value);

    /** To the plane where @p normal . u has changed by @p distance. */
    void
    go_to_plane(const Vector &normal, const double distance);

    /**
     * To the plane through the end of @p mode (length), normal to it, from
     * there: at a bifurcation point the mode of the tangent leads to the other
     * branch, at about the same time.
     */
    void
    go_along_mode(const Vector &mode);

    /**
     * Solve for the end of the step. Fails as NewtonSolver does, if the
     * quantity doesn't change along the curve, and if the curve turns by more
     * than 60 degrees within the step, which may have jumped to another curve
     * then.
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

    /** dt/ds, s = normal . u of the plane (length^2) or Q, at the end. */
    double
    end_rate() const
    {
      return end_rate_;
    }

    /**
     * Whether t turns within the step: 1, it rises, then falls; -1, it falls,
     * then rises; 0, neither, or a step along a mode.
     */
    int
    turn() const
    {
      return start_rate_ * end_rate_ < 0. ? (start_rate_ > 0. ? 1 : -1) : 0;
    }

    /** du of the first iteration, or the mode (length). */
    const Vector &
    predictor() const
    {
      return predictor_;
    }

  private:
    NewtonSolver::Step
    linearise(const Vector &u, Vector &du);

    /**
     * By how much Q, or normal . u, must still change at @p u. Sets what is
     * found there.
     */
    double
    distance_left(const Vector &u);

    /** Why the end of the step can't be found along the curve. */
    StepFailure
    no_tangent() const;

    /** The plane of the tangent, whose velocity is du/dt. */
    void
    set_tangent_plane(const Vector &velocity);

    ShellSystem  &system_;
    const Vector  start_;
    const double  start_time_;
    const double  rate_step_;
    const Vector *direction_ = nullptr;
    double        length_    = 0.;
    /** With the value that it shall have. */
    const ControlledQuantity *quantity_ = nullptr;
    double                    value_    = 0.;
    /** Q or normal . (u - u_0) at the last u. */
    ControlledQuantity::Value found_;
    /** Of the plane; empty before it is known. */
    Vector normal_;
    double distance_ = 0.;
    Vector u_;
    double time_;
    Vector predictor_;
    bool   is_first_   = true;
    double start_rate_ = 0.;
    double end_rate_   = 0.;
  };
} // namespace Nacre

#endif
