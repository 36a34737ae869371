// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_lips_h
#define nacre_postprocess_crack_lips_h

#include <nacre/discretization/cell_parts.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /** A straight side of a part on which it meets no other part. */
  struct FreeSide
  {
    /** In the reference cell. */
    Point<dim> begin;
    /** From there to the other end. */
    Tensor<1, dim> along;
    /** +1: the part lies on the left of who walks along; -1: on the right. */
    double part_is_left;
    /** Of the surface's boundary; none: a lip of a cut. */
    std::optional<types::boundary_id> edge;
    /** Number of the cut, and whether the part lies on its left. */
    std::pair<unsigned int, bool> cut;
  };

  /** The free sides of a part: of the boundary, and lips of cuts. */
  std::vector<FreeSide>
  free_sides(const CellParts &parts, const CellPart &part);
} // namespace Nacre

#endif
