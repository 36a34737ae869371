// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_energy_ledger_h
#define nacre_analysis_energy_ledger_h

#include <nacre/analysis/shell_system.h>
#include <nacre/analysis/time_integrator.h>
#include <nacre/forms/energy_balance.h>

namespace Nacre
{
  /**
   * Keeps the energy balance of a motion, step by step and for any scheme.
   * With Delta = end - start of a step and means at the middle:
   *
   * external work        f(t_m, u_m) . Delta u, exact for constant dead loads
   *                      and following pressures; and what the strain energy
   *                      changes by as initial strains do: from those of the
   *                      start to those of t_m at the start, and on at the end
   * prescribed motion    reactions at the means of u and v times the change of
   *                      the prescribed displacements, and the moments of the
   *                      supports times that of the prescribed rotations
   * dissipation          c M Delta u . Delta u / Delta t, of mass damping
   * released             -p(t_m) . Delta u of the forces that hold lips
   */
  class EnergyLedger
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** A step that has been taken. */
    struct Step
    {
      double             start_time;
      double             dt;
      const MotionState &start;
      const MotionState &end;
      /** The start's displacement and prescribed rotations. */
      const StepStart &step_start;
      /** Whether the internal forces were the energy-momentum ones. */
      bool conserves;
    };

    /** @param damping c (1/time) */
    EnergyLedger(ShellSystem     &system,
                 const MassTerms &mass,
                 const double     damping);

    /**
     * The balance of the state at the start; collective.
     * @param dt size of steps; what moves by less than 1e-10 of the shell's
     *   size in one of them counts as round-off
     */
    EnergyBalance
    start(const MotionState &motion, const double dt) const;

    /**
     * The balance of a motion that goes on with longer cuts; collective.
     * @param dt as of start()
     */
    EnergyBalance
    after_cut(const EnergyBalance &before,
              const MotionState   &motion,
              const double         dt) const;

    /**
     * The balance after a @p step. Leaves the loads of the middle of the step
     * and the prescribed rotations of its end. Collective.
     */
    EnergyBalance
    after_step(const EnergyBalance &before, const Step &step) const;

  private:
    double
    kinetic_energy(const Vector &v) const;

    /**
     * Work of the forces at prescribed displacements. @param mean ghosted mean
     * displacement
     */
    double
    reaction_work(const Step &step, const Vector &mean) const;

    /**
     * Work of initial strains that change, with the loads and rotations set
     * that after_step() leaves.
     * @param strain_change of the energy, from the start to the end
     * @param end ghosted displacement
     */
    double
    initial_strain_work(const Step   &step,
                        const double  strain_change,
                        const Vector &end) const;

    ShellSystem     &system_;
    const MassTerms &mass_;
    const double     damping_;
  };
} // namespace Nacre

#endif
