// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_quantities_h
#define nacre_postprocess_crack_quantities_h

#include <nacre/base/selection.h>
#include <nacre/postprocess/energy_release.h>
#include <nacre/postprocess/quantity_phrase.h>

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A quantity of the tip of a crack:
   *
   *   energy release rate of tip (point) [radii INNER, OUTER]
   *
   * (force), and K_I, K_II (force/length^(3/2)), K_M, K_T (force length^(1/2))
   * likewise.
   */
  struct CrackQuantity
  {
    enum class Kind
    {
      energy_release_rate,
      opening,
      sliding,
      bending,
      twisting
    };

    Kind     kind;
    Point<3> tip = {};
    /** None: two and six cells at the tip. */
    std::optional<CrackPlateau> plateau = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  const Selection<CrackQuantity::Kind> &selection(CrackQuantity::Kind);

  /**
   * The quantity that a @p phrase begins with the name of, or none. Takes the
   * words of it, and throws for those that are not understood.
   */
  std::optional<CrackQuantity>
  parse_crack_quantity(QuantityPhrase &phrase, const Constants &constants);

  /** The value; see EnergyRelease for what throws. Collective. */
  double
  evaluate_crack_quantity(const SolvedShell   &shell,
                          const CrackQuantity &quantity);
} // namespace Nacre

#endif
