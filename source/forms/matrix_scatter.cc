// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/matrix_scatter.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  namespace
  {
    /** Add the local row's runs to their places in the sparse row. */
    NACRE_SIMD void
    add_row(double *__restrict const values,
            const double *__restrict const local,
            const std::array<unsigned int, 3> *const runs,
            const unsigned int                       n_runs)
    {
      for (unsigned int r = 0; r < n_runs; ++r)
        {
          const unsigned int place  = runs[r][0];
          const unsigned int first  = runs[r][1];
          const unsigned int length = runs[r][2];
          for (unsigned int j = 0; j < length; ++j)
            values[place + j] += local[first + j];
        }
    }
  } // namespace

  MatrixScatter::MatrixScatter(const AffineConstraints<double> &constraints,
                               TrilinosWrappers::SparseMatrix  &matrix,
                               TrilinosWrappers::MPI::Vector   &right_hand_side)
    : constraints_(constraints)
    , matrix_(matrix)
    , right_hand_side_(right_hand_side)
    , range_(matrix.local_range())
    , rows_(matrix)
    , pattern_of_row_(patterns_.add(rows_))
  {}

  void
  MatrixScatter::add(const FullMatrix<double>                   &local_matrix,
                     const Vector<double>                       &local_vector,
                     const std::vector<types::global_dof_index> &dofs,
                     const unsigned int                          n_done)
  {
    any_constrained_ = false;
    is_constrained_.assign(dofs.size(), false);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (constraints_.is_constrained(dofs[i]))
        is_constrained_[i] = any_constrained_ = true;
    if (!any_constrained_)
      {
        add_free(local_matrix, local_vector, dofs, n_done);
        return;
      }
    add_diagonal(local_matrix, dofs);
    condense(local_matrix, local_vector, dofs, n_done);
    is_constrained_.resize(condensed_dofs_.size(), false);
    add_free(condensed_matrix_, condensed_vector_, condensed_dofs_, 0);
  }

  void
  MatrixScatter::add_diagonal(const FullMatrix<double> &local_matrix,
                              const std::vector<types::global_dof_index> &dofs)
  {
    double mean = 0.;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      mean += std::abs(local_matrix(i, i)) / dofs.size();
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (is_constrained_[i])
        {
          const double value = std::abs(local_matrix(i, i));
          matrix_.add(dofs[i], dofs[i], value > 0. ? value : mean);
        }
  }

  void
  MatrixScatter::condense(const FullMatrix<double> &local_matrix,
                          const Vector<double>     &local_vector,
                          const std::vector<types::global_dof_index> &dofs,
                          const unsigned int                          n_done)
  {
    // What each constrained dof depends on, in local numbers.
    std::vector<std::pair<unsigned int, std::pair<unsigned int, double>>> lines;
    condensed_dofs_ = dofs;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (is_constrained_[i])
        for (const auto &[master, weight] :
             *constraints_.get_constraint_entries(dofs[i]))
          {
            const unsigned int m = std::find(condensed_dofs_.begin(),
                                             condensed_dofs_.end(),
                                             master) -
                                   condensed_dofs_.begin();
            if (m == condensed_dofs_.size())
              condensed_dofs_.push_back(master);
            lines.push_back({i, {m, weight}});
          }

    const unsigned int n = condensed_dofs_.size();
    auto              &K = condensed_matrix_;
    auto              &f = condensed_vector_;
    K.reinit(n, n);
    K.fill(local_matrix);
    f.reinit(n);
    std::copy(local_vector.begin(), local_vector.end(), f.begin());
    for (unsigned int j = 0; j < dofs.size(); ++j)
      if (is_constrained_[j])
        {
          const double g = constraints_.get_inhomogeneity(dofs[j]);
          for (unsigned int i = (j < n_done ? n_done : 0);
               g != 0. && i < dofs.size();
               ++i)
            f[i] -= local_matrix(i, j) * g;
        }
    for (unsigned int i = 0; i < n_done; ++i)
      std::fill(&K(i, 0), &K(i, 0) + n_done, 0.);
    for (const auto &[j, line] : lines)
      for (unsigned int i = 0; i < n; ++i)
        K(i, line.first) += line.second * K(i, j);
    for (const auto &[i, line] : lines)
      {
        for (unsigned int j = 0; j < n; ++j)
          K(line.first, j) += line.second * K(i, j);
        f[line.first] += line.second * f[i];
      }
  }

  int
  MatrixScatter::column_of(const types::global_dof_index dof) const
  {
    // This rank's columns come first, in the order of its rows.
    return is_mine(dof) ? static_cast<int>(dof - range_.first) :
                          rows_.local_column(dof);
  }

  void
  MatrixScatter::find_runs(const std::vector<types::global_dof_index> &dofs,
                           const unsigned int                          n_done)
  {
    runs_.clear();
    first_new_run_ = 0;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        if (any_constrained_ && is_constrained_[i])
          continue;
        if (!runs_.empty() && i != n_done)
          {
            // Several ranks' dofs, or gaps among those of other ranks, must
            // not share a run.
            Run &run = runs_.back();
            if (run.local + run.length == i &&
                run.global + run.length == dofs[i] &&
                is_mine(run.global) == is_mine(dofs[i]) &&
                (is_mine(dofs[i]) ||
                 column_of(dofs[i]) ==
                   run.column + static_cast<int>(run.length)))
              {
                ++run.length;
                continue;
              }
          }
        runs_.push_back({i, dofs[i], 1, column_of(dofs[i])});
        if (i < n_done)
          first_new_run_ = runs_.size();
      }
    places_.resize(runs_.size());
  }

  void
  MatrixScatter::search(const unsigned int pattern)
  {
    const RowPatterns::Run *const first = patterns_.begin(pattern);
    const RowPatterns::Run       *known = first;
    for (unsigned int r = 0; r < runs_.size(); ++r)
      {
        // Runs ascend for the most part.
        const int column = runs_[r].column;
        if (column < known->column)
          known = first;
        while (known[1].column <= column)
          ++known;
        const int place = known->place + (column - known->column);
        AssertThrow(
          column >= known->column &&
            place + static_cast<int>(runs_[r].length) <= known[1].place,
          ExcMessage("The sparse matrix has no entry for a local one."));
        places_[r] = {
          {static_cast<unsigned int>(place), runs_[r].local, runs_[r].length}};
      }
  }

  void
  MatrixScatter::add_foreign_row(const types::global_dof_index row,
                                 const double                 *local,
                                 const unsigned int            first_run)
  {
    foreign_columns_.clear();
    foreign_values_.clear();
    for (unsigned int r = first_run; r < runs_.size(); ++r)
      for (unsigned int j = 0; j < runs_[r].length; ++j)
        {
          foreign_columns_.push_back(runs_[r].global + j);
          foreign_values_.push_back(local[runs_[r].local + j]);
        }
    matrix_.add(row,
                foreign_columns_.size(),
                foreign_columns_.data(),
                foreign_values_.data(),
                false,
                false);
  }

  void
  MatrixScatter::add_free(const FullMatrix<double> &local_matrix,
                          const Vector<double>     &local_vector,
                          const std::vector<types::global_dof_index> &dofs,
                          const unsigned int                          n_done)
  {
    find_runs(dofs, n_done);
    double *const right_hand_side = right_hand_side_.begin();
    for (const auto &row_run : runs_)
      {
        const unsigned int first_run =
          row_run.local < n_done ? first_new_run_ : 0;
        unsigned int searched = numbers::invalid_unsigned_int;
        for (unsigned int k = 0; k < row_run.length; ++k)
          {
            const unsigned int  i     = row_run.local + k;
            const double *const local = &local_matrix(i, 0);
            if (!is_mine(row_run.global))
              {
                add_foreign_row(row_run.global + k, local, first_run);
                right_hand_side_(row_run.global + k) += local_vector[i];
                continue;
              }
            const int row = static_cast<int>(row_run.global - range_.first + k);
            right_hand_side[row] += local_vector[i];
            const unsigned int pattern = pattern_of_row_[row];
            if (pattern != searched)
              search(searched = pattern);
            add_row(rows_[row].values,
                    local,
                    places_.data() + first_run,
                    places_.size() - first_run);
          }
      }
  }
} // namespace Nacre
