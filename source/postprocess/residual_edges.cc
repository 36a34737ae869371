// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/residual_edges.h>

#include <utility>

namespace Nacre
{
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
    std::vector<EdgePiece> pieces;
    if (!cell->at_boundary(face))
      {
        // The neighbours of a removed cell may be of any size.
        if (parts.n_parts(cell) > 0 && !is_taken_by_neighbor(cell, face))
          pieces = parts.pieces_between(cell, face);
        return pieces;
      }
    for (unsigned int i = 0; i < parts.n_parts(cell); ++i)
      for (const auto &piece : parts.pieces_of(parts.part(cell, i), face))
        pieces.push_back(piece);
    return pieces;
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
