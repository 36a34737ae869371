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

  /** Which dofs of the cells around a vertex its patch takes. */
  enum class PatchExtent
  {
    /**
     * Those at the vertex, on the lines that end there and inside the cells:
     * the functions that vanish outside the cells.
     */
    star,
    /**
     * All dofs of the cells, those on the outer lines included. At degree 2 the
     * star holds too few functions: the closed star halves the iterations.
     */
    closed_star
  };

  /**
   * The unconstrained dofs of overlapping patches, one for each vertex. Each
   * unconstrained dof is in some patch.
   *
   * A crack is shorter on the coarser mesh, where it closes at the edge by
   * which it enters its last cell. No vertex' patch makes up for that, so that
   * each tip has a further patch: all dofs of that cell's children and of the
   * cells around them.
   *
   * A patch belongs to the lowest rank that owns one of its cells, and is
   * listed in the order of the cells.
   */
  struct VertexPatches
  {
    VertexPatches(const Discretization            &discretization,
                  const AffineConstraints<double> &constraints,
                  const PatchExtent                extent);

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

  private:
    /** Append a patch, sorted and without the constrained dofs. */
    void
    append(std::vector<types::global_dof_index> &patch,
           const AffineConstraints<double>      &constraints);
  };
} // namespace Nacre

#endif
