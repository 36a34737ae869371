// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/multigrid/dense_kernels.h>
#include <nacre/multigrid/level_matrix.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Nacre
{
  namespace
  {
    std::vector<types::global_dof_index>
    column_ids(const SparseRows &matrix)
    {
      std::vector<types::global_dof_index> ids(matrix.n_columns());
      for (unsigned int j = 0; j < ids.size(); ++j)
        ids[j] = matrix.global_column(j);
      return ids;
    }
  } // namespace


  void
  LevelMatrix::reinit(const TrilinosWrappers::SparseMatrix &matrix,
                      const IndexSet                       &further_rows)
  {
    const MPI_Comm   communicator = matrix.get_mpi_communicator();
    const IndexSet   owned        = matrix.locally_owned_range_indices();
    const SparseRows own_rows(matrix);
    const bool is_parallel = Utilities::MPI::n_mpi_processes(communicator) > 1;
    further_rows_.reset();
    IndexSet ghosts(matrix.m());
    if (is_parallel)
      {
        further_rows_.emplace(matrix, further_rows);
        ghosts.add_indices(further_rows);
        for (auto ids : {column_ids(own_rows), column_ids(*further_rows_)})
          {
            std::sort(ids.begin(), ids.end());
            ghosts.add_indices(ids.begin(), ids.end());
          }
        ghosts.subtract_set(owned);
      }
    partitioner_ =
      std::make_shared<const Utilities::MPI::Partitioner>(owned,
                                                          ghosts,
                                                          communicator);
    n_owned_ = owned.n_elements();
    rows_.assign(n_owned_ + ghosts.n_elements(), Row());
    diagonal_.assign(rows_.size(), 0.);
    patterns_ = RowPatterns();
    values_   = {};
    add_rows(own_rows);
    if (is_parallel)
      add_rows(*further_rows_);
    gathered_.resize(patterns_.max_length());
  }


  void
  LevelMatrix::copy_values()
  {
    std::size_t n_values = 0;
    for (unsigned int i = 0; i < n_local(); ++i)
      n_values += row_length(i);
    values_.resize(n_values);
    double *values = values_.data();
    for (unsigned int i = 0; i < n_local(); ++i)
      {
        std::copy_n(rows_[i].values, row_length(i), values);
        rows_[i].values = values;
        values += row_length(i);
      }
    further_rows_.reset();
  }


  void
  LevelMatrix::add_rows(const SparseRows &matrix)
  {
    std::vector<unsigned int> local_columns;
    for (const auto id : column_ids(matrix))
      local_columns.push_back(partitioner_->global_to_local(id));

    const auto patterns = patterns_.add(matrix, local_columns);
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      {
        const auto [length, columns, values] = matrix[i];
        const unsigned int row =
          partitioner_->global_to_local(matrix.global_row(i));
        rows_[row] = {values, patterns[i]};
        for (unsigned int k = 0; k < length; ++k)
          if (local_columns[columns[k]] == row)
            diagonal_[row] = values[k];
      }
  }


  bool
  LevelMatrix::is_interior(const unsigned int i) const
  {
    const unsigned int pattern = rows_[i].pattern;
    return std::all_of(patterns_.begin(pattern),
                       patterns_.end(pattern),
                       [&](const RowPatterns::Run &run) {
                         const int length = (&run)[1].place - run.place;
                         return run.column + length <= int(n_owned_);
                       });
  }


  void
  LevelMatrix::get_columns(const unsigned int         i,
                           std::vector<unsigned int> &columns) const
  {
    const unsigned int pattern = rows_[i].pattern;
    columns.clear();
    for (auto run = patterns_.begin(pattern); run != patterns_.end(pattern);
         ++run)
      for (int k = 0; k < run[1].place - run->place; ++k)
        columns.push_back(run->column + k);
  }


  void
  LevelMatrix::gather(const unsigned int pattern, const double *x) const
  {
    const auto last = patterns_.end(pattern);
    for (auto run = patterns_.begin(pattern); run != last; ++run)
      {
        const double *source = x + run->column;
        double       *values = gathered_.data() + run->place;
        const int     length = run[1].place - run->place;
        for (int k = 0; k < length; ++k)
          values[k] = source[k];
      }
  }


  void
  LevelMatrix::multiply_rows(const unsigned int  n,
                             const unsigned int *i,
                             const double       *x,
                             double             *products) const
  {
    constexpr unsigned int               max_rows = 64;
    std::array<const double *, max_rows> values;
    for (unsigned int first = 0; first < n;)
      {
        const unsigned int pattern = rows_[i[first]].pattern;
        unsigned int       last    = first;
        while (last < n && last - first < max_rows &&
               rows_[i[last]].pattern == pattern)
          {
            values[last - first] = rows_[i[last]].values;
            ++last;
          }
        gather(pattern, x);
        DenseKernels::dot_products(last - first,
                                   patterns_.length(pattern),
                                   values.data(),
                                   gathered_.data(),
                                   products + first);
        first = last;
      }
  }


  void
  LevelMatrix::residual(Vector &r, const Vector &x, const Vector &b) const
  {
    constexpr unsigned int           n_rows = 256;
    std::array<unsigned int, n_rows> indices;
    std::array<double, n_rows>       products;
    for (unsigned int first = 0; first < n_owned_; first += n_rows)
      {
        const unsigned int n = std::min(n_rows, n_owned_ - first);
        for (unsigned int k = 0; k < n; ++k)
          indices[k] = first + k;
        multiply_rows(n, indices.data(), x.begin(), products.data());
        for (unsigned int k = 0; k < n; ++k)
          r.begin()[first + k] = b.begin()[first + k] - products[k];
      }
  }


  double
  LevelMatrix::residual_and_error(Vector       &r,
                                  const Vector &x,
                                  const Vector &b) const
  {
    const double x_max = x.linfty_norm();
    const double small =
      1000. * x.size() * std::numeric_limits<double>::epsilon();
    double error = 0.;
    residual(r, x, b);
    for (unsigned int i = 0; i < n_owned_; ++i)
      {
        const double *a       = rows_[i].values;
        const double  b_i     = std::abs(b.begin()[i]);
        double        scale   = b_i;
        double        row_sum = 0.;
        gather(rows_[i].pattern, x.begin());
        for (unsigned int k = 0; k < row_length(i); ++k)
          {
            scale += std::abs(a[k] * gathered_[k]);
            row_sum += std::abs(a[k]);
          }
        if (scale <= small * (row_sum * x_max + b_i))
          scale += row_sum * x_max;
        const double r_i = std::abs(r.begin()[i]);
        // The negated comparison keeps NaN.
        if (r_i != 0. && !(r_i / scale <= error))
          error = r_i / scale;
      }
    return Utilities::MPI::max(error, partitioner_->get_mpi_communicator());
  }
} // namespace Nacre
