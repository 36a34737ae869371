// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/crack_lips.h>
#include <nacre/postprocess/residual_edges.h>

namespace Nacre
{
  namespace
  {
    /** The interval of a face that a piece with one side is. */
    FreeSide
    side_on_face(const EdgePiece::Side &piece)
    {
      const auto &cell      = piece.part.cell;
      const auto  reference = cell->reference_cell();
      const auto  end       = [&](const unsigned int i) {
        return reference.template vertex<dim>(
          reference.face_to_cell_vertices(piece.face, i, 1));
      };
      const Tensor<1, dim> d = end(1) - end(0);
      const auto n = reference.template unit_normal_vectors<dim>(piece.face);
      const auto &[s_0, s_1] = piece.interval;
      FreeSide side{end(0) + s_0 * d,
                    (s_1 - s_0) * d,
                    n[0] * d[1] > n[1] * d[0] ? 1. : -1.,
                    {}};
      if (cell->at_boundary(piece.face))
        side.edge = cell->face(piece.face)->boundary_id();
      return side;
    }
  } // namespace

  std::vector<FreeSide>
  free_sides(const CellParts &parts, const CellPart &part)
  {
    std::vector<FreeSide> sides;
    for (const unsigned int face : part.cell->face_indices())
      if (parts.has_pieces(part.cell, face))
        {
          for (const auto &piece : residual_pieces(parts, part.cell, face))
            if (piece.n_sides == 1 &&
                piece.sides[0].part.index() == part.index())
              sides.push_back(side_on_face(piece.sides[0]));
        }
      else if (part.cell->at_boundary(face))
        sides.push_back(side_on_face(EdgePiece(part, face).sides[0]));
    if (part.is_cut())
      {
        const CellPolygon &polygon = part.polygon();
        for (unsigned int i = 0; i < polygon.n_vertices(); ++i)
          if (polygon.side(i).face == numbers::invalid_unsigned_int)
            sides.push_back({polygon.vertex(i),
                             polygon.vertex((i + 1) % polygon.n_vertices()) -
                               polygon.vertex(i),
                             1.,
                             {}});
      }
    return sides;
  }
} // namespace Nacre
