// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/joined_numbers.h>
#include <nacre/discretization/shell_components.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe.h>

#include <deal.II/grid/grid_tools.h>

#include <map>
#include <unordered_map>

namespace Nacre
{
  ShellComponents::ShellComponents(const Discretization &discretization)
    : discretization_(discretization)
  {
    const auto   communicator = discretization.communicator();
    const auto   local        = join_on_rank();
    unsigned int n_local      = 0;
    for (const CellPart &part : discretization.owned_parts())
      n_local = std::max(n_local, local[part.index()] + 1);
    const auto   sizes  = Utilities::MPI::all_gather(communicator, n_local);
    const auto   me     = Utilities::MPI::this_mpi_process(communicator);
    unsigned int offset = 0, n_all = 0;
    for (unsigned int rank = 0; rank < sizes.size(); ++rank)
      {
        offset += rank < me ? sizes[rank] : 0;
        n_all += sizes[rank];
      }
    JoinedNumbers joined(n_all);
    for (const auto &links :
         Utilities::MPI::all_gather(communicator,
                                    links_to_ghosts(local, offset)))
      for (const auto &[a, b] : links)
        joined.join(a, b);

    std::map<unsigned int, unsigned int> numbers;
    for (unsigned int k = 0; k < n_all; ++k)
      numbers.emplace(joined.set_of(k), numbers.size());
    components_.assign(discretization.n_part_indices(),
                       numbers::invalid_unsigned_int);
    std::vector<std::pair<CellId, Point<spacedim>>> first(numbers.size(),
                                                          {CellId(),
                                                           Point<spacedim>()});
    std::vector<std::vector<std::pair<CellId, Point<spacedim>>>> found(
      numbers.size());
    for (const CellPart &part : discretization.owned_parts())
      {
        const unsigned int k =
          numbers.at(joined.set_of(offset + local[part.index()]));
        components_[part.index()] = k;
        if (found[k].empty())
          found[k].emplace_back(part.cell->id(),
                                discretization.point_inside(part));
      }
    points_.resize(numbers.size());
    std::vector<bool> is_set(numbers.size(), false);
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, found))
      for (unsigned int k = 0; k < of_rank.size(); ++k)
        for (const auto &[id, point] : of_rank[k])
          if (!is_set[k] || id < first[k].first)
            {
              is_set[k]  = true;
              first[k]   = {id, point};
              points_[k] = point;
            }
  }

  std::vector<unsigned int>
  ShellComponents::join_on_rank() const
  {
    const auto        &fe        = discretization_.dof_handler().get_fe();
    const auto        &node_dofs = discretization_.node_dofs();
    const auto         n_corners = fe.reference_cell().n_vertices();
    const unsigned int n         = discretization_.n_part_indices();
    JoinedNumbers      joined(n);
    std::unordered_map<types::global_dof_index, unsigned int> of_vertex;
    std::vector<types::global_dof_index>                      dofs;
    const auto parts = discretization_.owned_parts();
    for (const CellPart &part : parts)
      {
        discretization_.get_dof_indices(part, dofs);
        for (unsigned int v = 0; v < n_corners; ++v)
          joined.join(of_vertex
                        .emplace(dofs[node_dofs[spacedim * v]], part.index())
                        .first->second,
                      part.index());
      }
    std::map<unsigned int, unsigned int> numbers;
    std::vector<unsigned int> local(n, numbers::invalid_unsigned_int);
    for (const CellPart &part : parts)
      local[part.index()] =
        numbers.emplace(joined.set_of(part.index()), numbers.size())
          .first->second;
    return local;
  }

  std::vector<std::pair<unsigned int, unsigned int>>
  ShellComponents::links_to_ghosts(const std::vector<unsigned int> &local,
                                   const unsigned int offset) const
  {
    using Links = std::vector<std::pair<unsigned int, unsigned int>>;
    if (Utilities::MPI::n_mpi_processes(discretization_.communicator()) == 1)
      return {};
    const auto &fe        = discretization_.dof_handler().get_fe();
    const auto &node_dofs = discretization_.node_dofs();
    const auto  n_corners = fe.reference_cell().n_vertices();
    const auto &cuts      = discretization_.cell_parts();
    // By dof of a vertex: this rank's component.
    std::unordered_map<types::global_dof_index, unsigned int> of_vertex;
    std::vector<types::global_dof_index>                      dofs;
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        for (unsigned int v = 0; v < n_corners; ++v)
          of_vertex[dofs[node_dofs[spacedim * v]]] =
            offset + local[part.index()];
      }
    Links links;
    GridTools::exchange_cell_data_to_ghosts<std::vector<unsigned int>>(
      discretization_.dof_handler(),
      [&](const CellPart::Cell &cell)
        -> std_cxx17::optional<std::vector<unsigned int>> {
        std::vector<unsigned int> message;
        for (unsigned int i = 0; i < cuts.n_parts(cell); ++i)
          message.push_back(offset + local[cuts.part(cell, i).index()]);
        return message;
      },
      [&](const CellPart::Cell            &cell,
          const std::vector<unsigned int> &message) {
        for (unsigned int i = 0; i < message.size(); ++i)
          {
            discretization_.get_dof_indices(cuts.part(cell, i), dofs);
            for (unsigned int v = 0; v < n_corners; ++v)
              {
                const auto mine = of_vertex.find(dofs[node_dofs[spacedim * v]]);
                if (mine != of_vertex.end())
                  links.emplace_back(message[i], mine->second);
              }
          }
      });
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    return links;
  }

  std::vector<unsigned int>
  ShellComponents::of_nodes(
    const std::vector<types::global_dof_index> &first_dofs) const
  {
    std::vector<unsigned int> result(first_dofs.size(), 0);
    if (size() == 1)
      return result;
    // A node may come more than once.
    std::unordered_map<types::global_dof_index, std::vector<unsigned int>>
      places;
    for (unsigned int k = 0; k < first_dofs.size(); ++k)
      places[first_dofs[k]].push_back(k);
    const auto &node_dofs = discretization_.node_dofs();
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        for (unsigned int k = 0; k < dofs.size(); k += spacedim)
          {
            const auto found = places.find(dofs[node_dofs[k]]);
            if (found != places.end())
              for (const unsigned int place : found->second)
                result[place] = of(part);
          }
      }
    Utilities::MPI::max(result, discretization_.communicator(), result);
    return result;
  }
} // namespace Nacre
