// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cell_parts.h>
#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/part_enrichment.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    using Interval = std::array<double, 2>;

    /** Shorter intervals of an edge, as a fraction of it, are round-off. */
    constexpr double shortest_piece = 1e-9;

    /** What is left of @p interval without @p opened. */
    std::vector<Interval>
    without(const Interval &interval, const std::vector<Interval> &opened)
    {
      std::vector<Interval> rest{interval};
      for (const Interval &gap : opened)
        {
          std::vector<Interval> next;
          for (const Interval &part : rest)
            for (const Interval &side :
                 {Interval{{part[0], std::min(part[1], gap[0])}},
                  Interval{{std::max(part[0], gap[1]), part[1]}}})
              if (side[1] - side[0] > shortest_piece)
                next.push_back(side);
          rest = next;
        }
      return rest;
    }

    /** The intervals of a part on a face of its cell. */
    std::vector<Interval>
    intervals_of(const PartData &part, const unsigned int face)
    {
      return part.polygon ? part.polygon->intervals(face) :
                            std::vector<Interval>{{{0., 1.}}};
    }

    /** Index of the vertex at the beginning of the face's coordinate. */
    unsigned int
    first_vertex(const CellPart::Cell &cell, const unsigned int face)
    {
      return cell->vertex_index(
        cell->reference_cell().face_to_cell_vertices(face, 0, 1));
    }

    Interval
    reversed(const Interval &interval)
    {
      return {{1. - interval[1], 1. - interval[0]}};
    }
  } // namespace

  CellParts::CellParts(const DoFHandler<dim, spacedim> &dof_handler,
                       const CutTrace                  &trace)
  {
    const auto &mesh = dof_handler.get_triangulation();
    n_indices_       = mesh.n_active_cells();
    entry_of_cell_.assign(n_indices_, numbers::invalid_unsigned_int);
    const auto is_cut_by_trace = [&](const Cell &cell) {
      const auto k = cell->active_cell_index();
      if (!trace.chains(k).empty())
        return true;
      for (const auto face : cell->face_indices())
        if (!trace.opened(k, face).empty())
          return true;
      return false;
    };
    std::vector<bool> vertex_is_cut(mesh.n_vertices(), false);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && is_cut_by_trace(cell))
        for (const auto v : cell->vertex_indices())
          vertex_is_cut[cell->vertex_index(v)] = true;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const auto v : cell->vertex_indices())
          if (vertex_is_cut[cell->vertex_index(v)])
            {
              make_entry(cell, trace);
              break;
            }
  }

  void
  CellParts::make_entry(const Cell &cell, const CutTrace &trace)
  {
    const unsigned int k    = cell->active_cell_index();
    const auto         kind = cell->reference_cell();
    entry_of_cell_[k]       = entries_.size();
    touched_cells_.push_back(cell);
    entries_.emplace_back();
    Entry &entry      = entries_.back();
    entry.is_near_cut = true;
    for (const auto face : cell->face_indices())
      {
        entry.opened.push_back(trace.opened(k, face));
        entry.openings.push_back(trace.openings(k, face));
        entry.is_cut |= !entry.opened.back().empty();
      }
    const auto polygons = divide(kind, trace.chains(k));
    entry.is_cut |= polygons.size() > 1;
    entry.parts.resize(polygons.size());
    for (unsigned int i = 0; i < polygons.size(); ++i)
      {
        PartData &part = entry.parts[i];
        part.number    = i;
        part.index     = (i == 0 ? k : n_indices_++);
        if (polygons.size() > 1)
          {
            part.polygon  = polygons[i];
            part.fraction = polygons[i].area() / kind.volume();
          }
      }
  }

  void
  CellParts::touch(const Cell &cell)
  {
    if (is_touched(cell))
      return;
    const unsigned int k = cell->active_cell_index();
    entry_of_cell_[k]    = entries_.size();
    touched_cells_.push_back(cell);
    entries_.emplace_back();
    entries_.back().opened.resize(cell->n_faces());
    entries_.back().openings.resize(cell->n_faces());
    entries_.back().parts.resize(1);
    entries_.back().parts[0].index = k;
  }

  void
  CellParts::remove(const DoFHandler<dim, spacedim> &dof_handler,
                    const std::vector<bool>         &is_removed)
  {
    AssertDimension(is_removed.size(), n_indices_);
    are_removed_ = true;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        touch(cell);
    for (const auto &cell : touched_cells_)
      {
        Entry &entry = entries_[entry_of_cell_[cell->active_cell_index()]];
        std::vector<PartData> rest;
        for (const PartData &part : entry.parts)
          if (!is_removed[part.index])
            {
              rest.push_back(part);
              rest.back().number = rest.size() - 1;
            }
        entry.is_cut |= rest.size() < entry.parts.size();
        entry.parts = rest;
        if (!rest.empty())
          entry.parts.front().index = cell->active_cell_index();
      }
  }

  std::vector<EdgePiece>
  CellParts::pieces_between(const Cell &cell, const unsigned int face) const
  {
    // The neighbours of a removed cell may be of any size.
    if (n_parts(cell) == 0)
      return {};
    const Cell neighbor = cell->neighbor(face);
    if (neighbor->is_artificial())
      return {};
    const unsigned int back = cell->neighbor_of_neighbor(face);
    const bool turns = first_vertex(cell, face) != first_vertex(neighbor, back);
    const auto &opened =
      entries_[entry_of_cell_[cell->active_cell_index()]].opened[face];
    std::vector<EdgePiece> pieces;
    for (unsigned int i = 0; i < n_parts(cell); ++i)
      for (unsigned int j = 0; j < n_parts(neighbor); ++j)
        for (const auto &here : intervals_of(parts(cell)[i], face))
          for (const auto &own : intervals_of(parts(neighbor)[j], back))
            {
              const Interval there = turns ? reversed(own) : own;
              const Interval both{
                {std::max(here[0], there[0]), std::min(here[1], there[1])}};
              if (both[1] - both[0] <= shortest_piece)
                continue;
              for (const auto &meeting : without(both, opened))
                {
                  EdgePiece piece;
                  piece.n_sides  = 2;
                  piece.number   = pieces.size();
                  piece.sides[0] = {part(cell, i), face, meeting};
                  piece.sides[1] = {part(neighbor, j), back, meeting};
                  if (turns)
                    piece.sides[1].interval = {
                      {1. - meeting[0], 1. - meeting[1]}};
                  pieces.push_back(piece);
                }
            }
    return pieces;
  }

  std::vector<EdgePiece>
  CellParts::pieces_of(const CellPart &part, const unsigned int face) const
  {
    std::vector<EdgePiece> pieces;
    const auto             intervals = part.data != nullptr ?
                                         intervals_of(*part.data, face) :
                                         std::vector<Interval>{{{0., 1.}}};
    for (const auto &interval : intervals)
      {
        EdgePiece piece;
        piece.number   = pieces.size();
        piece.sides[0] = {part, face, interval};
        pieces.push_back(piece);
      }
    return pieces;
  }

  std::vector<CutLip>
  CellParts::lips(const CellPart &part) const
  {
    std::vector<CutLip> lips;
    if (!is_touched(part.cell))
      return lips;
    if (part.is_cut())
      {
        const CellPolygon &polygon = part.polygon();
        const unsigned int n       = polygon.n_vertices();
        for (unsigned int i = 0; i < n; ++i)
          if (const auto &side = polygon.side(i);
              side.face == numbers::invalid_unsigned_int)
            lips.push_back({polygon.vertex(i),
                            polygon.vertex((i + 1) % n) - polygon.vertex(i),
                            side.cut,
                            side.is_left});
      }
    for (const unsigned int face : part.cell->face_indices())
      add_lips_on_face(part, face, lips);
    if (part.enrichment() != nullptr)
      for (const auto &share : part.enrichment()->shares)
        if (share.holds_tip)
          {
            const Point<dim> entry = crack_entry(share, part.outline());
            lips.push_back({entry, share.tip - entry, share.cut, share.at_end});
            lips.push_back(
              {share.tip, entry - share.tip, share.cut, !share.at_end});
          }
    return lips;
  }

  void
  CellParts::add_lips_on_face(const CellPart      &part,
                              const unsigned int   face,
                              std::vector<CutLip> &lips) const
  {
    const auto &openings =
      entries_[entry_of_cell_[part.cell->active_cell_index()]].openings[face];
    if (openings.empty())
      return;
    const auto kind = part.cell->reference_cell();
    const auto end  = [&](const unsigned int i) {
      return kind.template vertex<dim>(kind.face_to_cell_vertices(face, i, 1));
    };
    const Tensor<1, dim> along   = end(1) - end(0);
    const auto           outward = kind.template unit_normal_vectors<dim>(face);
    const bool is_left         = outward[0] * along[1] > outward[1] * along[0];
    std::vector<Interval> rest = intervals_of(*part.data, face);
    for (const CutOpening &opening : openings)
      {
        std::vector<Interval> next;
        for (const Interval &own : rest)
          {
            const double s_0 = std::max(own[0], opening.begin);
            const double s_1 = std::min(own[1], opening.end);
            if (s_1 - s_0 > shortest_piece)
              lips.push_back({end(0) + (is_left ? s_0 : s_1) * along,
                              (is_left ? s_1 - s_0 : s_0 - s_1) * along,
                              opening.cut,
                              is_left == opening.is_forward});
            for (const Interval &left :
                 without(own, {{{opening.begin, opening.end}}}))
              next.push_back(left);
          }
        rest = next;
      }
  }
} // namespace Nacre
