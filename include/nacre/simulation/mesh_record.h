// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_mesh_record_h
#define nacre_simulation_mesh_record_h

#include <nacre/base/types.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/grid/cell_id.h>

#include <set>

namespace Nacre
{
  /**
   * How the mesh of a path has been refined, as a checkpoint keeps it: no
   * partition changes it.
   */
  struct MeshRecord
  {
    using Mesh = parallel::TriangulationBase<dim, spacedim>;

    /** Steps of adaptive refinement so far. */
    unsigned int n_refinements = 0;
    /** The cells that have children: those around this rank's cells, or all. */
    std::set<CellId::binary_type> refined;

    /** Take note of the cells around this rank's of the @p mesh. */
    void
    take(const Mesh &mesh);

    /**
     * Refine a @p mesh, from which that of the record has come, to be the same;
     * with all cells of the record on each rank. Collective.
     */
    void
    refine(Mesh &mesh) const;
  };
} // namespace Nacre

#endif
