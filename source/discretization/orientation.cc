// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/orientation.h>
#include <nacre/discretization/shell_edge_values.h>

namespace Nacre
{
  bool
  is_consistently_oriented(const Discretization &discretization)
  {
    ShellEdgeValues edge(discretization);
    bool            consistent = true;
    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          edge.for_pieces_to_neighbor(cell, f, [&](const auto &piece) {
            consistent &= (piece.sigma(1, 0) > 0.);
          });
    return Utilities::MPI::min(consistent ? 1 : 0,
                               discretization.communicator()) == 1;
  }
} // namespace Nacre
