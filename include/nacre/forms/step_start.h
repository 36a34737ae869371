// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_step_start_h
#define nacre_forms_step_start_h

#include <nacre/forms/shell_actions.h>

#include <deal.II/lac/trilinos_vector.h>

namespace Nacre
{
  /**
   * Where a step begins whose internal forces are the energy-momentum ones,
   * Kinematics::add_cell_step_terms() and its like.
   */
  struct StepStart
  {
    /** Displacement (length), ghosted. */
    dealii::TrilinosWrappers::MPI::Vector u;
    PrescribedRotations                   rotations;
  };
} // namespace Nacre

#endif
