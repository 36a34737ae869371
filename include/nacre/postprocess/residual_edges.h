// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_residual_edges_h
#define nacre_postprocess_residual_edges_h

#include <nacre/discretization/cell_parts.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Nacre
{
  /**
   * Whether the neighbour of the same size is this rank's and comes first, so
   * that a loop over all cells takes their edge there.
   */
  bool
  is_taken_by_neighbor(const CellParts::Cell &cell, const unsigned int face);

  /**
   * What a cell takes of an edge that is met in pieces: those to its
   * neighbour, unless is_taken_by_neighbor(), or those on the boundary.
   */
  std::vector<EdgePiece>
  residual_pieces(const CellParts       &parts,
                  const CellParts::Cell &cell,
                  const unsigned int     face);

  /** Derivatives of Lagrange polynomials through points: [point][node]. */
  FullMatrix<double>
  make_differentiation(const Quadrature<1> &points);
} // namespace Nacre

#endif
