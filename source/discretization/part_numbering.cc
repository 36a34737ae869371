// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/joined_numbers.h>
#include <nacre/discretization/part_numbering.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <set>

namespace Nacre
{
  namespace
  {
    /** Dof numbers where ranks begin, and the end of the last. */
    std::vector<types::global_dof_index>
    starts_of_ranks(const types::global_dof_index n_mine,
                    const MPI_Comm                communicator)
    {
      std::vector<types::global_dof_index> starts{0};
      for (const auto n : Utilities::MPI::all_gather(communicator, n_mine))
        starts.push_back(starts.back() + n);
      return starts;
    }
  } // namespace

  /** One copy of a node: the parts that hold it, and who numbers it. */
  struct PartNumbering::Copy
  {
    std::vector<PartNode>           members;
    std::pair<CellId, unsigned int> lowest;
    types::subdomain_id             owner = numbers::invalid_subdomain_id;
    /** One for each component; empty as long as they aren't known. */
    std::vector<Dof> dofs;

    /** Find the lowest of the members, whose rank is the owner. */
    void
    set_lowest()
    {
      for (const auto &member : members)
        {
          const auto key = std::make_pair(member.cell->id(), member.part);
          if (owner == numbers::invalid_subdomain_id || key < lowest)
            {
              lowest = key;
              owner  = member.cell->subdomain_id();
            }
        }
    }
  };

  PartNumbering::PartNumbering(const MeshNodes   &mesh,
                               CellParts         &parts,
                               const unsigned int n_functions,
                               const SplitNodes  &split_nodes)
    : mesh_(mesh)
    , n_nodes_(mesh.node_dofs.size() / spacedim)
    , old_starts_(starts_of_ranks(mesh.dof_handler.n_locally_owned_dofs(),
                                  mesh.dof_handler.get_communicator()))
    , new_starts_(old_starts_)
    , split_nodes_(split_nodes)
    , are_removed_(parts.are_removed())
  {
    if (parts.is_empty())
      {
        locally_owned_dofs_ = mesh.dof_handler.locally_owned_dofs();
        locally_relevant_dofs_ =
          DoFTools::extract_locally_relevant_dofs(mesh.dof_handler);
        return;
      }
    auto copies = find_copies(parts);
    number_copies(copies, n_functions);
    set_dofs(copies, parts);
    make_index_sets(parts);
  }

  types::global_dof_index
  PartNumbering::number_of(const types::global_dof_index dof) const
  {
    if (are_removed_)
      {
        const auto found = numbers_.find(dof);
        return found != numbers_.end() ? found->second :
                                         numbers::invalid_dof_index;
      }
    const auto rank =
      std::upper_bound(old_starts_.begin(), old_starts_.end(), dof) -
      old_starts_.begin() - 1;
    return dof - old_starts_[rank] + new_starts_[rank];
  }

  /** The nodes of all parts of touched cells, and which of them are one. */
  class PartNumbering::Nodes
  {
  public:
    Nodes(const CellParts &parts, const std::vector<unsigned int> &node_dofs)
      : cells(parts.touched_cells())
      , n_nodes_(node_dofs.size() / spacedim)
    {
      std::vector<Dof> dofs(node_dofs.size());
      unsigned int     n = 0;
      for (const auto &cell : cells)
        {
          place_[cell->id()] = first_.size();
          first_.push_back(n);
          n += parts.n_parts(cell) * n_nodes_;
          cell->get_dof_indices(dofs);
          for (unsigned int a = 0; a < n_nodes_; ++a)
            dofs_.push_back(dofs[node_dofs[spacedim * a]]);
        }
      joined = JoinedNumbers(n);
    }

    /** Of the node @p a of the part number @p i of the cell @p k of cells. */
    unsigned int
    number(const unsigned int k,
           const unsigned int i,
           const unsigned int a) const
    {
      return first_[k] + i * n_nodes_ + a;
    }

    unsigned int
    place_of(const CellPart::Cell &cell) const
    {
      return place_.at(cell->id());
    }

    /** The first dof of the DoFHandler at a node of the cell @p k. */
    Dof
    first_dof(const unsigned int k, const unsigned int a) const
    {
      return dofs_[k * n_nodes_ + a];
    }

    const std::vector<CellPart::Cell> &cells;
    JoinedNumbers                      joined{0};

  private:
    const unsigned int             n_nodes_;
    std::map<CellId, unsigned int> place_; // in cells
    std::vector<unsigned int>      first_;
    std::vector<Dof>               dofs_;
  };

  void
  PartNumbering::join_across_pieces(const CellParts &parts, Nodes &nodes) const
  {
    for (unsigned int k = 0; k < nodes.cells.size(); ++k)
      for (const auto face : nodes.cells[k]->face_indices())
        {
          const auto &cell = nodes.cells[k];
          if (cell->at_boundary(face) || !parts.has_pieces(cell, face))
            continue;
          for (const auto &piece : parts.pieces_between(cell, face))
            {
              const auto &[mine, other] = piece.sides;
              const auto there          = nodes.place_of(other.part.cell);
              for (const unsigned int a : mesh_.face_nodes[mine.face])
                for (const unsigned int b : mesh_.face_nodes[other.face])
                  if (nodes.first_dof(k, a) == nodes.first_dof(there, b) &&
                      !split_nodes_.contains(piece, nodes.first_dof(k, a)))
                    nodes.joined.join(
                      nodes.number(k, mine.part.data->number, a),
                      nodes.number(there, other.part.data->number, b));
            }
        }
  }

  void
  PartNumbering::join_across_edges(const CellParts &parts, Nodes &nodes) const
  {
    // Whole edges between whole cells: one node on both sides.
    std::map<std::pair<unsigned int, Dof>, unsigned int> of_edge;
    for (unsigned int k = 0; k < nodes.cells.size(); ++k)
      if (!parts.is_cut(nodes.cells[k]))
        for (const auto face : nodes.cells[k]->face_indices())
          if (!parts.has_pieces(nodes.cells[k], face))
            for (const unsigned int a : mesh_.face_nodes[face])
              {
                if (split_nodes_.contains(nodes.cells[k]->id(),
                                          face,
                                          0,
                                          nodes.first_dof(k, a)))
                  continue;
                const unsigned int edge   = nodes.cells[k]->face_index(face);
                const unsigned int number = nodes.number(k, 0, a);
                nodes.joined.join(
                  of_edge
                    .emplace(std::make_pair(edge, nodes.first_dof(k, a)),
                             number)
                    .first->second,
                  number);
              }
  }

  std::map<types::global_dof_index, std::vector<PartNumbering::Copy>>
  PartNumbering::find_copies(const CellParts &parts) const
  {
    Nodes nodes(parts, mesh_.node_dofs);
    join_across_pieces(parts, nodes);
    join_across_edges(parts, nodes);

    std::set<Dof> on_cut_cells;
    for (unsigned int k = 0; k < nodes.cells.size(); ++k)
      if (parts.is_cut(nodes.cells[k]))
        for (unsigned int a = 0; a < n_nodes_; ++a)
          on_cut_cells.insert(nodes.first_dof(k, a));
    // By node and by the set of joined numbers.
    std::map<Dof, std::map<unsigned int, Copy>> by_set;
    for (unsigned int k = 0; k < nodes.cells.size(); ++k)
      for (unsigned int i = 0; i < parts.n_parts(nodes.cells[k]); ++i)
        for (unsigned int a = 0; a < n_nodes_; ++a)
          {
            const Dof  dof    = nodes.first_dof(k, a);
            const bool is_cut = on_cut_cells.count(dof) > 0;
            if (!is_cut && !are_removed_)
              continue;
            const unsigned int set =
              is_cut ? nodes.joined.set_of(nodes.number(k, i, a)) : 0;
            by_set[dof][set].members.push_back({nodes.cells[k], i, a});
          }

    std::map<Dof, std::vector<Copy>> copies;
    for (auto &[dof, sets] : by_set)
      {
        auto &list = copies[dof];
        for (auto &entry : sets)
          {
            entry.second.set_lowest();
            list.push_back(entry.second);
          }
        sort(dof, list);
      }
    return copies;
  }

  void
  PartNumbering::sort(const Dof dof, std::vector<Copy> &copies) const
  {
    const auto owner =
      std::upper_bound(old_starts_.begin(), old_starts_.end(), dof) -
      old_starts_.begin() - 1;
    const auto has_owner = [&](const Copy &copy) {
      return std::any_of(copy.members.begin(),
                         copy.members.end(),
                         [&](const PartNode &member) {
                           return member.cell->subdomain_id() == owner;
                         });
    };
    // The first one is the lowest with a cell of the dof's owner.
    std::sort(copies.begin(), copies.end(), [&](const Copy &a, const Copy &b) {
      const bool a_has = has_owner(a), b_has = has_owner(b);
      return a_has != b_has ? a_has : a.lowest < b.lowest;
    });
    if (has_owner(copies.front())) // else the owner's parts are removed
      copies.front().owner = owner;
  }

  void
  PartNumbering::number_copies(std::map<Dof, std::vector<Copy>> &copies,
                               const unsigned int                n_functions)
  {
    const auto communicator = mesh_.dof_handler.get_communicator();
    const auto me           = Utilities::MPI::this_mpi_process(communicator);
    // Removed first copies leave no gaps: the others are numbered anew.
    const unsigned int first_new = are_removed_ ? 0 : 1;
    // Copies of an edge's or a cell's inner nodes get consecutive numbers.
    std::map<std::pair<unsigned int, Dof>, Dof> extra;
    for (const auto &[dof, list] : copies)
      for (unsigned int k = first_new; k < list.size(); ++k)
        if (list[k].owner == me)
          {
            const PartNode  &member = list[k].members.front();
            std::vector<Dof> dofs(mesh_.node_dofs.size());
            member.cell->get_dof_indices(dofs);
            for (unsigned int c = 0; c < spacedim; ++c)
              extra[{k, dofs[mesh_.node_dofs[spacedim * member.node + c]]}] = 0;
          }
    const Dof n_base =
      are_removed_ ? 0 : mesh_.dof_handler.n_locally_owned_dofs();
    new_starts_ =
      starts_of_ranks(n_base + extra.size() + n_functions, communicator);
    Dof next = new_starts_[me] + n_base;
    for (auto &entry : extra)
      entry.second = next++;

    for (auto &[dof, list] : copies)
      for (unsigned int k = 0; k < list.size(); ++k)
        if (list[k].owner == me)
          {
            const PartNode  &member = list[k].members.front();
            std::vector<Dof> dofs(mesh_.node_dofs.size());
            member.cell->get_dof_indices(dofs);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const Dof base =
                  dofs[mesh_.node_dofs[spacedim * member.node + c]];
                list[k].dofs.push_back(k < first_new ? number_of(base) :
                                                       extra.at({k, base}));
              }
          }
  }

  void
  PartNumbering::set_dofs(std::map<Dof, std::vector<Copy>> &copies,
                          CellParts                        &parts)
  {
    for (const auto &cell : parts.touched_cells())
      for (auto &part : parts.parts(cell))
        {
          part.dofs.resize(mesh_.node_dofs.size());
          cell->get_dof_indices(part.dofs);
          for (unsigned int a = 0; a < n_nodes_; ++a)
            {
              const bool has_copies =
                copies.count(part.dofs[mesh_.node_dofs[spacedim * a]]) > 0;
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  Dof &dof = part.dofs[mesh_.node_dofs[spacedim * a + c]];
                  dof =
                    has_copies ? numbers::invalid_dof_index : number_of(dof);
                }
            }
        }
    const auto fill = [&](const Copy &copy) {
      for (const auto &member : copy.members)
        for (unsigned int c = 0; c < spacedim; ++c)
          parts.parts(member.cell)[member.part]
            .dofs[mesh_.node_dofs[spacedim * member.node + c]] = copy.dofs[c];
    };
    const auto is_mine = [](const Copy &copy) {
      return std::any_of(copy.members.begin(),
                         copy.members.end(),
                         [](const PartNode &member) {
                           return member.cell->is_locally_owned();
                         });
    };
    for (const auto &entry : copies)
      for (const auto &copy : entry.second)
        if (!copy.dofs.empty())
          fill(copy);
    exchange(parts);
    for (auto &entry : copies)
      for (auto &copy : entry.second)
        {
          if (!is_mine(copy))
            continue;
          for (const auto &member : copy.members)
            {
              const auto &dofs = parts.parts(member.cell)[member.part].dofs;
              if (copy.dofs.empty() &&
                  dofs[mesh_.node_dofs[spacedim * member.node]] !=
                    numbers::invalid_dof_index)
                for (unsigned int c = 0; c < spacedim; ++c)
                  copy.dofs.push_back(
                    dofs[mesh_.node_dofs[spacedim * member.node + c]]);
            }
          Assert(!copy.dofs.empty(), ExcInternalError());
          fill(copy);
          copies_.push_back(copy.members);
        }
    exchange(parts);
  }

  void
  PartNumbering::exchange(CellParts &parts) const
  {
    if (Utilities::MPI::n_mpi_processes(mesh_.dof_handler.get_communicator()) ==
        1)
      return;
    using Message = std::vector<std::vector<Dof>>;
    GridTools::exchange_cell_data_to_ghosts<Message>(
      mesh_.dof_handler,
      [&](const CellPart::Cell &cell) -> std_cxx17::optional<Message> {
        Message message;
        if (!parts.is_touched(cell))
          return {};
        for (const auto &part : parts.parts(cell))
          message.push_back(part.dofs);
        return message;
      },
      [&](const CellPart::Cell &cell, const Message &message) {
        // A rank may not know the cut that touches a ghost.
        parts.touch(cell);
        auto &of_cell = parts.parts(cell);
        AssertDimension(of_cell.size(), message.size());
        for (unsigned int i = 0; i < of_cell.size(); ++i)
          of_cell[i].dofs.resize(message[i].size(), numbers::invalid_dof_index);
        for (unsigned int i = 0; i < of_cell.size(); ++i)
          for (unsigned int k = 0; k < message[i].size(); ++k)
            if (message[i][k] != numbers::invalid_dof_index)
              of_cell[i].dofs[k] = message[i][k];
      });
  }

  void
  PartNumbering::make_index_sets(const CellParts &parts)
  {
    const auto me =
      Utilities::MPI::this_mpi_process(mesh_.dof_handler.get_communicator());
    locally_owned_dofs_.set_size(n_dofs());
    locally_owned_dofs_.add_range(new_starts_[me], new_starts_[me + 1]);
    std::vector<Dof> dofs(mesh_.node_dofs.size()), all;
    for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        if (parts.is_touched(cell))
          for (const auto &part : parts.parts(cell))
            {
              all.insert(all.end(), part.dofs.begin(), part.dofs.end());
              if (are_removed_ && !parts.is_cut(cell))
                {
                  cell->get_dof_indices(dofs);
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    numbers_[dofs[i]] = part.dofs[i];
                }
            }
        else
          {
            cell->get_dof_indices(dofs);
            for (const Dof dof : dofs)
              all.push_back(number_of(dof));
          }
      }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    locally_relevant_dofs_ = locally_owned_dofs_;
    locally_relevant_dofs_.add_indices(all.begin(), all.end());
    locally_relevant_dofs_.compress();
  }
} // namespace Nacre
