// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/displacement_transfer.h>

#include <deal.II/base/geometry_info.h>

#include <map>
#include <utility>

namespace Nacre
{
  namespace
  {
    constexpr unsigned int no_child = numbers::invalid_unsigned_int;

    /**
     * Of polygons (none: the whole cell) the first that holds @p unit. A cut's
     * chord in a child is not quite that in its parent: else one that is near.
     */
    unsigned int
    part_around(const ReferenceCell                        &kind,
                const std::vector<std::vector<Point<dim>>> &polygons,
                const Point<dim>                           &unit)
    {
      for (const double tolerance : {1e-9, 0.01, 0.1, 1.})
        for (unsigned int i = 0; i < polygons.size(); ++i)
          {
            if (polygons[i].empty())
              return i;
            const CellPolygon polygon(kind,
                                      polygons[i],
                                      std::vector<CellPolygon::Side>(
                                        polygons[i].size()));
            if (polygon.contains(unit, tolerance))
              return i;
          }
      return numbers::invalid_unsigned_int;
    }
  } // namespace

  DisplacementTransfer::DisplacementTransfer(
    const Discretization              &discretization,
    const std::vector<const Vector *> &fields,
    const SectionStates               &states,
    const std::vector<bool>           &marked)
    : marked_(marked)
    , cells_(discretization.triangulation().n_active_cells())
  {
    std::map<std::pair<CellId::binary_type, unsigned int>,
             SectionStates::Record>
      of_rules;
    for (auto &record : states.records(discretization))
      if (record.is_of_rule())
        of_rules.emplace(std::make_pair(record.cell, record.part), record);
    const auto                          &node_dofs = discretization.node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const CellPart &part : discretization.owned_parts())
      {
        auto &of_cell = cells_[part.cell->active_cell_index()];
        of_cell.emplace_back();
        if (part.is_cut())
          for (unsigned int i = 0; i < part.polygon().n_vertices(); ++i)
            of_cell.back().vertices.push_back(part.polygon().vertex(i));
        const auto of_rule =
          of_rules.find({part.cell->id().to_binary<dim>(),
                         part.data != nullptr ? part.data->number : 0});
        if (of_rule != of_rules.end())
          of_cell.back().states.push_back(of_rule->second);
        discretization.get_dof_indices(part, dofs);
        for (const Vector *const field : fields)
          {
            of_cell.back().values.emplace_back();
            for (const unsigned int i : node_dofs)
              of_cell.back().values.back().push_back((*field)(dofs[i]));
          }
      }
  }

  void
  DisplacementTransfer::refine(Mesh &mesh)
  {
    using Distributed = parallel::DistributedTriangulationBase<dim, spacedim>;
    using Cell        = Distributed::cell_iterator;
    using Status      = Distributed::CellStatus;
    auto &distributed = dynamic_cast<Distributed &>(mesh);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && marked_[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh.prepare_coarsening_and_refinement();
    const unsigned int handle = distributed.register_data_attach(
      [&](const Cell &cell, const Status) {
        return Utilities::pack(cells_[cell->active_cell_index()], false);
      },
      true);
    mesh.execute_coarsening_and_refinement();
    cells_.clear();
    sources_.resize(mesh.n_active_cells());
    distributed.notify_ready_to_unpack(
      handle,
      [&](const Cell &cell, const Status status, const auto &data) {
        const unsigned int k = cells_.size();
        cells_.push_back(
          Utilities::unpack<CellFields>(data.begin(), data.end(), false));
        if (status == Distributed::CELL_PERSIST)
          sources_[cell->active_cell_index()] = {k, no_child};
        else
          for (unsigned int child = 0; child < cell->n_children(); ++child)
            sources_[cell->child(child)->active_cell_index()] = {k, child};
      });
  }

  Point<dim>
  DisplacementTransfer::place_before(const Source     &source,
                                     const Point<dim> &unit)
  {
    return source.child == no_child ?
             unit :
             GeometryInfo<dim>::child_to_cell_coordinates(unit, source.child);
  }

  const DisplacementTransfer::PartFields *
  DisplacementTransfer::fields_around(const Discretization &discretization,
                                      const CellPart       &part) const
  {
    const auto   kind   = discretization.scalar_fe().reference_cell();
    const Source source = sources_[part.cell->active_cell_index()];
    std::vector<std::vector<Point<dim>>> polygons;
    for (const PartFields &fields : cells_[source.cell])
      polygons.push_back(fields.vertices);
    const unsigned int around =
      part_around(kind,
                  polygons,
                  place_before(source,
                               part.is_cut() ? part.polygon().inner_point() :
                                               kind.barycenter<dim>()));
    return around == numbers::invalid_unsigned_int ?
             nullptr :
             &cells_[source.cell][around];
  }

  DisplacementTransfer::Vector
  DisplacementTransfer::field_on(const Discretization &discretization,
                                 const unsigned int    k) const
  {
    const IndexSet    &owned     = discretization.locally_owned_dofs();
    const auto        &fe        = discretization.scalar_fe();
    const auto        &node_dofs = discretization.node_dofs();
    const unsigned int n_nodes   = fe.n_dofs_per_cell();
    Vector             result(owned, discretization.communicator());
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const CellPart &part : discretization.owned_parts())
      {
        const PartFields *const fields = fields_around(discretization, part);
        if (fields == nullptr)
          continue; // All was removed: a sliver, which follows another part.
        const Source source = sources_[part.cell->active_cell_index()];
        const auto  &values = fields->values[k];
        discretization.get_dof_indices(part, dofs);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const auto unit = place_before(source, fe.unit_support_point(a));
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const auto dof = dofs[node_dofs[spacedim * a + c]];
                if (!owned.is_element(dof))
                  continue;
                double value = 0.;
                for (unsigned int b = 0; b < n_nodes; ++b)
                  value += fe.shape_value(b, unit) * values[spacedim * b + c];
                result(dof) = value;
              }
          }
      }
    result.compress(VectorOperation::insert);
    discretization.node_constraints().distribute(result);
    return result;
  }

  void
  DisplacementTransfer::set_states(const Discretization &discretization,
                                   SectionStates        &states) const
  {
    std::vector<SectionStates::Record> records;
    for (const CellPart &part : discretization.owned_parts())
      {
        const PartFields *const fields = fields_around(discretization, part);
        if (fields == nullptr || fields->states.empty())
          continue;
        const Source source = sources_[part.cell->active_cell_index()];
        records.push_back(fields->states.front());
        records.back().cell = part.cell->id().to_binary<dim>();
        records.back().part = part.data != nullptr ? part.data->number : 0;
        for (Point<dim> &unit : records.back().points)
          if (source.child != no_child)
            unit =
              GeometryInfo<dim>::cell_to_child_coordinates(unit, source.child);
      }
    states.take(discretization, records);
  }
} // namespace Nacre
