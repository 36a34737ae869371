// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_quantities_h
#define nacre_simulation_path_quantities_h

#include <nacre/analysis/controlled_quantity.h>
#include <nacre/analysis/path_state.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/discrete_shell.h>

#include <string>

namespace Nacre
{
  /**
   * Throw if `Analysis/Stop where` or `Control` names a quantity that isn't
   * among @p quantities, or `Control` one that no displacement makes, or, a
   * rotation, none of these @p kinematics.
   */
  void
  check_path_quantities(const PathParameters       &path,
                        const QuantitiesOfInterest &quantities,
                        const KinematicsModel       kinematics);

  /**
   * The quantity that `Control` names, of a @p shell with its @p system that
   * must live as long. The derivatives of displacements, rotations and
   * reactions are exact, those of all others differences
   * (ControlledQuantity::by_differences()) over a thousandth of the thickness.
   * Where the section remembers, the quantity is that of the states that the
   * displacement would leave at the end of a step. Throws if it can't be taken
   * there. Collective.
   */
  ControlledQuantity
  controlled_quantity(const QuantitiesOfInterest &quantities,
                      const DiscreteShell        &shell,
                      ShellSystem                &system);

  /**
   * The first bound of `Stop where` that holds at @p state of the @p shell, in
   * words; or "". Collective.
   */
  std::string
  reached_bound(const PathParameters       &path,
                const QuantitiesOfInterest &quantities,
                const PathState            &state,
                const SolvedShell          &shell);
} // namespace Nacre

#endif
