// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_elimination_order_h
#define nacre_solvers_elimination_order_h

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace Nacre
{
  using namespace dealii;

  /**
   * On rank 0, the place (from zero) of each unknown of the symmetric
   * @p matrix in an order of pivots that keeps the factors sparse; nothing on
   * other ranks. Rows of the same pattern (RowPatterns), such as those of the
   * displacements of a node, are one vertex of the graph that is ordered.
   * Collective.
   */
  std::vector<int>
  elimination_order(const TrilinosWrappers::SparseMatrix &matrix);
} // namespace Nacre

#endif
