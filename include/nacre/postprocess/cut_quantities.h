// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_cut_quantities_h
#define nacre_postprocess_cut_quantities_h

#include <nacre/base/expression.h>
#include <nacre/postprocess/quantity_phrase.h>
#include <nacre/postprocess/shell_state.h>

#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  struct Cuts;

  /**
   * A quantity of a cut.
   *
   * - `length of CUT`: of its trace on the mesh, by chords of an eighth of a
   *   cell (length);
   * - `opening of CUT at (point)`: u of the lip on the left less u of the lip
   *   on the right, at the place of the cut that is nearest to the point: its
   *   norm, or after `opening` a component along x, y, z, normal, (a, b, c)
   *   (length).
   *
   * The left is that of who walks along the cut in the order of its points, on
   * the side of the surface to which the normal t0 points. `normal` is t0.
   */
  struct CutQuantity
  {
    enum class Kind
    {
      length,
      opening
    };

    Kind         kind;
    unsigned int cut = 0;
    /** Of an opening: the whole vector's norm, or a component. */
    bool is_norm = false;
    /** None: along the normal. */
    std::optional<Tensor<1, spacedim>> direction = {};
    Point<spacedim>                    point     = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  /** "length", "opening" */
  const Selection<CutQuantity::Kind> &selection(CutQuantity::Kind);

  /**
   * The quantity that a @p phrase begins with the name of, or none. Throws for
   * what isn't understood, and for a cut that isn't among @p cuts.
   */
  std::optional<CutQuantity>
  parse_cut_quantity(QuantityPhrase  &phrase,
                     const Cuts      &cuts,
                     const Constants &constants);

  /** The value; collective. Throws where a lip can't be told from another. */
  double
  evaluate_cut_quantity(const ShellState &state, const CutQuantity &quantity);
} // namespace Nacre

#endif
