// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_shell_state_h
#define nacre_postprocess_shell_state_h

#include <nacre/discretization/discretization.h>
#include <nacre/forms/energy_balance.h>
#include <nacre/forms/kinematics.h>
#include <nacre/problem/shell_model.h>

#include <deal.II/lac/trilinos_vector.h>

namespace Nacre
{
  class DisplacementConditions;
  class MassTerms;
  class Assembly;
  class SectionStates;
  struct ModeValues;
  struct ShellActions;

  /** A shell on a mesh with its displacement, as fields and stresses see it. */
  struct ShellState
  {
    const Discretization &discretization;
    const ShellModel     &model;
    /** Ghosted displacement (length). */
    const TrilinosWrappers::MPI::Vector &displacement;
    /** Of the section's initial strains; of modes: none. */
    Instant instant = {0., 0.};
    /** Of a section with memory; null: all points are at rest. */
    const SectionStates *section_states = nullptr;

    /** The section as stresses see it. */
    SectionAt
    section() const
    {
      return {*model.section, instant};
    }
  };

  /** The same with its forces and its motion, as quantities see it. */
  struct SolvedShell : ShellState
  {
    const Assembly     &assembly;
    const ShellActions &actions;
    /** Which nodes are held: the same at all times. */
    const DisplacementConditions &conditions;
    /** K u - f (force) without constraints. */
    const TrilinosWrappers::MPI::Vector &residual;
    const Energies                       energies;
    /** @name Motion in time: null in statics */
    //@{
    const MassTerms                     *mass     = nullptr;
    const TrilinosWrappers::MPI::Vector *velocity = nullptr;
    /** a + c v with mass damping c, ghosted (length/time^2). */
    const TrilinosWrappers::MPI::Vector *acceleration = nullptr;
    EnergyBalance                        balance      = {};
    //@}
    /** Of buckling and vibration; else null. */
    const ModeValues *modes = nullptr;
  };
} // namespace Nacre

#endif
