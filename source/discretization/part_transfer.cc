// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/discretization/part_transfer.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <limits>

namespace Nacre
{
  Outline
  outline_of(const CellPart &part)
  {
    return part.is_cut() ? part.polygon().vertices() : Outline();
  }

  std::pair<unsigned int, double>
  nearest_outline(const std::vector<Outline> &outlines, const Point<dim> &x)
  {
    std::pair<unsigned int, double> nearest(0,
                                            std::numeric_limits<double>::max());
    for (unsigned int i = 0; i < outlines.size(); ++i)
      {
        const double distance =
          outlines[i].empty() ? 0. : distance_to_polygon(outlines[i], x);
        if (distance < nearest.second)
          nearest = {i, distance};
      }
    return nearest;
  }

  PartTransfer::PartTransfer(
    const Discretization                               &discretization,
    const std::vector<const Vector *>                  &fields,
    const std::function<PointValues(const CellPart &)> &at_points)
    : tips_(discretization, fields)
    , sources_(discretization.triangulation().n_active_cells())
  {
    const auto                          &node_dofs = discretization.node_dofs();
    std::vector<types::global_dof_index> dofs;
    // Parts of ghosts, too: the owner of a copy need not have a part of it.
    for (const CellPart &part : discretization.relevant_parts())
      {
        discretization.get_dof_indices(part, dofs);
        PartFields of_part{outline_of(part), {}, tips_.shares(part), {}};
        if (at_points && part.cell->is_locally_owned())
          of_part.at_points = at_points(part);
        for (const Vector *const field : fields)
          {
            NodalVectors u(node_dofs.size() / spacedim);
            for (unsigned int i = 0; i < node_dofs.size(); ++i)
              u[i / spacedim][i % spacedim] = (*field)(dofs[node_dofs[i]]);
            of_part.values.push_back(u);
          }
        sources_[part.cell->active_cell_index()].parts.push_back(
          std::move(of_part));
      }
  }

  void
  PartTransfer::refine(Mesh &mesh, const std::vector<bool> &marked)
  {
    using Distributed = parallel::DistributedTriangulationBase<dim, spacedim>;
    using Cell        = Distributed::cell_iterator;
    using ActiveCell  = Distributed::active_cell_iterator;
    using Status      = Distributed::CellStatus;
    auto &distributed = dynamic_cast<Distributed &>(mesh);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && marked[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh.prepare_coarsening_and_refinement();
    const unsigned int handle = distributed.register_data_attach(
      [&](const Cell &cell, const Status) {
        return Utilities::pack(sources_[cell->active_cell_index()], false);
      },
      true);
    mesh.execute_coarsening_and_refinement();
    sources_.assign(mesh.n_active_cells(), {});
    distributed.notify_ready_to_unpack(
      handle,
      [&](const Cell &cell, const Status status, const auto &data) {
        auto source =
          Utilities::unpack<Source>(data.begin(), data.end(), false);
        if (status == Distributed::CELL_PERSIST)
          sources_[cell->active_cell_index()] = source;
        else
          for (source.map = 0; source.map < cell->n_children(); ++source.map)
            sources_[cell->child(source.map)->active_cell_index()] = source;
      });
    GridTools::exchange_cell_data_to_ghosts<Source, Mesh>(
      mesh,
      [&](const ActiveCell &cell) -> std_cxx17::optional<Source> {
        return sources_[cell->active_cell_index()];
      },
      [&](const ActiveCell &cell, const Source &source) {
        sources_[cell->active_cell_index()] = source;
      });
    is_refined_ = true;
  }

  const PartTransfer::PartFields *
  PartTransfer::fields_around(const CellPart   &part,
                              const Point<dim> &inside) const
  {
    const auto          &parts = sources_[part.cell->active_cell_index()].parts;
    std::vector<Outline> outlines;
    for (const PartFields &fields : parts)
      outlines.push_back(fields.outline);
    const auto [place, distance] = nearest_outline(outlines, inside);
    AssertThrow(is_refined_ || distance == 0.,
                ExcMessage("Growth/Tips: a part of the cell around (" +
                           Text::number(part.cell->center()[0]) + ", " +
                           Text::number(part.cell->center()[1]) + ", " +
                           Text::number(part.cell->center()[2]) +
                           ") belongs to no part of before; cuts may only "
                           "become longer."));
    // Where all was removed: a sliver, which follows another part.
    return parts.empty() ? nullptr : &parts[place];
  }

  PointValues
  PartTransfer::points_of(const CellPart &part) const
  {
    const ChildMap map = child_maps(
      part.cell
        ->reference_cell())[sources_[part.cell->active_cell_index()].map];
    const PartFields *const fields =
      fields_around(part, map.to_parent(part.inner_point()));
    PointValues result;
    if (fields == nullptr)
      return result;
    result = fields->at_points;
    for (Point<dim> &x : result.points)
      x = map.to_child(x);
    return result;
  }

  PartTransfer::Vector
  PartTransfer::field_on(const Discretization &discretization,
                         const unsigned int    k) const
  {
    AssertDimension(sources_.size(),
                    discretization.triangulation().n_active_cells());
    const IndexSet &owned     = discretization.locally_owned_dofs();
    const auto     &fe        = discretization.scalar_fe();
    const auto     &node_dofs = discretization.node_dofs();
    const auto      maps      = child_maps(fe.reference_cell());
    const auto      tips      = tips_.on(discretization, k);
    Vector          field(owned, discretization.communicator());
    std::vector<types::global_dof_index> dofs;
    // A small part may have lain on the other side of a cut that 'Cuts/Snap' no
    // longer moves: parts that share its nodes have the last word.
    auto parts = discretization.relevant_parts();
    std::stable_partition(parts.begin(), parts.end(), [&](const auto &part) {
      return discretization.is_small(part);
    });
    for (const CellPart &part : parts)
      {
        const ChildMap &map =
          maps[sources_[part.cell->active_cell_index()].map];
        const PartFields *const fields =
          fields_around(part, map.to_parent(part.inner_point()));
        if (fields == nullptr)
          continue;
        discretization.get_dof_indices(part, dofs);
        for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
          if (owned.is_element(dofs[node_dofs[spacedim * a]]))
            {
              const Point<dim> unit = map.to_parent(fe.unit_support_point(a));
              const auto       u    = value_at(fe, fields->values[k], unit) +
                             tips.value_at_node(fields->tips, a, part, unit);
              for (unsigned int c = 0; c < spacedim; ++c)
                field(dofs[node_dofs[spacedim * a + c]]) = u[c];
            }
      }
    tips.set_coefficients(field);
    field.compress(VectorOperation::insert);
    discretization.node_constraints().distribute(field);
    return field;
  }
} // namespace Nacre
