// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_energy_balance_h
#define nacre_forms_energy_balance_h

namespace Nacre
{
  /**
   * Energies of a motion, and what has been put in and taken out since its
   * start (force times length).
   */
  struct EnergyBalance
  {
    /** Whether it is kept: in dynamics only. */
    bool is_kept = false;

    /** @name Now */
    //@{
    double kinetic = 0.;
    double strain  = 0.;
    //@}

    /** @name Since the start */
    //@{
    /** Kinetic and strain energy at the start. */
    double initial = 0.;
    /** Work of loads, gravity, pressure and changes of initial strains. */
    double external_work = 0.;
    /** Work of the reactions at prescribed displacements and rotations. */
    double prescribed_work = 0.;
    /** Taken out by mass damping. */
    double dissipation = 0.;
    /**
     * Taken out where cuts have grown: by the forces of lips that are being
     * released, and at the moment of a cut, as membrane strains change there.
     */
    double released = 0.;
    /** Largest of all of these, at least what is round-off for sure. */
    double largest = 0.;
    //@}

    /**
     * What the step sizes and the scheme have added, or, if negative, taken:
     * zero for a scheme that conserves energy.
     */
    double
    gain() const
    {
      return kinetic + strain + dissipation + released - initial -
             external_work - prescribed_work;
    }

    /** The same as a part of the largest energy. */
    double
    relative_gain() const
    {
      return largest > 0. ? gain() / largest : 0.;
    }
  };
} // namespace Nacre

#endif
