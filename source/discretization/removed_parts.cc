// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/removed_parts.h>
#include <nacre/discretization/shell_components.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>
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

  void
  check_removed_edges(const Discretization     &discretization,
                      const Midsurface         &midsurface,
                      const BoundaryConditions &supports,
                      const Loads              &loads)
  {
    const CellParts &parts = discretization.cell_parts();
    if (!parts.are_removed())
      return;
    std::map<types::boundary_id, std::string> named;
    for (const auto &[id, conditions] : supports.edges())
      if (!conditions.displacements.empty() || conditions.rotation != nullptr)
        named.emplace(id, "Boundary conditions/Edges");
    for (const auto &[id, force] : loads.edge_forces())
      named.emplace(id, "Loads/Edge forces");
    for (const auto &[id, moment] : loads.edge_moments())
      named.emplace(id, "Loads/Edge moments");

    std::vector<unsigned int> remains(midsurface.edge_names().size(), 0);
    for (const CellPart &part : discretization.owned_parts())
      for (const unsigned int face : part.cell->face_indices())
        if (part.cell->at_boundary(face) &&
            !parts.pieces_of(part, face).empty())
          remains.at(part.cell->face(face)->boundary_id()) = 1;
    std::vector<unsigned int> on_all(remains.size());
    Utilities::MPI::max(remains, discretization.communicator(), on_all);
    for (const auto &[id, parameter] : named)
      AssertThrow(on_all.at(id) == 1,
                  ExcMessage("Cuts/Remove takes away all of " +
                             midsurface.describe_side(id) + ", which " +
                             parameter +
                             " names. Leave the edge out there, or state "
                             "points of other pieces."));
  }

  void
  check_loaded_lips(const Discretization &discretization,
                    const Cuts           &cuts,
                    const Loads          &loads)
  {
    if (!loads.has_lip_loads())
      return;
    std::vector<unsigned int> exists(2 * cuts.curves.size(), 0);
    for (const CellPart &part : discretization.owned_parts())
      for (const CutLip &lip : discretization.cell_parts().lips(part))
        exists[2 * lip.cut + lip.is_left] = 1;
    std::vector<unsigned int> on_all(exists.size());
    Utilities::MPI::max(exists, discretization.communicator(), on_all);
    for (const auto &[cut, is_left] : loads.loaded_lips())
      AssertThrow(on_all[2 * cut + is_left] == 1,
                  ExcMessage(std::string("Loads/Lip forces, Lip moments, Lip "
                                         "pressures: the cut '") +
                             cuts.curves[cut].name + "' has no " +
                             (is_left ? "left" : "right") +
                             " lip: no cell is open there, or Cuts/Remove "
                             "takes that side away. Refine the mesh, or name "
                             "the other side, 'CUT " +
                             (is_left ? "right" : "left") + "'."));
  }
} // namespace Nacre
