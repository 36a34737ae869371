// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/discretization.h>
#include <nacre/multigrid/vertex_patches.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <set>

namespace Nacre
{
  namespace
  {
    /** Append the dofs of @p part at and next to the vertex @p v. */
    void
    add_dofs(const CellPart                             &part,
             const unsigned int                          v,
             const std::vector<types::global_dof_index> &part_dofs,
             std::vector<types::global_dof_index>       &dofs)
    {
      const auto &cell = part.cell;
      const auto &fe   = cell->get_fe();
      const auto  add  = [&](const unsigned int first, const unsigned int n) {
        dofs.insert(dofs.end(),
                    part_dofs.begin() + first,
                    part_dofs.begin() + first + n);
      };
      add(v * fe.n_dofs_per_vertex(), fe.n_dofs_per_vertex());
      for (const unsigned int l : cell->line_indices())
        for (const unsigned int end : {0, 1})
          if (cell->line(l)->vertex_index(end) == cell->vertex_index(v))
            add(fe.get_first_line_index() + l * fe.n_dofs_per_line(),
                fe.n_dofs_per_line());
      const unsigned int inside = fe.get_first_quad_index();
      add(inside, fe.n_dofs_per_cell() - inside);
    }

    /** A vertex of a part, by the part's number in some list. */
    struct Corner
    {
      unsigned int part;
      unsigned int vertex;
    };

    /**
     * The vertices of each family of cells, one of which is this rank's and
     * holds a tip: all cells into which the tip's cell on the coarser mesh is
     * refined.
     */
    std::set<std::set<unsigned int>>
    families_at_tips(const Discretization &discretization)
    {
      std::set<CellId> cells;
      for (const auto &tip : discretization.tips())
        cells.insert(tip.cell);
      std::set<std::set<unsigned int>> families;
      if (cells.empty())
        return families;
      for (const auto &cell :
           discretization.triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->level() > 0 &&
            cells.count(cell->id()) > 0)
          {
            std::set<unsigned int> vertices;
            const auto             parent = cell->parent();
            for (unsigned int child = 0; child < parent->n_children(); ++child)
              for (const unsigned int v :
                   parent->child(child)->vertex_indices())
                vertices.insert(parent->child(child)->vertex_index(v));
            families.insert(vertices);
          }
      return families;
    }
  } // namespace


  VertexPatches::VertexPatches(const Discretization            &discretization,
                               const AffineConstraints<double> &constraints,
                               const PatchExtent                extent)
    : start(1, 0)
    , foreign_dofs(discretization.n_dofs())
  {
    const auto &triangulation = discretization.triangulation();
    const auto  me            = triangulation.locally_owned_subdomain();

    const auto                       parts = discretization.relevant_parts();
    std::vector<std::vector<Corner>> corners(triangulation.n_vertices());
    for (unsigned int k = 0; k < parts.size(); ++k)
      for (const unsigned int v : parts[k].cell->vertex_indices())
        corners[parts[k].cell->vertex_index(v)].push_back({k, v});

    std::vector<bool>                    is_done(corners.size(), false);
    std::vector<types::global_dof_index> part_dofs, patch;
    // The functions of tips reach too far; MultigridSolver takes them.
    const auto add_nodes = [&](const CellPart &part) {
      discretization.get_dof_indices(part, part_dofs);
      patch.insert(patch.end(),
                   part_dofs.begin(),
                   part_dofs.begin() + discretization.node_dofs().size());
    };
    for (const CellPart &first_part : parts)
      if (first_part.cell->is_locally_owned())
        for (const unsigned int v : first_part.cell->vertex_indices())
          {
            const auto vertex = first_part.cell->vertex_index(v);
            if (is_done[vertex])
              continue;
            is_done[vertex] = true;
            patch.clear();
            bool is_mine = true;
            for (const Corner &corner : corners[vertex])
              {
                const CellPart &part = parts[corner.part];
                is_mine &= (part.cell->subdomain_id() >= me);
                if (extent == PatchExtent::closed_star)
                  {
                    add_nodes(part);
                    continue;
                  }
                discretization.get_dof_indices(part, part_dofs);
                add_dofs(part, corner.vertex, part_dofs, patch);
              }
            if (is_mine)
              append(patch, constraints);
          }
    for (const auto &vertices : families_at_tips(discretization))
      {
        patch.clear();
        for (const unsigned int vertex : vertices)
          for (const Corner &corner : corners[vertex])
            add_nodes(parts[corner.part]);
        append(patch, constraints);
      }

    std::vector<types::global_dof_index> foreign;
    for (const auto i : dofs)
      if (!discretization.locally_owned_dofs().is_element(i))
        foreign.push_back(i);
    std::sort(foreign.begin(), foreign.end());
    foreign_dofs.add_indices(foreign.begin(), foreign.end());
  }


  void
  VertexPatches::append(std::vector<types::global_dof_index> &patch,
                        const AffineConstraints<double>      &constraints)
  {
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
    for (const auto i : patch)
      if (!constraints.is_constrained(i))
        dofs.push_back(i);
    if (dofs.size() > start.back())
      start.push_back(dofs.size());
  }
} // namespace Nacre
