// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_state_quantities_h
#define nacre_postprocess_state_quantities_h

#include <nacre/postprocess/point_quantities.h>

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A result of what a section remembers, SectionLaw::state_results():
   * `NAME bottom|middle|top at (point)`, or `largest NAME bottom|middle|top`
   * over the nodes of all cells.
   */
  struct StateQuantity
  {
    /** The index of the name. */
    unsigned int result = 0;
    Face         face   = Face::middle;
    /** None: the largest. */
    std::optional<Point<spacedim>> point = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  /**
   * The quantity that a @p phrase begins with the name of, one of @p names, or
   * none. Throws for words that are not understood.
   */
  std::optional<StateQuantity>
  parse_state_quantity(QuantityPhrase                 &phrase,
                       const std::vector<std::string> &names,
                       const Constants                &constants);

  /** The value; collective. Throws as evaluate_point_quantity(). */
  double
  evaluate_state_quantity(const ShellState    &state,
                          const StateQuantity &quantity);

  /**
   * Integral of SectionLaw::dissipated_energy() over the shell (force times
   * length); collective.
   */
  double
  plastic_dissipation(const ShellState &state);
} // namespace Nacre

#endif
