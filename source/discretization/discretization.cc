// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/discretization.h>
#include <nacre/discretization/nodal_mapping.h>
#include <nacre/discretization/removed_parts.h>
#include <nacre/problem/cuts.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/mapping_q_cache.h>

#include <optional>

namespace Nacre
{
  namespace
  {
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
    checked(
      std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation)
    {
      Assert(triangulation != nullptr, ExcInternalError());
      return triangulation;
    }

    /** Constraints of hanging nodes of a handler on its relevant dofs. */
    AffineConstraints<double>
    make_hanging_node_constraints(const DoFHandler<dim, spacedim> &dof_handler)
    {
      AffineConstraints<double> constraints(
        DoFTools::extract_locally_relevant_dofs(dof_handler));
      DoFTools::make_hanging_node_constraints(dof_handler, constraints);
      constraints.close();
      return constraints;
    }

    using HangingLine =
      std::pair<types::global_dof_index,
                std::vector<std::pair<types::global_dof_index, double>>>;

    /**
     * Of all ranks: @p dofs, and those that the hanging ones among them follow.
     */
    IndexSet
    with_masters_of_hanging_nodes(const IndexSet                 &dofs,
                                  const std::vector<HangingLine> &hanging,
                                  const MPI_Comm                  communicator)
    {
      std::vector<types::global_dof_index> masters;
      for (const auto &[dof, entries] : hanging)
        if (dofs.is_element(dof))
          for (const auto &entry : entries)
            masters.push_back(entry.first);
      IndexSet all = dofs;
      for (auto &of_rank : Utilities::MPI::all_gather(communicator, masters))
        {
          std::sort(of_rank.begin(), of_rank.end());
          all.add_indices(of_rank.begin(), of_rank.end());
        }
      all.compress();
      return all;
    }
  } // namespace

  Discretization::Discretization(const Midsurface  &midsurface,
                                 const MPI_Comm     communicator,
                                 const Element     &element,
                                 const unsigned int mapping_degree,
                                 const unsigned int n_refinements)
    : Discretization(midsurface.create_triangulation(communicator,
                                                     element.reference_cell(),
                                                     n_refinements),
                     midsurface,
                     element,
                     mapping_degree,
                     Cuts())
  {}

  Discretization::Discretization(
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation,
    const Midsurface                                           &midsurface,
    const Element                                              &element,
    const unsigned int                                          mapping_degree,
    const Cuts                                                 &cuts)
    : Discretization(
        std::move(triangulation),
        [&midsurface](const auto &cell, const auto &unit) {
          return midsurface.position(cell, unit);
        },
        element,
        mapping_degree)
  {
    if (cuts.is_empty())
      return;
    AssertThrow(mapping_degree == 0 || mapping_degree == degree() ||
                  element.type != ElementType::lagrange,
                ExcMessage("Discretization/Mapping degree: " +
                           std::to_string(mapping_degree) +
                           "; with cuts the geometry is isoparametric, 0."));
    cut(midsurface, cuts);
    if (!cuts.remove.empty())
      remove(cuts.remove);
    if (cuts.tips == CutTips::branch_functions && !tips_.empty())
      tip_patches_ = std::make_unique<TipPatches>(mesh_nodes(),
                                                  cuts,
                                                  tips_,
                                                  cut_lines_,
                                                  parts_);
    if ((cuts.tips == CutTips::harmonic ||
         cuts.tips == CutTips::harmonic_all_components) &&
        !tips_.empty())
      tip_openings_ =
        std::make_unique<TipOpenings>(mesh_nodes(), cuts, tips_, parts_);
    number_dofs();
  }

  Discretization::Discretization(
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation,
    const std::function<
      Point<spacedim>(const Triangulation<dim, spacedim>::cell_iterator &,
                      const Point<dim> &)> &position,
    const Element                          &element,
    const unsigned int                      mapping_degree)
    : triangulation_(checked(std::move(triangulation)))
    , element_(element)
    , scalar_fe_(element.make_scalar_fe())
    , face_nodes_(element.face_nodes())
    , fe_(*scalar_fe_, spacedim)
    , dof_handler_(*triangulation_)
    , geometry_fe_(*element.make_geometry_fe(mapping_degree), spacedim)
    , geometry_dof_handler_(*triangulation_)
  {
    dof_handler_.distribute_dofs(fe_);
    node_dofs_.resize(fe_.n_dofs_per_cell());
    for (unsigned int i = 0; i < fe_.n_dofs_per_cell(); ++i)
      {
        const auto [c, a]            = fe_.system_to_component_index(i);
        node_dofs_[spacedim * a + c] = i;
      }
    build_geometry(position, mapping_degree);
    number_dofs();
  }

  void
  Discretization::cut(const Midsurface &midsurface, const Cuts &cuts)
  {
    CellMaps maps{element_.reference_cell(),
                  [this](const auto &cell, const auto &unit) {
                    const std::size_t n = geometry_to_nodes_.n();
                    const auto       *nodes =
                      &geometry_nodes_[cell->active_cell_index() * n];
                    Point<spacedim> x;
                    for (unsigned int b = 0; b < n; ++b)
                      x += geometry_fe().shape_value(b, unit) * nodes[b];
                    return x;
                  }};
    if (midsurface.has_chart())
      {
        maps.chart = [&midsurface](const auto &cell, const auto &unit) {
          return midsurface.chart(cell, unit);
        };
        maps.periods = midsurface.chart_periods();
      }
    const CutTrace trace(*triangulation_, maps, cuts);
    run_on_all_ranks(communicator(),
                     [&]() { parts_ = CellParts(dof_handler_, trace); });
    smallest_part_ = cuts.smallest_part;
    cut_lines_     = trace.lines();
    tips_          = trace.tips();
  }

  void
  Discretization::remove(const std::vector<Point<spacedim>> &points)
  {
    // What is removed may be too small for lines of its own.
    number_dofs(false);
    parts_.remove(dof_handler_, find_removed_parts(*this, points));
  }

  TipDofs *
  Discretization::tip_dofs() const
  {
    if (tip_patches_ != nullptr)
      return tip_patches_.get();
    return tip_openings_.get();
  }

  MeshNodes
  Discretization::mesh_nodes() const
  {
    return {dof_handler_,
            *scalar_fe_,
            face_nodes_,
            node_dofs_,
            [this](const CellPart &part) { return node_positions(part); }};
  }

  void
  Discretization::number_dofs(const bool extends_parts)
  {
    numbering_ = std::make_unique<PartNumbering>(
      mesh_nodes(),
      parts_,
      tip_dofs() != nullptr ? tip_dofs()->n_owned_functions() : 0,
      tip_openings_ != nullptr ? tip_openings_->split_nodes() : SplitNodes());
    if (parts_.is_empty())
      node_constraints_ = make_hanging_node_constraints(dof_handler_);
    else
      constrain_parts(extends_parts);
    owned_parts_.clear();
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (unsigned int i = 0; i < parts_.n_parts(cell); ++i)
          owned_parts_.push_back(parts_.part(cell, i));
  }

  void
  Discretization::constrain_parts(const bool extends_parts)
  {
    std::optional<PartExtension> extension;
    if (extends_parts)
      extension.emplace(mesh_nodes(), smallest_part_, *numbering_, parts_);
    if (TipDofs *const tips = tip_dofs())
      {
        tips->complete(numbering_->ends_of_ranks(), parts_);
        numbering_->add_relevant_dofs(tips->dofs());
      }
    // No hanging edge has a node of a cut cell.
    const auto hanging = make_hanging_node_constraints(dof_handler_);
    std::vector<HangingLine> hanging_lines;
    for (const auto &line : hanging.get_lines())
      {
        const auto dof = numbering_->number_of(line.index);
        if (dof == numbers::invalid_dof_index)
          continue; // removed
        hanging_lines.emplace_back(dof, line.entries);
        for (auto &entry : hanging_lines.back().second)
          entry.first = numbering_->number_of(entry.first);
      }
    // A ghost's node may follow nodes beyond the ghosts.
    IndexSet lines = locally_relevant_dofs();
    if (extension)
      {
        IndexSet masters = extension->masters_of_all_ranks();
        if (tip_openings_ != nullptr)
          masters.add_indices(tip_openings_->masters());
        lines.add_indices(with_masters_of_hanging_nodes(masters,
                                                        hanging_lines,
                                                        communicator()));
      }
    node_constraints_.reinit(lines);
    for (const auto &[dof, entries] : hanging_lines)
      {
        node_constraints_.add_line(dof);
        node_constraints_.add_entries(dof, entries);
      }
    if (extension)
      extension->add_to(node_constraints_, tip_patches_.get());
    if (tip_openings_ != nullptr)
      tip_openings_->add_to(node_constraints_);
    if (Utilities::MPI::n_mpi_processes(communicator()) > 1)
      node_constraints_.make_consistent_in_parallel(locally_owned_dofs(),
                                                    lines,
                                                    communicator());
    node_constraints_.close();
  }

  std::vector<CellPart>
  Discretization::relevant_parts() const
  {
    std::vector<CellPart> result;
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (!cell->is_artificial())
        for (unsigned int i = 0; i < parts_.n_parts(cell); ++i)
          result.push_back(parts_.part(cell, i));
    return result;
  }

  void
  Discretization::get_dof_indices(
    const CellPart                       &part,
    std::vector<types::global_dof_index> &dofs) const
  {
    if (part.data != nullptr)
      {
        dofs = part.data->dofs;
        return;
      }
    AssertThrow(!parts_.is_touched(part.cell),
                ExcMessage("Cuts/Cuts: this isn't implemented with cuts."));
    dofs.resize(node_dofs_.size());
    part.cell->get_dof_indices(dofs);
    if (!parts_.is_empty())
      for (auto &dof : dofs)
        dof = numbering_->number_of(dof);
  }

  void
  Discretization::build_geometry(
    const std::function<
      Point<spacedim>(const Triangulation<dim, spacedim>::cell_iterator &,
                      const Point<dim> &)> &position,
    const unsigned int                      mapping_degree)
  {
    geometry_dof_handler_.distribute_dofs(geometry_fe_);
    const auto &scalar_geometry_fe = geometry_fe_.base_element(0);
    geometry_to_nodes_.reinit(scalar_fe_->n_dofs_per_cell(),
                              scalar_geometry_fe.n_dofs_per_cell());
    for (unsigned int a = 0; a < geometry_to_nodes_.m(); ++a)
      for (unsigned int b = 0; b < geometry_to_nodes_.n(); ++b)
        geometry_to_nodes_(a, b) =
          scalar_geometry_fe.shape_value(b, scalar_fe_->unit_support_point(a));

    const IndexSet &owned = geometry_dof_handler_.locally_owned_dofs();
    geometry_.reinit(owned,
                     DoFTools::extract_locally_relevant_dofs(
                       geometry_dof_handler_),
                     communicator());

    std::vector<types::global_dof_index> dofs(geometry_fe_.n_dofs_per_cell());
    for (const auto &cell : geometry_dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (owned.is_element(dofs[i]))
              geometry_(dofs[i]) =
                position(cell,
                         geometry_fe_.unit_support_point(
                           i))[geometry_fe_.system_to_component_index(i).first];
        }
    geometry_.update_ghost_values();
    // Without this, the faces of curved cells on both sides of a hanging edge
    // differ, and rigid rotations get an energy.
    geometry_.zero_out_ghost_values();
    make_hanging_node_constraints(geometry_dof_handler_).distribute(geometry_);
    geometry_.update_ghost_values();
    store_geometry_nodes();

    // FE_Q(2) contains the 8-node space.
    if (element_.reference_cell() == ReferenceCells::Quadrilateral)
      {
        auto mapping = std::make_unique<MappingQCache<dim, spacedim>>(
          mapping_degree == 0 ? degree() : mapping_degree);
        mapping->initialize(MappingQ<dim, spacedim>(1),
                            geometry_dof_handler_,
                            geometry_,
                            false);
        mapping_ = std::move(mapping);
      }
    else
      mapping_ = std::make_unique<NodalMapping>(
        scalar_geometry_fe,
        [this](const auto &cell) {
          const std::size_t n = geometry_to_nodes_.n();
          const auto        first =
            geometry_nodes_.begin() + cell->active_cell_index() * n;
          return std::vector<Point<spacedim>>(first, first + n);
        });
  }

  void
  Discretization::store_geometry_nodes()
  {
    const unsigned int                   n_nodes = geometry_to_nodes_.n();
    std::vector<types::global_dof_index> dofs(geometry_fe_.n_dofs_per_cell());
    geometry_nodes_.resize(triangulation_->n_active_cells() * n_nodes);
    for (const auto &cell : geometry_dof_handler_.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          auto *const nodes =
            &geometry_nodes_[cell->active_cell_index() * n_nodes];
          for (unsigned int i = 0; i < dofs.size(); ++i)
            {
              const auto [c, b] = geometry_fe_.system_to_component_index(i);
              nodes[b][c]       = geometry_(dofs[i]);
            }
        }
  }

  MPI_Comm
  Discretization::communicator() const
  {
    return triangulation_->get_communicator();
  }

  const parallel::TriangulationBase<dim, spacedim> &
  Discretization::triangulation() const
  {
    return *triangulation_;
  }

  const Mapping<dim, spacedim> &
  Discretization::mapping() const
  {
    return *mapping_;
  }

  const DoFHandler<dim, spacedim> &
  Discretization::dof_handler() const
  {
    return dof_handler_;
  }

  const FiniteElement<dim, spacedim> &
  Discretization::scalar_fe() const
  {
    return *scalar_fe_;
  }

  const IndexSet &
  Discretization::locally_owned_dofs() const
  {
    return numbering_->locally_owned_dofs();
  }

  const IndexSet &
  Discretization::locally_relevant_dofs() const
  {
    return numbering_->locally_relevant_dofs();
  }

  const AffineConstraints<double> &
  Discretization::node_constraints() const
  {
    return node_constraints_;
  }

  double
  Discretization::longest_edge(const CellPart::Cell &cell) const
  {
    const auto reference = cell->reference_cell();
    const auto nodes     = geometry_nodes(cell);
    double     longest   = 0.;
    for (const unsigned int face : cell->face_indices())
      longest =
        std::max(longest,
                 nodes[reference.face_to_cell_vertices(face, 0, 1)].distance(
                   nodes[reference.face_to_cell_vertices(face, 1, 1)]));
    return longest;
  }

  Point<spacedim>
  Discretization::point_inside(const CellPart &part) const
  {
    const Point<dim> unit  = part.inner_point();
    const auto       nodes = geometry_nodes(part);
    Point<spacedim>  x;
    for (unsigned int b = 0; b < nodes.size(); ++b)
      x += geometry_fe().shape_value(b, unit) * nodes[b];
    return x;
  }

  std::vector<Point<spacedim>>
  Discretization::node_positions(const CellPart &part) const
  {
    const auto geometry = geometry_nodes(part);
    if (part.data != nullptr && !part.data->nodes.empty())
      return {geometry.begin(), geometry.end()};
    std::vector<Point<spacedim>> positions(scalar_fe_->n_dofs_per_cell());
    for (unsigned int a = 0; a < positions.size(); ++a)
      for (unsigned int b = 0; b < geometry.size(); ++b)
        positions[a] += geometry_to_nodes_(a, b) * geometry[b];
    return positions;
  }

  std::pair<Point<spacedim>, double>
  Discretization::extent() const
  {
    Point<spacedim> low, high;
    for (unsigned int c = 0; c < spacedim; ++c)
      {
        low[c]  = std::numeric_limits<double>::max();
        high[c] = std::numeric_limits<double>::lowest();
      }
    for (const auto &cell : dof_handler_.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &x : node_positions(cell))
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              low[c]  = std::min(low[c], x[c]);
              high[c] = std::max(high[c], x[c]);
            }
    for (unsigned int c = 0; c < spacedim; ++c)
      {
        low[c]  = Utilities::MPI::min(low[c], communicator());
        high[c] = Utilities::MPI::max(high[c], communicator());
      }
    return {low + 0.5 * (high - low), high.distance(low)};
  }
} // namespace Nacre
