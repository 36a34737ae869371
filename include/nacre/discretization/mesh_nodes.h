// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_mesh_nodes_h
#define nacre_discretization_mesh_nodes_h

#include <nacre/discretization/cell_part.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe.h>

#include <functional>
#include <vector>

namespace Nacre
{
  /** The nodes of a mesh, as those need them who number or move dofs. */
  struct MeshNodes
  {
    const DoFHandler<dim, spacedim> &dof_handler;
    /** A function for each node of a cell. */
    const FiniteElement<dim, spacedim> &scalar_fe;
    /** The nodes of each face of a cell. */
    const std::vector<std::vector<unsigned int>> &face_nodes;
    /** Local dof of the component c of the node a: index 3 a + c. */
    const std::vector<unsigned int> &node_dofs;
    /** (length) of the nodes of a part. */
    std::function<std::vector<Point<spacedim>>(const CellPart &)> positions;
  };
} // namespace Nacre

#endif
