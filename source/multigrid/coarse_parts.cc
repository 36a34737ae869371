// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/part_transfer.h>
#include <nacre/multigrid/coarse_parts.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <map>

namespace Nacre
{
  namespace
  {
    using Mesh          = parallel::TriangulationBase<dim, spacedim>;
    using cell_iterator = Triangulation<dim, spacedim>::cell_iterator;

    /** The active cell of @p mesh that is the cell @p id or holds it. */
    cell_iterator
    find_active(const Mesh &mesh, const CellId &id)
    {
      auto cell =
        mesh.create_cell_iterator(CellId(id.get_coarse_cell_id(), {}));
      for (const auto child : id.get_child_indices())
        {
          if (cell->is_active())
            break;
          cell = cell->child(child);
        }
      return cell;
    }


    /** Finds the rank that owns a cell of a mesh. */
    class CellOwners
    {
    public:
      explicit CellOwners(const Mesh &mesh)
        : mesh_(mesh)
        , shared_(
            dynamic_cast<
              const parallel::shared::Triangulation<dim, spacedim> *>(&mesh))
      {
        std::vector<CellId> first;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            if (const CellId id = cell->id(); first.empty() || id < first[0])
              first.assign(1, id);
        const auto firsts =
          Utilities::MPI::all_gather(mesh.get_communicator(), first);
        for (unsigned int rank = 0; rank < firsts.size(); ++rank)
          if (!firsts[rank].empty())
            {
              firsts_.push_back(firsts[rank][0]);
              ranks_.push_back(rank);
            }
      }

      /** The owner of the active cell that is the cell @p id or holds it. */
      unsigned int
      operator()(const CellId &id) const
      {
        if (shared_ != nullptr)
          {
            const auto         cell = find_active(mesh_, id);
            const unsigned int k    = cell->active_cell_index();
            return shared_->with_artificial_cells() ?
                     shared_->get_true_subdomain_ids_of_cells()[k] :
                     cell->subdomain_id();
          }
        // p4est orders cells as their ids, a cell before its descendants.
        const auto next = std::upper_bound(firsts_.begin(), firsts_.end(), id);
        Assert(next != firsts_.begin(), ExcInternalError());
        return ranks_[next - firsts_.begin() - 1];
      }

    private:
      const Mesh                                                 &mesh_;
      const parallel::shared::Triangulation<dim, spacedim> *const shared_;
      std::vector<CellId>                                         firsts_;
      std::vector<unsigned int>                                   ranks_;
    };


    /** A fine part, as the rank knows it that owns the coarse cell. */
    struct FinePart
    {
      /** Its place among those of its rank. */
      unsigned int place;
      CellId       cell;
      /** A point inside, in the reference cell. */
      Point<dim> inside;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &place &cell &inside;
      }
    };


    CoarsePart
    part_of(const Discretization        &coarse,
            const std::vector<ChildMap> &maps,
            const FinePart              &fine)
    {
      const auto path = fine.cell.get_child_indices();
      const auto cell = find_active(coarse.triangulation(), fine.cell);
      const CellPart::Cell dof_cell(&coarse.triangulation(),
                                    cell->level(),
                                    cell->index(),
                                    &coarse.dof_handler());
      CoarsePart           result;
      Assert(cell->level() == int(path.size()) ||
               cell->level() + 1 == int(path.size()),
             ExcMessage("The coarse cell is not the parent."));
      result.map = cell->level() == int(path.size()) ? ChildMap::identity :
                                                       path[path.size() - 1];
      const CellParts &parts = coarse.cell_parts();
      if (parts.n_parts(dof_cell) == 0)
        return result;
      CellPart part = parts.part(dof_cell);
      if (parts.is_touched(dof_cell))
        {
          std::vector<Outline> outlines;
          for (unsigned int i = 0; i < parts.n_parts(dof_cell); ++i)
            outlines.push_back(outline_of(parts.part(dof_cell, i)));
          const Point<dim> x = maps[result.map].to_parent(fine.inside);
          part = parts.part(dof_cell, nearest_outline(outlines, x).first);
        }
      result.is_cut = part.is_cut();
      coarse.get_dof_indices(part, result.dofs);
      return result;
    }
  } // namespace


  std::vector<CoarsePart>
  find_coarse_parts(const Discretization &fine, const Discretization &coarse)
  {
    const CellOwners   owners(coarse.triangulation());
    const auto         comm = fine.communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);
    const auto         maps = child_maps(fine.element().reference_cell());

    std::vector<CoarsePart>                       found;
    std::map<unsigned int, std::vector<FinePart>> questions;
    for (const CellPart &part : fine.owned_parts())
      {
        const unsigned int place = found.size();
        const FinePart     question{place, part.cell->id(), part.inner_point()};
        const unsigned int owner = owners(question.cell);
        found.emplace_back();
        if (owner == me)
          found.back() = part_of(coarse, maps, question);
        else
          questions[owner].push_back(question);
      }

    using Answer = std::pair<unsigned int, CoarsePart>;
    std::map<unsigned int, std::vector<Answer>> answers;
    for (const auto &[rank, list] :
         Utilities::MPI::some_to_some(comm, questions))
      for (const FinePart &question : list)
        answers[rank].emplace_back(question.place,
                                   part_of(coarse, maps, question));
    for (const auto &[rank, list] : Utilities::MPI::some_to_some(comm, answers))
      for (const auto &[place, part] : list)
        found[place] = part;
    return found;
  }
} // namespace Nacre
