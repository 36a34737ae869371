// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/discretization/plane_geometry.h>
#include <nacre/discretization/tip_frame.h>
#include <nacre/discretization/tip_openings.h>
#include <nacre/mechanics/tip_jump.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** How far the cut may leave the tip's line, in units of its length. */
    constexpr double straight_cut = 0.02;

    /** Errors of the values 0 and 1 up to which functions are taken. */
    constexpr double largest_residual = 0.05;

    /** The point of a quadrilateral's face at the coordinate @p s. */
    Point<dim>
    point_on_face(const unsigned int face, const double s)
    {
      Point<dim> x;
      x[face / 2]     = face % 2;
      x[1 - face / 2] = s;
      return x;
    }

    /** Those of the nodes @p open that lie on a face with the @p nodes. */
    std::vector<unsigned int>
    nodes_on_face(const std::vector<PartEnrichment::Share::OpenNode> &open,
                  const std::vector<unsigned int>                    &nodes)
    {
      std::vector<unsigned int> result;
      for (const auto &node : open)
        if (std::find(nodes.begin(), nodes.end(), node.node) != nodes.end())
          result.push_back(node.node);
      return result;
    }

    /** The conditions of psi_i on the edges of a cell, in the tip's plane. */
    class JumpEdges
    {
    public:
      /** @param size (length) the unit of the moments */
      JumpEdges(const FiniteElement<dim, spacedim> &scalar_fe,
                const std::vector<Point<spacedim>> &nodes,
                const TipFunctions::Tip            &frame,
                const double                        size)
        : scalar_fe_(scalar_fe)
        , nodes_(nodes)
        , frame_(frame)
        , size_(size)
        , center_(surface_at(scalar_fe, nodes, Point<dim>(0.5, 0.5)).value)
      {}

      /**
       * The @p value, none: natural conditions, on an interval of a face.
       * @param open nodes that have the function there. Stresses that are
       *   constant do no work on the errors of the fit: its moments with the
       *   shape functions of these nodes are to vanish.
       */
      void
      add(const unsigned int               face,
          const std::pair<double, double> &interval,
          const std::optional<double>      value,
          const std::vector<unsigned int> &open)
      {
        const QGauss<1>                  rule(40);
        std::vector<std::vector<double>> moments(
          open.size(),
          std::vector<double>(points_.size(), 0.));
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto [begin, end] = interval;
            const auto unit =
              point_on_face(face, begin + rule.point(q)[0] * (end - begin));
            const double length = add_point(face, unit, value);
            for (unsigned int k = 0; k < open.size(); ++k)
              moments[k].push_back(rule.weight(q) * length / size_ *
                                   scalar_fe_.shape_value(open[k], unit));
          }
        moments_.insert(moments_.end(), moments.begin(), moments.end());
        for (auto &weights : moments_)
          weights.resize(points_.size(), 0.);
      }

      const std::vector<JumpBoundaryPoint> &
      points() const
      {
        return points_;
      }

      const JumpMoments &
      moments() const
      {
        return moments_;
      }

    private:
      /** Returns the length of the face's tangent. */
      double
      add_point(const unsigned int          face,
                const Point<dim>           &unit,
                const std::optional<double> value)
      {
        const auto  x       = surface_at(scalar_fe_, nodes_, unit);
        const auto  d       = x.value - Tensor<1, spacedim>(frame_.position);
        const auto  outward = x.value - center_;
        const auto &tangent = x.first[1 - face / 2];
        const auto &e       = frame_.axes;
        double      n_x = tangent * e[1], n_y = -(tangent * e[0]);
        const bool  is_outward =
          n_x * (outward * e[0]) + n_y * (outward * e[1]) > 0.;
        const double scale = (is_outward ? 1. : -1.) / std::hypot(n_x, n_y);
        points_.push_back(
          {d * e[0], d * e[1], scale * n_x, scale * n_y, value});
        return tangent.norm();
      }

      const FiniteElement<dim, spacedim> &scalar_fe_;
      const std::vector<Point<spacedim>> &nodes_;
      const TipFunctions::Tip            &frame_;
      const double                        size_;
      const Tensor<1, spacedim>           center_;
      std::vector<JumpBoundaryPoint>      points_;
      JumpMoments                         moments_;
    };
  } // namespace

  TipOpenings::TipOpenings(const MeshNodes                  &mesh,
                           const Cuts                       &cuts,
                           const std::vector<CutTrace::Tip> &tips,
                           const CellParts                  &parts)
    : TipDofs(mesh.dof_handler.get_communicator(), tips.size())
    , mesh_(mesh)
    , tips_(tips)
    , parts_(parts)
    , openings_(tips.size())
  {
    AssertThrow(mesh.scalar_fe.reference_cell() ==
                  ReferenceCells::Quadrilateral,
                ExcMessage("Cuts/Tips: harmonic functions are those of "
                           "quadrilaterals; choose 'closed' or 'branch "
                           "functions' for triangles."));
    run_on_all_ranks(communicator_, [&]() {
      for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
        for (unsigned int t = 0; t < tips_.size(); ++t)
          if (cell->is_locally_owned() && cell->id() == tips_[t].cell)
            {
              Opening &opening  = openings_[t];
              ranges_[t].owner  = cell->subdomain_id();
              opening.cell      = cell;
              opening.is_inside = parts_.n_parts(cell) != 1 ||
                                  holds_tip(tips_[t], parts_.part(cell));
              opening.is_open = opening.is_inside &&
                                find_entry(t, cell, opening.entry) &&
                                fit(t, cuts, cell);
            }
    });
    share();
    // The edges of ghosts are those of this rank's cells, too.
    run_on_all_ranks(communicator_, [&]() {
      for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
        for (unsigned int t = 0; t < tips_.size(); ++t)
          if (cell->is_ghost() && openings_[t].is_open &&
              cell->id() == tips_[t].cell)
            fit(t, cuts, cell);
    });
  }

  bool
  TipOpenings::find_entry(const unsigned int t,
                          const Cell        &cell,
                          Entry             &entry) const
  {
    // Other cuts in the cell, and other tips
    if (parts_.n_parts(cell) != 1 || parts_.is_cut(cell))
      return false;
    for (unsigned int s = 0; s < tips_.size(); ++s)
      if (s != t && tips_[s].cell == tips_[t].cell)
        return false;
    if (!find_edge(t, cell, entry) && !find_vertex(t, cell, entry))
      return false;
    const auto nodes = mesh_.positions(parts_.part(cell));
    const auto x     = surface_at(mesh_.scalar_fe, nodes, tips_[t].unit);
    const auto back  = backward_from_tip(tip_frame(tips_[t], x), x);
    const auto d     = entry.place - tips_[t].unit;
    return d * back > 0. && std::abs(d[0] * back[1] - d[1] * back[0]) <
                              straight_cut * std::max(d.norm(), 0.1);
  }

  bool
  TipOpenings::find_edge(const unsigned int t,
                         const Cell        &cell,
                         Entry             &entry) const
  {
    std::vector<unsigned int> faces;
    for (const auto face : cell->face_indices())
      if (!cell->at_boundary(face) && parts_.has_pieces(cell, face) &&
          parts_.pieces_between(cell, face).size() != 1)
        faces.push_back(face);
    if (faces.size() != 1)
      return false;
    entry.face  = faces[0];
    auto pieces = parts_.pieces_between(cell, entry.face);
    if (pieces.size() != 2)
      return false;
    std::sort(pieces.begin(), pieces.end(), [](const auto &a, const auto &b) {
      return a.sides[0].interval[0] < b.sides[0].interval[0];
    });
    const double crossing = pieces[1].sides[0].interval[0];
    if (pieces[0].sides[1].part.index() == pieces[1].sides[1].part.index() ||
        std::abs(pieces[0].sides[0].interval[1] - crossing) >
          PlaneGeometry::snap_distance)
      return false;
    entry.place = point_on_face(entry.face, crossing);
    for (const unsigned int a : mesh_.face_nodes[entry.face])
      {
        const auto  &x     = mesh_.scalar_fe.unit_support_point(a);
        const bool   here  = x[1 - entry.face / 2] < crossing;
        const auto  &other = pieces[here ? 1 : 0].sides;
        const double s = 0.5 * (other[0].interval[0] + other[0].interval[1]);
        entry.nodes.push_back(
          {a, is_left(t, entry.place, point_on_face(entry.face, s))});
        entry.faces.push_back(entry.face);
        entry.parts.push_back(other[1].part.data->number);
      }
    return true;
  }

  bool
  TipOpenings::find_vertex(const unsigned int t,
                           const Cell        &cell,
                           Entry             &entry) const
  {
    for (const auto face : cell->face_indices())
      if (!cell->at_boundary(face) && parts_.has_pieces(cell, face) &&
          parts_.pieces_between(cell, face).size() != 1)
        return false;
    const auto nodes = mesh_.positions(parts_.part(cell));
    const auto x     = surface_at(mesh_.scalar_fe, nodes, tips_[t].unit);
    const auto back  = backward_from_tip(tip_frame(tips_[t], x), x);
    double     best  = -1.;
    for (unsigned int v = 0; v < 4; ++v)
      {
        const Point<dim> vertex(v % 2, v / 2);
        const auto       d = vertex - tips_[t].unit;
        if (d * back / d.norm() < best)
          continue;
        best        = d * back / d.norm();
        entry       = Entry();
        entry.place = vertex;
        // The first nodes of a cell are those of its vertices.
        for (const unsigned int face : {v % 2, 2 + v / 2})
          if (!is_left(t, vertex, point_on_face(face, 0.5)) &&
              !cell->at_boundary(face))
            {
              entry.nodes = {{v, false}};
              entry.faces = {face};
              entry.parts = {0};
              if (parts_.has_pieces(cell, face))
                entry.parts[0] = parts_.pieces_between(cell, face)[0]
                                   .sides[1]
                                   .part.data->number;
            }
      }
    return !entry.nodes.empty();
  }

  bool
  TipOpenings::is_left(const unsigned int t,
                       const Point<dim>  &entry,
                       const Point<dim>  &x) const
  {
    return PlaneGeometry::twice_area(entry, tips_[t].unit, x) > 0.;
  }

  std::vector<unsigned int>
  TipOpenings::adjacent_faces(const Entry &entry)
  {
    if (entry.face == numbers::invalid_unsigned_int)
      return {entry.place[0] > 0.5 ? 1u : 0u, entry.place[1] > 0.5 ? 3u : 2u};
    const unsigned int first = 2 - 2 * (entry.face / 2);
    return {first, first + 1};
  }

  bool
  TipOpenings::fit(const unsigned int t, const Cuts &cuts, const Cell &cell)
  {
    const Entry &entry = openings_[t].entry;
    const auto   nodes = mesh_.positions(parts_.part(cell));
    const auto   frame =
      tip_frame(tips_[t], surface_at(mesh_.scalar_fe, nodes, tips_[t].unit));
    const auto side_value = [&](const unsigned int face, const double s) {
      return is_left(t, entry.place, point_on_face(face, s)) ? 1. : 0.;
    };
    JumpEdges  edges(mesh_.scalar_fe, nodes, frame, cell->diameter());
    const auto adjacent = adjacent_faces(entry);
    for (unsigned int face = 0; face < 4; ++face)
      {
        const auto open = nodes_on_face(entry.nodes, mesh_.face_nodes[face]);
        const bool is_adjacent =
          std::find(adjacent.begin(), adjacent.end(), face) != adjacent.end();
        if (face == entry.face)
          {
            const double s = entry.place[1 - face / 2];
            edges.add(face, {0., s}, side_value(face, 0.), open);
            edges.add(face, {s, 1.}, side_value(face, 1.), open);
          }
        else if (!is_adjacent)
          edges.add(face, {0., 1.}, std::nullopt, {});
        else if (entry.face != numbers::invalid_unsigned_int)
          edges.add(face, {0., 1.}, side_value(entry.face, face % 2), open);
        else
          edges.add(face, {0., 1.}, side_value(face, 0.5), open);
      }
    const JumpFunction tangential =
      harmonic_jump(edges.points(), edges.moments());
    JumpFunction normal = tangential;
    if (cuts.tips == CutTips::harmonic)
      normal =
        biharmonic_jump(edges.points(),
                        cuts.poissons_ratio(SectionPoint(tips_[t].position,
                                                         cell->material_id()),
                                            frame.axes[0],
                                            frame.axes[1]));
    const bool fits =
      std::max(tangential.residual, normal.residual) < largest_residual;
    if (cuts.tips_turn)
      {
        // One function for all directions: that which can bend.
        openings_[t].functions =
          std::make_shared<const TipFunctions>(frame,
                                               std::vector<PolarSeries>{
                                                 normal.psi},
                                               cell->diameter());
        return fits;
      }
    std::vector<WilliamsField> fields;
    for (unsigned int i = 0; i < spacedim; ++i)
      {
        std::array<PolarSeries, 3> components;
        components[i] = i == 2 ? normal.psi : tangential.psi;
        fields.emplace_back(components);
      }
    openings_[t].functions =
      std::make_shared<const TipFunctions>(frame, fields, cell->diameter());
    return fits;
  }

  void
  TipOpenings::share()
  {
    const auto       me = Utilities::MPI::this_mpi_process(communicator_);
    std::vector<Dof> dofs(mesh_.node_dofs.size());
    std::vector<std::vector<double>> mine;
    for (unsigned int t = 0; t < tips_.size(); ++t)
      {
        const Opening &opening = openings_[t];
        if (ranges_[t].owner != me)
          continue;
        const Entry &entry = opening.entry;
        mine.push_back({static_cast<double>(t),
                        opening.is_inside ? 1. : 0.,
                        opening.is_open ? 1. : 0.,
                        static_cast<double>(entry.face),
                        entry.place[0],
                        entry.place[1]});
        opening.cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < entry.nodes.size(); ++k)
          for (const double number :
               {static_cast<double>(entry.nodes[k].node),
                entry.nodes[k].opens_left ? 1. : 0.,
                static_cast<double>(entry.faces[k]),
                static_cast<double>(entry.parts[k]),
                static_cast<double>(
                  dofs[mesh_.node_dofs[spacedim * entry.nodes[k].node]])})
            mine.back().push_back(number);
      }
    const auto all = Utilities::MPI::all_gather(communicator_, mine);
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (const auto &message : all[rank])
        {
          const auto t     = static_cast<unsigned int>(message[0]);
          Opening   &here  = openings_[t];
          ranges_[t].owner = rank;
          here.is_inside   = message[1] > 0.;
          here.is_open     = message[2] > 0.;
          Entry entry;
          entry.face  = static_cast<unsigned int>(message[3]);
          entry.place = Point<dim>(message[4], message[5]);
          for (unsigned int k = 6; k < message.size(); k += 5)
            {
              entry.nodes.push_back(
                {static_cast<unsigned int>(message[k]), message[k + 1] > 0.});
              entry.faces.push_back(static_cast<unsigned int>(message[k + 2]));
              entry.parts.push_back(static_cast<unsigned int>(message[k + 3]));
              if (here.is_open)
                split_nodes_.insert(tips_[t].cell,
                                    entry.faces.back(),
                                    entry.parts.back(),
                                    static_cast<Dof>(message[k + 4]));
            }
          here.entry = entry;
          if (here.is_open)
            ranges_[t].n_functions = spacedim * entry.nodes.size();
        }
  }

  void
  TipOpenings::complete(const std::vector<Dof> &ends, CellParts &parts)
  {
    number(ends);
    for (const auto &cell : parts.touched_cells())
      for (unsigned int t = 0; t < tips_.size(); ++t)
        if (openings_[t].is_open && cell->id() == tips_[t].cell)
          complete_cell(t, cell, parts);

    std::vector<Dof> mine;
    for (const Opening &opening : openings_)
      for (const auto &pair : opening.copies)
        for (const auto &node : pair)
          mine.insert(mine.end(), node.begin(), node.end());
    masters_.set_size(ends.back());
    for (auto &of_rank : Utilities::MPI::all_gather(communicator_, mine))
      {
        std::sort(of_rank.begin(), of_rank.end());
        masters_.add_indices(of_rank.begin(), of_rank.end());
      }
    masters_.compress();
  }

  void
  TipOpenings::complete_cell(const unsigned int t,
                             const Cell        &cell,
                             CellParts         &parts)
  {
    Opening              &opening = openings_[t];
    PartData             &data    = parts.parts(cell)[0];
    PartEnrichment::Share share;
    share.functions  = opening.functions;
    share.is_near    = true;
    share.holds_tip  = true;
    share.cut        = tips_[t].cut;
    share.at_end     = tips_[t].at_end;
    share.tip        = tips_[t].unit;
    share.open_nodes = opening.entry.nodes;
    share.backward =
      backward_from_tip(opening.functions->tip(),
                        surface_at(mesh_.scalar_fe,
                                   mesh_.positions(CellPart(cell, &data)),
                                   share.tip));

    std::vector<Dof> dofs(mesh_.node_dofs.size()),
      behind(mesh_.node_dofs.size());
    cell->get_dof_indices(dofs);
    opening.copies.clear();
    const Entry &entry = opening.entry;
    for (unsigned int k = 0; k < entry.nodes.size() && cell->is_locally_owned();
         ++k)
      {
        const unsigned int a        = entry.nodes[k].node;
        const Cell         neighbor = cell->neighbor(entry.faces[k]);
        const PartData    &other    = parts.parts(neighbor)[entry.parts[k]];
        neighbor->get_dof_indices(behind);
        std::array<std::array<Dof, spacedim>, 2> copies;
        for (unsigned int b = 0; b < mesh_.node_dofs.size() / spacedim; ++b)
          if (behind[mesh_.node_dofs[spacedim * b]] ==
              dofs[mesh_.node_dofs[spacedim * a]])
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                copies[0][c] = data.dofs[mesh_.node_dofs[spacedim * a + c]];
                copies[1][c] = other.dofs[mesh_.node_dofs[spacedim * b + c]];
              }
        opening.copies.push_back(copies);
      }
    for (unsigned int k = 0; k < ranges_[t].n_functions; ++k)
      data.dofs.push_back(ranges_[t].first + k);
    auto enrichment = std::make_shared<PartEnrichment>();
    enrichment->shares.push_back(share);
    data.enrichment = enrichment;
  }

  void
  TipOpenings::add_to(AffineConstraints<double> &constraints) const
  {
    for (unsigned int t = 0; t < openings_.size(); ++t)
      for (unsigned int k = 0; k < openings_[t].copies.size(); ++k)
        for (unsigned int i = 0; i < spacedim; ++i)
          {
            const auto line           = ranges_[t].first + spacedim * k + i;
            const auto e              = openings_[t].functions->direction(i);
            const auto &[here, other] = openings_[t].copies[k];
            constraints.add_line(line);
            for (unsigned int c = 0; c < spacedim; ++c)
              if (here[c] != other[c] && e[c] != 0.)
                {
                  constraints.add_entry(line, other[c], e[c]);
                  constraints.add_entry(line, here[c], -e[c]);
                }
          }
  }

  bool
  TipOpenings::opens(const CutTrace::Tip &tip) const
  {
    for (unsigned int t = 0; t < tips_.size(); ++t)
      if (tips_[t].cut == tip.cut && tips_[t].at_end == tip.at_end)
        return openings_[t].is_open || !openings_[t].is_inside;
    return false;
  }

  std::vector<std::string>
  TipOpenings::remarks(const Cuts &cuts) const
  {
    std::vector<std::string> result;
    for (unsigned int t = 0; t < tips_.size(); ++t)
      if (!opens(tips_[t]))
        {
          const auto &x = tips_[t].position;
          result.push_back(
            "Cuts/Tips: the tip of '" + cuts.curves[tips_[t].cut].name +
            "' at (" + Text::number(x[0]) + ", " + Text::number(x[1]) + ", " +
            Text::number(x[2]) +
            ") is closed at the edge of its cell: harmonic functions need a "
            "straight cut that is alone there, and ends a tenth of the cell "
            "and more behind that edge.");
        }
    return result;
  }
} // namespace Nacre
