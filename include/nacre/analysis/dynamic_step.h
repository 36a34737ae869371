// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_dynamic_step_h
#define nacre_analysis_dynamic_step_h

#include <nacre/analysis/energy_ledger.h>
#include <nacre/analysis/path_parameters.h>
#include <nacre/analysis/shell_system.h>
#include <nacre/solvers/anderson_mixing.h>

namespace Nacre
{
  /** One step in time by a TimeIntegrator. */
  class DynamicStep
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** A step of @p dt from @p start at @p time; collective. */
    DynamicStep(ShellSystem          &system,
                const MassTerms      &mass,
                const TimeIntegrator &integrator,
                const PathParameters &parameters,
                const MotionState    &start,
                const double          time,
                const double          dt);

    /** Solve the equation of motion, with a line search or without. */
    NewtonSolver::Result
    solve(const bool search);

    /** The state at the end, after solve(). */
    MotionState
    end() const
    {
      return integrator_.end_state(start_, u_f_, dt_);
    }

    /** The energy balance at the @p end; collective. */
    EnergyBalance
    balance(const EnergyLedger  &ledger,
            const EnergyBalance &before,
            const MotionState   &end) const;

  private:
    /** w of u_f, ghosted. */
    Vector
    inertia(const Vector &u_f) const;

    /** The inertial forces M w. */
    Inertia
    terms(const Vector &w) const;

    NewtonSolver::Step
    linearise(const Vector &u_f, Vector &du);

    /**
     * Energy-momentum forces have an unsymmetric derivative, which the tangent
     * is not: new ones make the iteration no faster once it is near. So their
     * increments are mixed, with a tangent that is kept while it serves.
     */
    void
    mix(const Vector &u_f, Vector &du);

    ShellSystem          &system_;
    const MassTerms      &mass_;
    const TimeIntegrator &integrator_;
    const PathParameters &parameters_;
    const MotionState    &start_;
    const double          time_;
    const double          dt_;
    const bool            conserves_;
    /** Displacement and prescribed rotations at the start. */
    StepStart step_start_;
    Vector    u_f_;

    bool           mixes_ = false;
    AndersonMixing mixing_;
    /** The next iterations that take a new tangent. */
    unsigned int n_new_tangents_ = 0;
    /** The last increment before mixing. */
    double last_increment_ = 0.;
  };
} // namespace Nacre

#endif
