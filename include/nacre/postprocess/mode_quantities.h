// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_mode_quantities_h
#define nacre_postprocess_mode_quantities_h

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /** The eigenvalues that a buckling or vibration analysis has found. */
  struct ModeValues
  {
    /**
     * Load factors, by ascending size; or angular frequencies omega
     * (1/time), those of unstable modes negative, -sqrt(-omega^2).
     */
    std::vector<double> values;
    /** How many are (nearly) the same, of each. */
    std::vector<unsigned int> multiplicities;
    bool                      are_frequencies = false;
    /** Number of the first one less 1: modes below the range. */
    unsigned int n_below = 0;
    /** Leading modes that are rigid motions. */
    unsigned int n_rigid = 0;
  };

  /** What of a mode is reported. */
  struct ModeQuantity
  {
    enum class Kind
    {
      omega,
      frequency,
      load_factor,
      multiplicity
    };
    Kind kind;
    /** Counted from 1. */
    unsigned int mode = 1;
    /** The parameter, for messages. */
    std::string where = {};
  };

  /** The words of ModeQuantity::Kind, for messages. */
  std::vector<std::string>
  mode_quantity_names();

  /**
   * "omega 3", "frequency 3", "load factor 1", "multiplicity 1"; none if
   * @p text begins with another word. Throws for a number that isn't positive.
   */
  std::optional<ModeQuantity>
  parse_mode_quantity(const std::string &text, const std::string &where);

  /**
   * The value; throws if the analysis has no such modes (null), or too few.
   */
  double
  evaluate_mode_quantity(const ModeValues *modes, const ModeQuantity &quantity);
} // namespace Nacre

#endif
