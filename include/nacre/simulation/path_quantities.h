// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_quantities_h
#define nacre_simulation_path_quantities_h

#include <nacre/analysis/controlled_quantity.h>
#include <nacre/analysis/path_state.h>
#include <nacre/postprocess/quantities_of_interest.h>

#include <string>

namespace Nacre
{
  /**
   * Throw if `Analysis/Stop where` or `Control` names a quantity that isn't
   * among @p quantities, or `Control` one whose gradient isn't known under
   * these @p kinematics.
   */
  void
  check_path_quantities(const PathParameters       &path,
                        const QuantitiesOfInterest &quantities,
                        const KinematicsModel       kinematics);

  /**
   * The quantity that `Control` names, of a shell that must live as long.
   * Throws if it can't be taken there. Collective.
   */
  ControlledQuantity
  controlled_quantity(const PathParameters         &path,
                      const QuantitiesOfInterest   &quantities,
                      ShellSystem                  &system,
                      const Discretization         &discretization,
                      const DisplacementConditions &conditions);

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
