// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/removed_parts.h>
#include <nacre/discretization/shell_components.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Send the flags of a rank's parts to the ranks that have them as ghosts.
     */
    void
    send_to_ghosts(const Discretization &discretization,
                   std::vector<bool>    &flags)
    {
      using Message = std::vector<bool>;
      if (Utilities::MPI::n_mpi_processes(discretization.communicator()) == 1)
        return;
      const CellParts &parts = discretization.cell_parts();
      GridTools::exchange_cell_data_to_ghosts<Message>(
        discretization.dof_handler(),
        [&](const CellPart::Cell &cell) -> std_cxx17::optional<Message> {
          Message message;
          for (unsigned int k = 0; k < parts.n_parts(cell); ++k)
            message.push_back(flags[parts.part(cell, k).index()]);
          return message;
        },
        [&](const CellPart::Cell &cell, const Message &message) {
          AssertDimension(parts.n_parts(cell), message.size());
          for (unsigned int k = 0; k < message.size(); ++k)
            flags[parts.part(cell, k).index()] = message[k];
        });
    }
  } // namespace

  std::vector<bool>
  find_removed_parts(const Discretization               &discretization,
                     const std::vector<Point<spacedim>> &points)
  {
    const auto            communicator = discretization.communicator();
    const ShellComponents components(discretization);
    std::vector<bool>     is_removed(components.size(), false);
    for (const auto &point : points)
      {
        std::ostringstream source;
        source << "Cuts/Remove: (" << point << ')';
        const SurfacePoint place = discretization.locate(point, source.str());
        AssertThrow(components.size() > 1,
                    ExcMessage(source.str() +
                               ": the cuts separate no piece from the shell "
                               "that could be taken away. Close the cut around "
                               "the piece, or let it reach the edges."));
        is_removed[Utilities::MPI::max(
          place.is_mine ? components.of(place.part) : 0u,
          communicator)] = true;
      }
    AssertThrow(std::find(is_removed.begin(), is_removed.end(), false) !=
                  is_removed.end(),
                ExcMessage("Cuts/Remove: the points lie in all " +
                           std::to_string(components.size()) +
                           " pieces of the shell, so that nothing is left. "
                           "State points of fewer pieces."));
    std::vector<bool> result(discretization.n_part_indices(), false);
    for (const CellPart &part : discretization.owned_parts())
      result[part.index()] = is_removed[components.of(part)];
    send_to_ghosts(discretization, result);
    return result;
  }
} // namespace Nacre
