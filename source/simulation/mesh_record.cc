// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/mesh_record.h>

#include <deal.II/base/mpi.h>

namespace Nacre
{
  void
  MeshRecord::take(const Mesh &mesh)
  {
    refined.clear();
    for (const auto &active : mesh.active_cell_iterators())
      if (active->is_locally_owned())
        for (Mesh::cell_iterator cell = active; cell->level() > 0;)
          {
            cell = cell->parent();
            if (!refined.insert(cell->id().to_binary<dim>()).second)
              break;
          }
  }

  void
  MeshRecord::refine(Mesh &mesh) const
  {
    // Level by level: what comes between is as even as the mesh itself, and
    // no other cell needs to be refined for that.
    while (true)
      {
        unsigned int n_marked = 0;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              refined.count(cell->id().to_binary<dim>()) > 0)
            {
              cell->set_refine_flag();
              ++n_marked;
            }
        if (Utilities::MPI::max(n_marked, mesh.get_communicator()) == 0)
          return;
        mesh.execute_coarsening_and_refinement();
      }
  }
} // namespace Nacre
