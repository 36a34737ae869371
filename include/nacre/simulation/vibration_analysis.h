// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_vibration_analysis_h
#define nacre_simulation_vibration_analysis_h

#include <nacre/forms/mass_terms.h>
#include <nacre/simulation/mode_analysis.h>

namespace Nacre
{
  /**
   * Natural vibration: angular frequencies omega (1/time) and modes u of
   *
   *   (K + G) u = omega^2 M u
   *
   * with the stiffness K of the undeformed shell, the consistent mass M, and G
   * of the Prestress at t = 1, if there is any.
   */
  class VibrationAnalysis : public ModeAnalysis
  {
  public:
    using ModeAnalysis::ModeAnalysis;

    std::string
    name() const override
    {
      return "vibration problem";
    }

  protected:
    void
    check_problem(DiscreteShell   &shell,
                  const Prestress &prestress) const override;

    Modes
    find_modes(DiscreteShell &shell, const Prestress &prestress) const override;

    std::string
    value_name() const override
    {
      return "omega";
    }

  private:
    /** M with the constraints eliminated, in the pattern of @p K. */
    void
    assemble_mass(const MassTerms                 &mass,
                  const AffineConstraints<double> &constraints,
                  const DiscreteShell             &shell,
                  Matrix                          &M) const;

    /** A shift (1/time^2) below all omega^2, of the size of the lowest ones. */
    double
    lowest_shift(const DiscreteShell &shell, Eigenproblem &problem) const;

    /** Set omega, multiplicities and remarks from omega^2. */
    void
    describe(const DiscreteShell             &shell,
             const MassTerms                 &mass,
             const Matrix                    &K,
             const AffineConstraints<double> &constraints,
             const Spectrum                  &spectrum,
             Modes                           &modes) const;
  };
} // namespace Nacre

#endif
