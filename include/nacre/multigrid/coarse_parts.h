// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_coarse_parts_h
#define nacre_multigrid_coarse_parts_h

#include <nacre/discretization/child_map.h>

#include <deal.II/base/types.h>

#include <vector>

namespace Nacre
{
  class Discretization;

  /** The part of a coarse mesh that holds a part of a finer one. */
  struct CoarsePart
  {
    /** Which of child_maps() leads from the fine cell to the coarse one. */
    unsigned int map = numbers::invalid_unsigned_int;
    /** Whether cuts divide the coarse cell. */
    bool is_cut = false;
    /** In the order of the element; none where the part has been removed. */
    std::vector<types::global_dof_index> dofs;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &map &is_cut &dofs;
    }
  };

  /**
   * The coarse parts of @p fine.owned_parts(), in their order. A cell of the
   * fine mesh must be an active cell of the coarse one or the child of one.
   *
   * Cuts are chords in both meshes, not the same ones where cells are curved in
   * the chart. A fine part belongs to the coarse one that holds a point inside
   * of it, or to the nearest one if that has been removed. Collective.
   */
  std::vector<CoarsePart>
  find_coarse_parts(const Discretization &fine, const Discretization &coarse);
} // namespace Nacre

#endif
