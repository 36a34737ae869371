// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/multigrid/coarse_mesh.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/distributed/tria.h>

namespace Nacre
{
  namespace
  {
    using Mesh       = parallel::TriangulationBase<dim, spacedim>;
    using ForestMesh = parallel::distributed::Triangulation<dim, spacedim>;

    const ForestMesh *
    as_forest(const Mesh &mesh)
    {
      return dynamic_cast<const ForestMesh *>(&mesh);
    }

    /** Whether all active cells, known to all ranks, are of the last level. */
    bool
    is_uniform(const Mesh &mesh)
    {
      return mesh.n_active_cells(mesh.n_levels() - 1) == mesh.n_active_cells();
    }
  } // namespace


  bool
  can_coarsen(const Mesh &mesh)
  {
    return mesh.n_global_levels() > 1 &&
           (as_forest(mesh) != nullptr || is_uniform(mesh));
  }


  std::unique_ptr<Mesh>
  coarsen(const Midsurface &midsurface, const Mesh &mesh)
  {
    Assert(can_coarsen(mesh), ExcMessage("There is no coarser mesh."));
    const MPI_Comm communicator = mesh.get_communicator();
    if (as_forest(mesh) == nullptr)
      return midsurface.create_triangulation(communicator,
                                             mesh.get_reference_cells()[0],
                                             mesh.n_global_levels() - 2);
    auto coarse = std::make_unique<ForestMesh>(communicator);
    coarse->copy_triangulation(mesh);
    coarse->coarsen_global(1);
    return coarse;
  }


  std::unique_ptr<Mesh>
  copy(const Midsurface &midsurface, const Mesh &mesh)
  {
    const MPI_Comm communicator = mesh.get_communicator();
    if (as_forest(mesh) == nullptr)
      return midsurface.create_triangulation(communicator,
                                             mesh.get_reference_cells()[0],
                                             mesh.n_global_levels() - 1);
    auto result = std::make_unique<ForestMesh>(communicator);
    result->copy_triangulation(mesh);
    return result;
  }
} // namespace Nacre
