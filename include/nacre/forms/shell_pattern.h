// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_shell_pattern_h
#define nacre_forms_shell_pattern_h

#include <nacre/discretization/discretization.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Nacre
{
  /**
   * Give @p matrix the rows of a form on cells and interior edges, that couples
   * each cell with itself and with its neighbours across edges, after the
   * elimination of @p constraints; rows and columns of constrained dofs hold
   * their diagonal only. Values are zero. Collective.
   *
   * The pattern is found for blocks of dofs, those of a vertex, of an edge's
   * interior and of a cell's interior, and goes into the rows, whose lengths
   * are known then, without a pattern of dofs in between. Blocks that
   * eliminated dofs depend on are taken as a whole.
   */
  void
  make_shell_pattern(const Discretization            &discretization,
                     const AffineConstraints<double> &constraints,
                     TrilinosWrappers::SparseMatrix  &matrix);
} // namespace Nacre

#endif
