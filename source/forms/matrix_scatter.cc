// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/matrix_scatter.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace Nacre
{
  MatrixScatter::MatrixScatter(const AffineConstraints<double> &constraints,
                               TrilinosWrappers::SparseMatrix  &matrix,
                               TrilinosWrappers::MPI::Vector   &right_hand_side)
    : constraints_(constraints)
    , matrix_(matrix)
    , right_hand_side_(right_hand_side)
    , range_(matrix.local_range())
  {}

  bool
  MatrixScatter::is_direct(const std::vector<types::global_dof_index> &dofs)
  {
    columns_.clear();
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (dofs[i] < range_.first || dofs[i] >= range_.second ||
            constraints_.is_constrained(dofs[i]))
          return false;
        // This rank's columns come first, in the order of its rows.
        columns_.emplace_back(static_cast<int>(dofs[i] - range_.first), i);
      }
    std::sort(columns_.begin(), columns_.end());
    return true;
  }

  void
  MatrixScatter::add(const FullMatrix<double>                   &local_matrix,
                     const Vector<double>                       &local_vector,
                     const std::vector<types::global_dof_index> &dofs)
  {
    if (!is_direct(dofs))
      {
        constraints_.distribute_local_to_global(local_matrix,
                                                local_vector,
                                                dofs,
                                                matrix_,
                                                right_hand_side_);
        return;
      }
    for (const auto &[row, i] : columns_)
      {
        int       length  = 0;
        double   *values  = nullptr;
        int      *indices = nullptr;
        const int error   = matrix_.trilinos_matrix().ExtractMyRowView(row,
                                                                     length,
                                                                     values,
                                                                     indices);
        (void)error;
        Assert(error == 0, ExcTrilinosError(error));
        const double *local = &local_matrix(i, 0);
        const int    *place = indices;
        for (const auto &[column, j] : columns_)
          {
            while (*place < column)
              ++place;
            Assert(place < indices + length && *place == column,
                   ExcInternalError());
            values[place - indices] += local[j];
          }
        right_hand_side_.trilinos_vector()[0][row] += local_vector[i];
      }
  }
} // namespace Nacre
