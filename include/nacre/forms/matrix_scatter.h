// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_matrix_scatter_h
#define nacre_forms_matrix_scatter_h

#include <nacre/base/types.h>
#include <nacre/solvers/row_patterns.h>

#include <deal.II/base/types.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Adds local matrices and vectors to a distributed system and eliminates the
   * constraints symmetrically, as
   * AffineConstraints::distribute_local_to_global() does:
   *
   * K += C^T k C, f += C^T (f_local - k g) for u = C u_free + g; the diagonal
   * of a constrained dof gets a positive number.
   *
   * It goes straight into the arrays of the sparse matrix. Dofs with
   * consecutive numbers - those of a node, or of all nodes of an edge or
   * inside a cell - form a run: rows are searched once for each run of
   * columns, and once for all rows of the same pattern. Only rows of other
   * ranks are left to the sparse matrix.
   */
  class MatrixScatter
  {
  public:
    MatrixScatter(const AffineConstraints<double> &constraints,
                  TrilinosWrappers::SparseMatrix  &matrix,
                  TrilinosWrappers::MPI::Vector   &right_hand_side);

    /**
     * Throws if the matrix has no entry where one is needed.
     * @param n_done leave out the block of the first @p n_done rows and columns
     *   of the matrix, which the caller adds with another matrix
     */
    void
    add(const FullMatrix<double>                   &local_matrix,
        const Vector<double>                       &local_vector,
        const std::vector<types::global_dof_index> &dofs,
        const unsigned int                          n_done = 0);

  private:
    /** Free dofs with consecutive local and global numbers and columns. */
    struct Run
    {
      unsigned int            local;
      types::global_dof_index global;
      unsigned int            length;
      /** Local column index in the sparse matrix. */
      int column;
    };

    /**
     * Set condensed_matrix_, condensed_vector_ and condensed_dofs_: masters
     * join the dofs. Constrained dofs remain, to be skipped.
     */
    void
    condense(const FullMatrix<double>                   &local_matrix,
             const Vector<double>                       &local_vector,
             const std::vector<types::global_dof_index> &dofs,
             const unsigned int                          n_done);

    /** Positive numbers on the diagonal of constrained dofs. */
    void
    add_diagonal(const FullMatrix<double>                   &local_matrix,
                 const std::vector<types::global_dof_index> &dofs);

    void
    add_free(const FullMatrix<double>                   &local_matrix,
             const Vector<double>                       &local_vector,
             const std::vector<types::global_dof_index> &dofs,
             const unsigned int                          n_done);

    void
    find_runs(const std::vector<types::global_dof_index> &dofs,
              const unsigned int                          n_done);

    bool
    is_mine(const types::global_dof_index dof) const
    {
      return dof >= range_.first && dof < range_.second;
    }

    /** Local column of a dof, negative if it isn't known here. */
    int
    column_of(const types::global_dof_index dof) const;

    /** Set places_ for the rows of a pattern. */
    void
    search(const unsigned int pattern);

    void
    add_foreign_row(const types::global_dof_index row,
                    const double                 *local,
                    const unsigned int            first_run);

    const AffineConstraints<double> &constraints_;
    TrilinosWrappers::SparseMatrix  &matrix_;
    TrilinosWrappers::MPI::Vector   &right_hand_side_;
    /** Range of this rank's dofs. */
    const std::pair<types::global_dof_index, types::global_dof_index> range_;
    const SparseRows                                                  rows_;
    RowPatterns                                                       patterns_;
    const std::vector<unsigned int> pattern_of_row_;

    std::vector<Run> runs_;
    /** The first run beyond the block that is left out. */
    unsigned int first_new_run_ = 0;
    /** Of each run: place in the sparse row, place in the local one, length. */
    std::vector<std::array<unsigned int, 3>> places_;
    /** Whether each dof is constrained, and whether any is. */
    std::vector<bool> is_constrained_;
    bool              any_constrained_ = false;

    FullMatrix<double>                   condensed_matrix_;
    Vector<double>                       condensed_vector_;
    std::vector<types::global_dof_index> condensed_dofs_;
    std::vector<types::global_dof_index> foreign_columns_;
    std::vector<double>                  foreign_values_;
  };
} // namespace Nacre

#endif
