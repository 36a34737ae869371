// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_quadrature.h>
#include <nacre/discretization/part_tying.h>
#include <nacre/discretization/shell_edge_values.h>

#include <deal.II/base/qprojector.h>

#include <algorithm>

namespace Nacre
{
  ShellEdgeValues::Table::Table(const Discretization          &discretization,
                                const std::vector<Point<dim>> &points)
    : points(points)
    , shapes(discretization.scalar_fe(), points)
    , geometry(discretization.geometry_fe(), points)
  {}

  ShellEdgeValues::ShellEdgeValues(const Discretization &discretization)
    : discretization_(discretization)
    , quadrature_(discretization.element().edge_quadrature())
  {
    resize();
    make_directions();
    const auto &node_dofs = discretization.node_dofs();
    local_to_node_.resize(node_dofs.size());
    for (unsigned int k = 0; k < node_dofs.size(); ++k)
      local_to_node_[node_dofs[k]] = k;
    for (unsigned int side = 0; side < 2; ++side)
      {
        joint_dofs_[side].resize(discretization.node_dofs().size());
        cell_dofs_[side].resize(discretization.node_dofs().size());
      }
  }

  void
  ShellEdgeValues::resize()
  {
    JxW_.resize(n_points());
    for (unsigned int side = 0; side < 2; ++side)
      {
        frames_[side].resize(n_points());
        conormals_[side].resize(n_points());
      }
  }

  EdgePiece::Side
  ShellEdgeValues::whole_side(const CellPart    &part,
                              const unsigned int face) const
  {
    EdgePiece::Side side;
    side.part = part;
    side.face = face;
    if (!part.cell->face_orientation(face))
      side.interval = {{1., 0.}};
    return side;
  }

  void
  ShellEdgeValues::use_rule(const std::optional<Quadrature<1>> &tip_rule)
  {
    if (!tip_rule_ && !tip_rule)
      return;
    tip_rule_ = tip_rule;
    resize();
  }

  void
  ShellEdgeValues::choose_rule(const EdgePiece &piece)
  {
    const auto cell = discretization_.element().reference_cell();
    std::optional<Quadrature<1>> rule;
    for (unsigned int side = 0; side < piece.n_sides && !rule; ++side)
      {
        const auto &[part, face, interval] = piece.sides[side];
        if (enrichment_of(part) == nullptr)
          continue;
        const auto start =
          cell.vertex<dim>(cell.face_to_cell_vertices(face, 0, 1));
        rule = enriched_edge_quadrature(*part.enrichment(),
                                        start + interval[0] * directions_[face],
                                        start + interval[1] * directions_[face],
                                        discretization_.degree());
      }
    use_rule(rule);
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
    const CellParts &parts = discretization_.cell_parts();
    if (discretization_.has_tip_functions() &&
        (enrichment_of(parts.part(cell)) != nullptr ||
         enrichment_of(parts.part(neighbor)) != nullptr))
      {
        EdgePiece piece;
        piece.n_sides = 2;
        piece.sides   = {{whole_side(parts.part(cell), face),
                          whole_side(parts.part(neighbor), neighbor_face)}};
        reinit(piece);
        return;
      }
    use_rule({});
    n_sides_ = 2;
    update_side(0, parts.part(cell), face, subface);
    update_side(1, parts.part(neighbor), neighbor_face, neighbor_subface);
    join_dofs();
  }

  void
  ShellEdgeValues::reinit(const cell_iterator &cell, const unsigned int face)
  {
    const CellPart part = discretization_.cell_parts().part(cell);
    if (enrichment_of(part) != nullptr)
      {
        EdgePiece piece;
        piece.sides[0] = whole_side(part, face);
        reinit(piece);
        return;
      }
    use_rule({});
    n_sides_ = 1;
    update_side(0, part, face, numbers::invalid_unsigned_int);
    join_dofs();
  }

  void
  ShellEdgeValues::reinit(const EdgePiece &piece)
  {
    choose_rule(piece);
    n_sides_ = piece.n_sides;
    for (unsigned int side = 0; side < n_sides_; ++side)
      update_side(side, piece.sides[side]);
    join_dofs();
  }

  void
  ShellEdgeValues::reinit_lip(const CellPart &part, const CutLip &lip)
  {
    std::optional<Quadrature<1>> tip_rule;
    if (const auto *const enrichment = enrichment_of(part))
      tip_rule = enriched_edge_quadrature(*enrichment,
                                          lip.begin,
                                          lip.begin + lip.along,
                                          discretization_.degree());
    use_rule(tip_rule);
    std::vector<Point<dim>> points;
    for (const auto &x : rule().get_points())
      points.push_back(lip.begin + x[0] * lip.along);
    n_sides_ = 1;
    piece_tables_[0].emplace(discretization_, points);
    table_of_side_[0] = {numbers::invalid_unsigned_int, piece_kind};
    parts_[0]         = part;
    evaluate(0, lip.along, 1., 1., true);
    join_dofs();
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
  ShellEdgeValues::update_side(const unsigned int side,
                               const CellPart    &part,
                               const unsigned int face,
                               const unsigned int subface)
  {
    const bool         whole = (subface == numbers::invalid_unsigned_int);
    const unsigned int kind =
      whole ? (part.cell->face_orientation(face) ? 2 : 3) : subface;
    table(face, kind);
    table_of_side_[side] = {face, kind};
    parts_[side]         = part;
    evaluate(side, directions_[face], outward_[face], whole ? 1. : 0.5);
  }

  void
  ShellEdgeValues::update_side(const unsigned int     side,
                               const EdgePiece::Side &piece)
  {
    const auto cell = discretization_.element().reference_cell();
    const auto start =
      cell.vertex<dim>(cell.face_to_cell_vertices(piece.face, 0, 1));
    const auto &[s_0, s_1] = piece.interval;
    std::vector<Point<dim>> points;
    for (const auto &x : rule().get_points())
      points.push_back(start +
                       (s_0 + x[0] * (s_1 - s_0)) * directions_[piece.face]);
    piece_tables_[side].emplace(discretization_, points);
    table_of_side_[side] = {piece.face, piece_kind};
    parts_[side]         = piece.part;
    evaluate(side,
             directions_[piece.face],
             outward_[piece.face],
             std::abs(s_1 - s_0));
  }

  void
  ShellEdgeValues::evaluate(const unsigned int    side,
                            const Tensor<1, dim> &along,
                            const double          outward,
                            const double          share,
                            const bool            is_lip)
  {
    auto &geometry               = geometry_[side];
    material_ids_[side]          = parts_[side].cell->material_id();
    tied_sides_[side].has_frames = tied_sides_[side].has_rows = false;
    tied_sides_[side].tying.reset();
    tied_sides_[side].table.reset();
    table_of(side).geometry.evaluate(discretization_.geometry_nodes(
                                       parts_[side]),
                                     geometry);

    // nu^- = n^-, nu^+ = -n^+
    const double sign = outward * (side == 0 ? 1. : -1.);
    for (unsigned int q = 0; q < n_points(); ++q)
      {
        const auto &frame = frames_[side][q] = geometry.frame(q);
        const auto  tangent =
          along[0] * frame.a_cov[0] + along[1] * frame.a_cov[1];
        const double length = tangent.norm();
        conormals_[side][q] =
          (sign / length) * cross_product_3d(tangent, frame.t0);
        if (side == 0)
          JxW_[q] = share * length * rule().weight(q);
      }
    evaluate_tip_functions(side, is_lip ? along : Tensor<1, dim>());
  }

  void
  ShellEdgeValues::evaluate_tip_functions(const unsigned int    side,
                                          const Tensor<1, dim> &lip)
  {
    tip_functions_[side].clear();
    const PartEnrichment *const enrichment = enrichment_of(parts_[side]);
    tip_dofs_[side].resize(enrichment != nullptr ? enrichment->n_functions() :
                                                   0);
    if (enrichment == nullptr)
      return;
    const Table &table = table_of(side);
    for (unsigned int q = 0; q < n_points(); ++q)
      enrichment->evaluate(table.shapes,
                           geometry_[side],
                           q,
                           table.points[q],
                           tip_functions_[side],
                           lip);
    if (enrichment->has_scalars())
      piece_tables_[side]->shapes.append_functions(tip_functions_[side]);
  }

  void
  ShellEdgeValues::join_dofs()
  {
    const auto        &node_dofs = discretization_.node_dofs();
    const unsigned int n         = node_dofs.size();
    discretization_.get_dof_indices(parts_[0], cell_dofs_[0]);
    dof_indices_   = cell_dofs_[0];
    joint_dofs_[0] = node_dofs;
    for (unsigned int k = 0; k < tip_dofs_[0].size(); ++k)
      tip_dofs_[0][k] = n + k;
    if (n_sides_ == 1)
      return move_scalar_dofs();

    // Shared nodes lie on the boundary of both cells; they come first.
    const auto        &fe       = discretization_.scalar_fe();
    const unsigned int n_shared = fe.n_dofs_per_cell() - fe.n_dofs_per_quad();
    discretization_.get_dof_indices(parts_[1], cell_dofs_[1]);
    auto &joint = joint_dofs_[1];
    joint.assign(n, numbers::invalid_unsigned_int);
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
    join_tip_dofs();
    move_scalar_dofs();
  }

  void
  ShellEdgeValues::join_tip_dofs()
  {
    const unsigned int n = local_to_node_.size();
    for (unsigned int k = 0; k < tip_dofs_[1].size(); ++k)
      {
        // Both sides may have the functions of one tip.
        const auto dof   = cell_dofs_[1][n + k];
        const auto begin = cell_dofs_[0].begin();
        const auto found = std::find(begin + n, cell_dofs_[0].end(), dof);
        if (found == cell_dofs_[0].end())
          {
            tip_dofs_[1][k] = dof_indices_.size();
            dof_indices_.push_back(dof);
          }
        else
          tip_dofs_[1][k] = found - begin;
      }
  }

  void
  ShellEdgeValues::move_scalar_dofs()
  {
    for (unsigned int side = 0; side < n_sides_; ++side)
      {
        auto &of_tips = tip_dofs_[side];
        if (of_tips.empty() || !enrichment_of(parts_[side])->has_scalars())
          continue;
        auto &joint = joint_dofs_[side];
        joint.insert(joint.end(), of_tips.begin(), of_tips.end());
        of_tips.clear();
      }
  }

  const MembraneTying &
  ShellEdgeValues::piece_tying(const unsigned int side) const
  {
    auto &tying = tied_sides_[side].tying;
    if (tying)
      return *tying;
    const CellPart &part   = parts_[side];
    const auto     &points = table_of(side).points;
    if (enrichment_of(part) != nullptr)
      tying = MembraneTying::untied(points);
    else if (part.is_cut())
      tying =
        part_tying(discretization_,
                   part,
                   part_quadrature(part.polygon(), discretization_.degree()),
                   points);
    else
      tying.emplace(discretization_.element(), points);
    return *tying;
  }

  const MembraneTying &
  ShellEdgeValues::tying(const unsigned int side) const
  {
    if (table_of_side_[side].second == piece_kind)
      return piece_tying(side);
    return tyings_
      .try_emplace(table_of_side_[side],
                   discretization_.element(),
                   table_of(side).points)
      .first->second;
  }

  const ShellEdgeValues::Table &
  ShellEdgeValues::tying_table(const unsigned int side) const
  {
    const CellPart &part = parts_[side];
    if (enrichment_of(part) != nullptr)
      return table_of(side);
    // The samples are the same for all points of a whole cell.
    auto &table = part.is_cut() ? tied_sides_[side].table : tying_table_;
    if (!table)
      table.emplace(discretization_, tying(side).points());
    return *table;
  }

  const std::vector<SurfaceFrame<>> &
  ShellEdgeValues::tying_frames(const unsigned int side) const
  {
    TiedSide &tied = tied_sides_[side];
    if (tied.has_frames)
      return tied.frames;
    tied.has_frames = true;
    tied.frames.resize(tying(side).points().size());
    tying_table(side).geometry.evaluate(discretization_.geometry_nodes(
                                          parts_[side]),
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
    const auto        &shapes  = tying_shapes(side);
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
    tying(side).sum_rows(tied.samples);
    tied.rows.reinit(3 * n_points(), n, true);
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        combine(tied.samples,
                tying(side).weights(q, v),
                &tied.rows(3 * q + v, 0));
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
