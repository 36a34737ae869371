// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_coarse_mesh_h
#define nacre_multigrid_coarse_mesh_h

#include <nacre/base/types.h>

#include <deal.II/distributed/tria_base.h>

#include <memory>

namespace Nacre
{
  class Midsurface;

  /** Whether coarsen() makes anything of @p mesh. */
  bool
  can_coarsen(const parallel::TriangulationBase<dim, spacedim> &mesh);

  /**
   * A copy of @p mesh in which all cells are replaced by their parents, where
   * that leaves no edge with more than one hanging node. Triangles must have
   * been refined uniformly. Collective.
   */
  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  coarsen(const Midsurface                                 &midsurface,
          const parallel::TriangulationBase<dim, spacedim> &mesh);

  /** A copy of @p mesh, refined uniformly if it has triangles. Collective. */
  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  copy(const Midsurface                                 &midsurface,
       const parallel::TriangulationBase<dim, spacedim> &mesh);
} // namespace Nacre

#endif
