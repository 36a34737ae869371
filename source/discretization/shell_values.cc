// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/shell_strain.h>

#include <deal.II/base/qprojector.h>

namespace Nacre
{
  namespace
  {
    /** The frame at the point @p q. */
    SurfaceFrame<>
    frame_from(const GeometryTable::Values &geometry, const unsigned int q)
    {
      return make_surface_frame(geometry.tangent(q, 0),
                                geometry.tangent(q, 1),
                                geometry.second_derivatives(q));
    }

    /** row = sum of weight times the sample's row, each of @p n numbers. */
    NACRE_SIMD void
    combine(const double                                *samples,
            const std::pair<unsigned int, double> *const weights,
            const unsigned int                           n_weights,
            const unsigned int                           n,
            double                                      *row)
    {
      for (unsigned int i = 0; i < n; ++i)
        row[i] = 0.;
      for (unsigned int k = 0; k < n_weights; ++k)
        {
          const double *const sample = samples + weights[k].first * n;
          const double        weight = weights[k].second;
          for (unsigned int i = 0; i < n; ++i)
            row[i] += weight * sample[i];
        }
    }
  } // namespace

  ShellCellValues::ShellCellValues(const Discretization  &discretization,
                                   const Quadrature<dim> &quadrature,
                                   const bool             tied)
    : discretization_(discretization)
    , quadrature_(quadrature)
    , tied_(tied)
    , tying_(tied ? MembraneTying(discretization.element(),
                                  quadrature.get_points()) :
                    MembraneTying::untied(quadrature.get_points()))
    , shapes_(discretization.scalar_fe(), quadrature.get_points())
    , tying_shapes_(tied ?
                      ShapeTable(discretization.scalar_fe(), tying_.points()) :
                      shapes_)
    , geometry_table_(discretization.geometry_fe(), quadrature.get_points())
    , tying_geometry_table_(
        tied ? GeometryTable(discretization.geometry_fe(), tying_.points()) :
               geometry_table_)
    , frames_(quadrature.size())
    , tying_frames_(tied ? tying_.points().size() : 0)
    , membrane_rows_(3 * quadrature.size(), n_dofs())
    , bending_rows_(3 * quadrature.size(), n_dofs())
    , tying_rows_(tied ? tying_.samples().size() : 0, n_dofs())
  {}

  void
  ShellCellValues::evaluate(
    const Triangulation<dim, spacedim>::cell_iterator &cell)
  {
    const auto nodes = discretization_.geometry_nodes(cell);
    material_id_     = cell->material_id();
    geometry_table_.evaluate(nodes, geometry_);
    for (unsigned int q = 0; q < n_points(); ++q)
      frames_[q] = frame_from(geometry_, q);
    if (tied_)
      tying_geometry_table_.evaluate(nodes, tying_geometry_);
  }

  void
  ShellCellValues::reinit_frames(
    const Triangulation<dim, spacedim>::cell_iterator &cell)
  {
    evaluate(cell);
    for (unsigned int k = 0; k < tying_frames_.size(); ++k)
      tying_frames_[k] = make_surface_frame(tying_geometry_.tangent(k, 0),
                                            tying_geometry_.tangent(k, 1),
                                            {});
  }

  void
  ShellCellValues::reinit(
    const Triangulation<dim, spacedim>::cell_iterator &cell)
  {
    evaluate(cell);
    for (unsigned int k = 0; k < tying_frames_.size(); ++k)
      for (unsigned int alpha = 0; alpha < dim; ++alpha)
        tying_frames_[k].a_cov[alpha] = tying_geometry_.tangent(k, alpha);
    if (tied_)
      fill_tied_membrane_rows();
    else
      fill_membrane_rows();
    fill_bending_rows();
  }

  void
  ShellCellValues::fill_membrane_rows()
  {
    const unsigned int *const dofs = discretization_.node_dofs().data();
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &a_cov  = frames_[q].a_cov;
        double     *row[3] = {&membrane_rows_(3 * q, 0),
                              &membrane_rows_(3 * q + 1, 0),
                              &membrane_rows_(3 * q + 2, 0)};
        for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
          {
            const auto &dN = shapes_.gradient(q, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const unsigned int i = dofs[spacedim * a + c];
                row[0][i]            = a_cov[0][c] * dN[0];
                row[1][i]            = a_cov[1][c] * dN[1];
                row[2][i] = a_cov[0][c] * dN[1] + a_cov[1][c] * dN[0];
              }
          }
      }
  }

  void
  ShellCellValues::fill_tied_membrane_rows()
  {
    const unsigned int *const dofs = discretization_.node_dofs().data();
    for (unsigned int k = 0; k < tying_rows_.m(); ++k)
      {
        const auto &[point, direction] = tying_.samples()[k];
        const auto &[a_1, a_2]         = tying_frames_[point].a_cov;
        double *const row              = &tying_rows_(k, 0);
        // direction . (a_1 N,1, a_2 N,2, a_1 N,2 + a_2 N,1), (3)
        const auto g_1 = direction[0] * a_1 + direction[2] * a_2;
        const auto g_2 = direction[2] * a_1 + direction[1] * a_2;
        for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
          {
            const auto &dN = tying_shapes_.gradient(point, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              row[dofs[spacedim * a + c]] = dN[0] * g_1[c] + dN[1] * g_2[c];
          }
      }
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          const auto &weights = tying_.weights(q, v);
          combine(&tying_rows_(0, 0),
                  weights.data(),
                  weights.size(),
                  tying_rows_.n(),
                  &membrane_rows_(3 * q + v, 0));
        }
  }

  void
  ShellCellValues::fill_bending_rows()
  {
    const unsigned int *const dofs = discretization_.node_dofs().data();
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &t0     = frames_[q].t0;
        double     *row[3] = {&bending_rows_(3 * q, 0),
                              &bending_rows_(3 * q + 1, 0),
                              &bending_rows_(3 * q + 2, 0)};
        for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
          {
            const auto strain =
              ShellStrain::bending_of_shape_function(frames_[q],
                                                     shapes_.gradient(q, a),
                                                     shapes_.hessian(q, a));
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const unsigned int i = dofs[spacedim * a + c];
                for (unsigned int v = 0; v < 3; ++v)
                  row[v][i] = strain[v] * t0[c];
              }
          }
      }
  }

  ShellEdgeValues::Table::Table(const Discretization          &discretization,
                                const std::vector<Point<dim>> &points)
    : points(points)
    , shapes(discretization.scalar_fe(), points)
    , geometry(discretization.geometry_fe(), points)
  {}

  ShellEdgeValues::TyingTable::TyingTable(const Discretization &discretization,
                                          const MembraneTying  &tying)
    : shapes(discretization.scalar_fe(), tying.points())
    , geometry(discretization.geometry_fe(), tying.points())
  {}

  ShellEdgeValues::ShellEdgeValues(const Discretization &discretization)
    : discretization_(discretization)
    , quadrature_(discretization.element().edge_quadrature())
    , JxW_(quadrature_.size())
  {
    make_directions();
    const auto &node_dofs = discretization.node_dofs();
    local_to_node_.resize(node_dofs.size());
    for (unsigned int k = 0; k < node_dofs.size(); ++k)
      local_to_node_[node_dofs[k]] = k;
    for (unsigned int side = 0; side < 2; ++side)
      {
        frames_[side].resize(quadrature_.size());
        conormals_[side].resize(quadrature_.size());
        joint_dofs_[side].resize(discretization.node_dofs().size());
        cell_dofs_[side].resize(discretization.node_dofs().size());
      }
  }

  void
  ShellEdgeValues::make_directions()
  {
    const auto cell = discretization_.element().reference_cell();
    tables_.resize(cell.n_faces());
    for (const auto face : cell.face_indices())
      {
        const Tensor<1, dim> along =
          cell.vertex<dim>(cell.face_to_cell_vertices(face, 1, 1)) -
          cell.vertex<dim>(cell.face_to_cell_vertices(face, 0, 1));
        const auto outward = cell.unit_normal_vectors<dim>(face);
        directions_.push_back(along);
        outward_.push_back(outward[0] * along[1] > outward[1] * along[0] ? 1. :
                                                                           -1.);
      }
  }

  const ShellEdgeValues::Table &
  ShellEdgeValues::table(const unsigned int face, const unsigned int kind)
  {
    auto &table = tables_[face][kind];
    if (!table)
      {
        const auto cell   = discretization_.element().reference_cell();
        auto       points = std::vector<Point<dim>>(quadrature_.size());
        if (kind < 2)
          QProjector<dim>::project_to_subface(cell,
                                              quadrature_,
                                              face,
                                              kind,
                                              points);
        else
          QProjector<dim>::project_to_face(cell, quadrature_, face, points);
        if (kind == 3)
          std::reverse(points.begin(), points.end());
        table.emplace(discretization_, points);
      }
    return *table;
  }

  void
  ShellEdgeValues::reinit(const cell_iterator &cell,
                          const unsigned int   face,
                          const unsigned int   subface,
                          const cell_iterator &neighbor,
                          const unsigned int   neighbor_face,
                          const unsigned int   neighbor_subface)
  {
    n_sides_ = 2;
    update_side(0, cell, face, subface);
    update_side(1, neighbor, neighbor_face, neighbor_subface);
    join_dofs({{cell, neighbor}});
  }

  void
  ShellEdgeValues::reinit(const cell_iterator &cell, const unsigned int face)
  {
    n_sides_ = 1;
    update_side(0, cell, face, numbers::invalid_unsigned_int);
    join_dofs({{cell, cell}});
  }

  bool
  ShellEdgeValues::reinit_to_neighbor(const cell_iterator &cell,
                                      const unsigned int   face)
  {
    if (cell->at_boundary(face) || cell->neighbor(face)->has_children())
      return false;
    const cell_iterator neighbor = cell->neighbor(face);
    const unsigned int  whole    = numbers::invalid_unsigned_int;
    if (cell->neighbor_is_coarser(face))
      {
        const auto [back, subface] = cell->neighbor_of_coarser_neighbor(face);
        reinit(cell, face, whole, neighbor, back, subface);
      }
    else
      reinit(cell,
             face,
             whole,
             neighbor,
             cell->neighbor_of_neighbor(face),
             whole);
    return true;
  }

  void
  ShellEdgeValues::update_side(const unsigned int   side,
                               const cell_iterator &cell,
                               const unsigned int   face,
                               const unsigned int   subface)
  {
    const bool         whole = (subface == numbers::invalid_unsigned_int);
    const unsigned int kind =
      whole ? (cell->face_orientation(face) ? 2 : 3) : subface;
    const Table &points          = table(face, kind);
    auto        &geometry        = geometry_[side];
    table_of_side_[side]         = {face, kind};
    material_ids_[side]          = cell->material_id();
    cells_[side]                 = cell;
    tied_sides_[side].has_frames = tied_sides_[side].has_rows = false;
    points.geometry.evaluate(discretization_.geometry_nodes(cell), geometry);

    const Tensor<1, dim> along = directions_[face];
    // nu^- = n^-, nu^+ = -n^+
    const double sign = outward_[face] * (side == 0 ? 1. : -1.);
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &frame = frames_[side][q] = frame_from(geometry, q);
        const auto  tangent =
          along[0] * frame.a_cov[0] + along[1] * frame.a_cov[1];
        const double length = tangent.norm();
        conormals_[side][q] =
          (sign / length) * cross_product_3d(tangent, frame.t0);
        if (side == 0)
          JxW_[q] = (whole ? 1. : 0.5) * length * quadrature_.weight(q);
      }
  }

  void
  ShellEdgeValues::join_dofs(const std::array<cell_iterator, 2> &cells)
  {
    const auto        &node_dofs = discretization_.node_dofs();
    const unsigned int n         = node_dofs.size();
    cells[0]->get_dof_indices(cell_dofs_[0]);
    dof_indices_   = cell_dofs_[0];
    joint_dofs_[0] = node_dofs;
    if (n_sides_ == 1)
      return;

    // Shared nodes lie on the boundary of both cells; they come first.
    const auto        &fe       = discretization_.scalar_fe();
    const unsigned int n_shared = fe.n_dofs_per_cell() - fe.n_dofs_per_quad();
    cells[1]->get_dof_indices(cell_dofs_[1]);
    auto &joint = joint_dofs_[1];
    std::fill(joint.begin(), joint.end(), numbers::invalid_unsigned_int);
    for (unsigned int b = 0; b < n_shared; ++b)
      {
        const auto dof = cell_dofs_[1][node_dofs[spacedim * b]];
        for (unsigned int a = 0; a < n_shared; ++a)
          if (cell_dofs_[0][node_dofs[spacedim * a]] == dof)
            for (unsigned int c = 0; c < spacedim; ++c)
              joint[spacedim * b + c] = node_dofs[spacedim * a + c];
      }
    // The neighbour's other dofs, in its own order.
    for (unsigned int i = 0; i < n; ++i)
      if (joint[local_to_node_[i]] == numbers::invalid_unsigned_int)
        {
          joint[local_to_node_[i]] = dof_indices_.size();
          dof_indices_.push_back(cell_dofs_[1][i]);
        }
  }

  const MembraneTying &
  ShellEdgeValues::tying(const unsigned int side) const
  {
    const auto [face, kind] = table_of_side_[side];
    const auto found        = tyings_.find(table_of_side_[side]);
    if (found != tyings_.end())
      return found->second;
    const MembraneTying &tying = tyings_
                                   .try_emplace(table_of_side_[side],
                                                discretization_.element(),
                                                tables_[face][kind]->points)
                                   .first->second;
    // The samples are the same for all points of a cell.
    if (!tying_table_)
      tying_table_.emplace(discretization_, tying);
    return tying;
  }

  const std::vector<SurfaceFrame<>> &
  ShellEdgeValues::tying_frames(const unsigned int side) const
  {
    TiedSide &tied = tied_sides_[side];
    if (tied.has_frames)
      return tied.frames;
    tied.has_frames = true;
    tied.frames.resize(tying(side).points().size());
    tying_table_->geometry.evaluate(discretization_.geometry_nodes(
                                      cells_[side]),
                                    tied.geometry);
    for (unsigned int k = 0; k < tied.frames.size(); ++k)
      tied.frames[k] = make_surface_frame(tied.geometry.tangent(k, 0),
                                          tied.geometry.tangent(k, 1),
                                          {});
    return tied.frames;
  }

  const FullMatrix<double> &
  ShellEdgeValues::tied_membrane_rows(const unsigned int side) const
  {
    TiedSide &tied = tied_sides_[side];
    if (tied.has_rows)
      return tied.rows;
    tied.has_rows              = true;
    const auto        &frames  = tying_frames(side);
    const auto        &samples = tying(side).samples();
    const auto        &shapes  = tying_table_->shapes;
    const unsigned int n       = spacedim * shapes.n_nodes();
    tied.samples.reinit(samples.size(), n, true);
    for (unsigned int s = 0; s < samples.size(); ++s)
      {
        const auto &[point, direction] = samples[s];
        const auto &[a_1, a_2]         = frames[point].a_cov;
        // As in ShellCellValues::fill_tied_membrane_rows()
        const auto g_1 = direction[0] * a_1 + direction[2] * a_2;
        const auto g_2 = direction[2] * a_1 + direction[1] * a_2;
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          {
            const auto &dN = shapes.gradient(point, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              tied.samples(s, spacedim * a + c) =
                dN[0] * g_1[c] + dN[1] * g_2[c];
          }
      }
    tied.rows.reinit(3 * n_points(), n, true);
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          const auto &weights = tying(side).weights(q, v);
          combine(&tied.samples(0, 0),
                  weights.data(),
                  weights.size(),
                  n,
                  &tied.rows(3 * q + v, 0));
        }
    return tied.rows;
  }

  double
  ShellEdgeValues::sigma(const unsigned int side, const unsigned int q) const
  {
    if (side == 0)
      return 1.;
    const auto direction = [&](const unsigned int s) {
      return cross_product_3d(conormals_[s][q], frames_[s][q].t0);
    };
    return direction(1) * direction(0) > 0. ? 1. : -1.;
  }
} // namespace Nacre
