// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_vertex_patches_h
#define nacre_multigrid_vertex_patches_h

#include <nacre/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/types.h>

#include <cstddef>
#include <vector>

namespace dealii
{
  template <typename number>
  class AffineConstraints;
}

namespace Nacre
{
  class Discretization;

  /**
   * The dofs of overlapping patches around vertices: for each vertex the
   * unconstrained dofs at the vertex, on the lines that end there and inside
   * the cells around it. These are the functions that vanish outside the star
   * of the vertex: on a mesh without hanging nodes they hold all bending
   * functions of compact support. Each unconstrained dof is in some patch.
   *
   * A patch belongs to the lowest rank that owns one of its cells, and is
   * listed in the order of the cells.
   */
  struct VertexPatches
  {
    VertexPatches(const Discretization            &discretization,
                  const AffineConstraints<double> &constraints);

    unsigned int
    size() const
    {
      return start.size() - 1;
    }

    /** The dofs start[k] ... start[k + 1] - 1 are those of the patch k. */
    std::vector<std::size_t> start;
    /** Ascending in each patch. */
    std::vector<types::global_dof_index> dofs;
    /** The dofs of other ranks among them. */
    IndexSet foreign_dofs;
  };
} // namespace Nacre

#endif
