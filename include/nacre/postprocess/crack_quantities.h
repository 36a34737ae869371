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
  struct Cuts;

  /**
   * A quantity of the tip of a crack, which is the begin or the end of a cut or
   * a slit of the mesh:
   *
   *   energy release rate of CUT begin|end|tip (point) [radii INNER, OUTER]
   *
   * (force), and K_I, K_II (force/length^(3/2)), K_M, K_T (force length^(1/2))
   * and `kink angle` (degrees, of HoopStress) likewise.
   */
  struct CrackQuantity
  {
    enum class Kind
    {
      energy_release_rate,
      opening,
      sliding,
      bending,
      twisting,
      kink_angle
    };

    /** An end of a cut, by the cut's number. */
    struct CutEnd
    {
      unsigned int cut;
      bool         at_end;
    };

    Kind kind;
    /** None: a slit of the mesh, which ends in the point. */
    std::optional<CutEnd> cut_end = {};
    Point<3>              point   = {};
    /** None: two and six cells at the tip. */
    std::optional<CrackPlateau> plateau = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  const Selection<CrackQuantity::Kind> &selection(CrackQuantity::Kind);

  /**
   * The quantity that a @p phrase begins with the name of, or none. Takes the
   * words of it, and throws for those that are not understood, for a cut that
   * isn't among @p cuts and for laws of the section that don't have it.
   */
  std::optional<CrackQuantity>
  parse_crack_quantity(QuantityPhrase   &phrase,
                       const Cuts       &cuts,
                       const SectionLaw &section,
                       const Constants  &constants);

  /**
   * The tip of the crack. Throws on all ranks if there is none; collective.
   */
  CrackTip
  find_tip_of(const Discretization &discretization,
              const Cuts           &cuts,
              const CrackQuantity  &quantity);

  /** The value; see EnergyRelease for what throws. Collective. */
  double
  evaluate_crack_quantity(const SolvedShell   &shell,
                          const CrackQuantity &quantity);
} // namespace Nacre

#endif
