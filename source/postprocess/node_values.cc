// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/node_values.h>

#include <array>
#include <iomanip>
#include <set>

namespace Nacre
{
  void
  write_node_values(const ShellState &shell, const std::string &name)
  {
    using Line = std::array<double, 2 * spacedim>;
    const auto                          &space        = shell.discretization;
    const auto                          &node_dofs    = space.node_dofs();
    const MPI_Comm                       communicator = space.communicator();
    std::vector<Line>                    lines;
    std::set<types::global_dof_index>    visited;
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    // A part of a ghost may hold a node that owned ones only continue to.
    auto parts = space.owned_parts();
    for (const CellPart &part : space.relevant_parts())
      if (part.is_cut() && !part.cell->is_locally_owned())
        parts.push_back(part);
    for (const CellPart &part : parts)
      {
        space.get_dof_indices(part, dofs);
        const auto nodes = space.node_positions(part);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const auto first = dofs[node_dofs[spacedim * a]];
            if (!space.locally_owned_dofs().is_element(first) ||
                (part.is_cut() && !part.polygon().contains(
                                    space.scalar_fe().unit_support_point(a),
                                    1e-6)) ||
                !visited.insert(first).second)
              continue;
            Line line;
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                line[c] = nodes[a][c];
                line[spacedim + c] =
                  shell.displacement(dofs[node_dofs[spacedim * a + c]]);
              }
            lines.push_back(line);
          }
      }
    const auto all = Utilities::MPI::gather(communicator, lines);
    run_on_root(communicator, [&]() {
      write_file(name, [&](std::ostream &out) {
        out << "x,y,z,ux,uy,uz\n" << std::setprecision(17);
        for (const auto &of_rank : all)
          for (const Line &line : of_rank)
            for (unsigned int c = 0; c < line.size(); ++c)
              out << line[c] << (c + 1 < line.size() ? ',' : '\n');
      });
    });
  }
} // namespace Nacre
