// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_matrix_scatter_h
#define nacre_forms_matrix_scatter_h

#include <nacre/base/types.h>

#include <deal.II/base/types.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Adds local matrices and vectors to a distributed system.
   *
   * A dense local matrix whose dofs are all unconstrained and this rank's goes
   * straight into the rows of the sparse matrix: one pass over each sorted row
   * instead of a search for each entry. Anything else is left to
   * AffineConstraints::distribute_local_to_global(), which would take the
   * larger part of the assembly at p = 2.
   */
  class MatrixScatter
  {
  public:
    MatrixScatter(const AffineConstraints<double> &constraints,
                  TrilinosWrappers::SparseMatrix  &matrix,
                  TrilinosWrappers::MPI::Vector   &right_hand_side);

    void
    add(const FullMatrix<double>                   &local_matrix,
        const Vector<double>                       &local_vector,
        const std::vector<types::global_dof_index> &dofs);

  private:
    /** Whether all dofs are unconstrained and this rank's; sorts columns_. */
    bool
    is_direct(const std::vector<types::global_dof_index> &dofs);

    const AffineConstraints<double> &constraints_;
    TrilinosWrappers::SparseMatrix  &matrix_;
    TrilinosWrappers::MPI::Vector   &right_hand_side_;
    /** Range of this rank's dofs. */
    const std::pair<types::global_dof_index, types::global_dof_index> range_;
    /** Local columns of the sparse matrix, sorted, with the local dofs. */
    std::vector<std::pair<int, unsigned int>> columns_;
  };
} // namespace Nacre

#endif
