// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/residual_edges.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** Shorter intervals of an edge, as a fraction of it, are round-off. */
    constexpr double shortest_lip = 1e-9;

    /** What the pieces to the neighbour leave of the side of a part. */
    std::vector<EdgePiece>
    lips_of(const EdgePiece &side, const std::vector<EdgePiece> &pieces)
    {
      std::vector<EdgePiece> rest{side};
      for (const EdgePiece &piece : pieces)
        if (piece.sides[0].part.index() == side.sides[0].part.index())
          {
            const auto            &meeting = piece.sides[0].interval;
            std::vector<EdgePiece> next;
            for (const EdgePiece &whole : rest)
              {
                EdgePiece before = whole, after = whole;
                auto     &end   = before.sides[0].interval[1];
                auto     &begin = after.sides[0].interval[0];
                end             = std::min(end, meeting[0]);
                begin           = std::max(begin, meeting[1]);
                for (const EdgePiece &part : {before, after})
                  if (part.sides[0].interval[1] - part.sides[0].interval[0] >
                      shortest_lip)
                    next.push_back(part);
              }
            rest = next;
          }
      return rest;
    }
  } // namespace

  bool
  is_taken_by_neighbor(const CellParts::Cell &cell, const unsigned int face)
  {
    const auto         neighbor = cell->neighbor(face);
    const unsigned int back     = cell->neighbor_of_neighbor(face);
    return neighbor->is_locally_owned() &&
           std::make_pair(neighbor->index(), back) <
             std::make_pair(cell->index(), face);
  }

  std::vector<EdgePiece>
  residual_pieces(const CellParts       &parts,
                  const CellParts::Cell &cell,
                  const unsigned int     face)
  {
    std::vector<EdgePiece> pieces, result;
    if (!cell->at_boundary(face))
      pieces = parts.pieces_between(cell, face);
    for (unsigned int i = 0; i < parts.n_parts(cell); ++i)
      for (const auto &side : parts.pieces_of(parts.part(cell, i), face))
        for (const auto &lip : lips_of(side, pieces))
          result.push_back(lip);
    if (!pieces.empty() && !is_taken_by_neighbor(cell, face))
      result.insert(result.end(), pieces.begin(), pieces.end());
    return result;
  }

  FullMatrix<double>
  make_differentiation(const Quadrature<1> &points)
  {
    const unsigned int n = points.size();
    FullMatrix<double> matrix(n, n);
    const auto x = [&](const unsigned int i) { return points.point(i)[0]; };
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          if (k != j)
            {
              double product = 1. / (x(j) - x(k));
              for (unsigned int l = 0; l < n; ++l)
                if (l != j && l != k)
                  product *= (x(i) - x(l)) / (x(j) - x(l));
              matrix(i, j) += product;
            }
    return matrix;
  }
} // namespace Nacre
