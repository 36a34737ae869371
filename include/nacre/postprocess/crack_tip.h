// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_tip_h
#define nacre_postprocess_crack_tip_h

#include <nacre/discretization/discretization.h>
#include <nacre/postprocess/crack_extension.h>

#include <string>

namespace Nacre
{
  struct Cuts;

  /**
   * The tip of a slit of the mesh: the vertex at @p point, where two edges of
   * the boundary, the lips, leave side by side. Throws on all ranks if there
   * is none. Collective.
   * @param where begins the messages
   */
  CrackTip
  find_crack_tip(const Discretization &discretization,
                 const Point<3>       &point,
                 const std::string    &where);

  /**
   * The begin or the end of a cut, by its number among @p cuts. Throws on all
   * ranks if the cut has none: it is closed, or ends at the surface's edge or
   * on another cut. Collective.
   * @param where begins the messages
   */
  const CutTrace::Tip &
  find_cut_tip(const Discretization &discretization,
               const Cuts           &cuts,
               const unsigned int    cut,
               const bool            at_end,
               const std::string    &where);

  /**
   * The crack that a cut opens at its tip: up to the edge by which the cut
   * enters the cell in which it ends. Throws on all ranks if the cut turns
   * beyond. Collective.
   * @param where begins the messages
   */
  CrackTip
  make_crack_tip(const Discretization &discretization,
                 const CutTrace::Tip  &tip,
                 const std::string    &where);
} // namespace Nacre

#endif
