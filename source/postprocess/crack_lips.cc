// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/crack_lips.h>

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
      return {end(0) + s_0 * d,
              (s_1 - s_0) * d,
              n[0] * d[1] > n[1] * d[0] ? 1. : -1.,
              cell->face(piece.face)->boundary_id(),
              {}};
    }
  } // namespace

  std::vector<FreeSide>
  free_sides(const CellParts &parts, const CellPart &part)
  {
    std::vector<FreeSide> sides;
    for (const unsigned int face : part.cell->face_indices())
      if (part.cell->at_boundary(face))
        for (const auto &piece : parts.pieces_of(part, face))
          sides.push_back(side_on_face(piece.sides[0]));
    for (const CutLip &lip : parts.lips(part))
      sides.push_back({lip.begin, lip.along, 1., {}, {lip.cut, lip.is_left}});
    return sides;
  }
} // namespace Nacre
