// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_growth_h
#define nacre_discretization_cut_growth_h

#include <nacre/discretization/discretization.h>
#include <nacre/problem/cuts.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * The axes at a tip: e_1 ahead, e_2 = t0 x e_1, e_3 = t0, the normal of the
   * surface. Collective.
   */
  std::array<Tensor<1, spacedim>, 3>
  tip_axes(const Discretization &discretization, const CutTrace::Tip &tip);

  /** The longest edge of the cell in which a tip ends (length). Collective. */
  double
  cell_size_at(const Discretization &discretization, const CutTrace::Tip &tip);

  /** A crack whose both tips lie inside of the surface. */
  struct CoarseCrack
  {
    unsigned int cut;
    /** Those through which, or along whose edges, the cut runs. */
    unsigned int n_cells;
  };

  /** The cracks of fewer than four cells. Collective. */
  std::vector<CoarseCrack>
  coarse_cracks(const Discretization &discretization);

  /** "the crack 'CUT' runs through N cells, ...", and what to do. */
  std::string
  in_words(const CoarseCrack &crack, const Cuts &cuts);

  /** What becomes of a tip that has advanced. */
  struct TipAdvance
  {
    /** Whether it is beyond an edge of the surface, and no tip any more. */
    bool leaves = false;
    /** The cut that it has met, where it ends. */
    std::optional<unsigned int> met = {};

    bool
    stays() const
    {
      return !leaves && !met;
    }
  };

  /**
   * Lengthen the cut of @p tip to the point of the surface nearest to
   *
   *   X_tip + length (cos angle e_1 + sin angle e_2),
   *
   * in the cut's own coordinates. A tip that comes nearer than a quarter of
   * the length to an edge of the surface or to a cut runs through the edge, or
   * ends on the cut. Collective.
   * @param angle from the direction ahead to that of e_2 (rad)
   * @param length of the advance
   * @param cuts those of @p discretization, of which one is lengthened
   */
  TipAdvance
  advance_tip(const Discretization &discretization,
              const Midsurface     &midsurface,
              const CutTrace::Tip  &tip,
              const double          angle,
              const double          length,
              Cuts                 &cuts);
} // namespace Nacre

#endif
