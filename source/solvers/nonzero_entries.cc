// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/nonzero_entries.h>
#include <nacre/solvers/sparse_rows.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    /** A pseudo-random number: Steele, Lea, Flood (2014), SplitMix64. */
    std::uint64_t
    scatter_bits(const std::uint64_t number)
    {
      std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
      z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      return z ^ (z >> 31);
    }
  } // namespace


  void
  check_finite(const bool         is_finite,
               const std::string &what,
               const MPI_Comm     communicator)
  {
    AssertThrow(Utilities::MPI::min(is_finite ? 1 : 0, communicator) == 1,
                ExcMessage("The " + what +
                           " of the linear system holds an infinite or "
                           "undefined (NaN) number. Check the loads, the "
                           "material and the surface's expressions."));
  }


  NonzeroEntries::NonzeroEntries(const Matrix &matrix)
  {
    const SparseRows           A(matrix);
    std::vector<std::uint64_t> number(A.n_columns());
    std::vector<int>           id(A.n_columns());
    for (unsigned int j = 0; j < A.n_columns(); ++j)
      {
        id[j]     = A.global_column(j);
        number[j] = scatter_bits(id[j]);
      }

    rows_.resize(A.n_rows());
    std::vector<std::uint64_t> stored_rows(A.n_rows());
    bool                       is_finite = true;
    std::size_t                n_stored  = 0;
    // Of entries below minus above the diagonal: sums of products of the row's
    // and the column's number, which vanish for symmetric patterns.
    std::uint64_t skew = 0, skew_stored = 0;
    for (unsigned int i = 0; i < A.n_rows(); ++i)
      {
        const SparseRows::Row row      = A[i];
        const int             i_global = A.global_row(i);
        std::uint64_t         kept[2] = {0, 0}, stored[2] = {0, 0};
        for (unsigned int k = 0; k < row.length; ++k)
          {
            const int j     = row.columns[k];
            is_finite       = is_finite && std::isfinite(row.values[k]);
            const int upper = id[j] > i_global;
            if (id[j] == i_global)
              continue;
            n_stored += upper;
            stored[upper] += number[j];
            if (row.values[k] != 0.)
              {
                n_upper_ += upper;
                kept[upper] += number[j];
              }
          }
        const std::uint64_t own = scatter_bits(i_global);
        rows_[i]                = kept[0] + kept[1] + own;
        stored_rows[i]          = stored[0] + stored[1] + own;
        skew += own * (kept[0] - kept[1]);
        skew_stored += own * (stored[0] - stored[1]);
      }
    const MPI_Comm comm = matrix.get_mpi_communicator();
    check_finite(is_finite, "matrix", comm);
    std::uint64_t sums[2] = {skew, skew_stored};
    Utilities::MPI::sum(ArrayView<const std::uint64_t>(sums, 2),
                        comm,
                        ArrayView<std::uint64_t>(sums, 2));
    AssertThrow(sums[1] == 0,
                ExcMessage("The direct solver takes symmetric matrices only: "
                           "an entry is stored, the mirrored one is not."));
    keeps_zeros_ = (sums[0] != 0);
    if (keeps_zeros_)
      {
        rows_    = stored_rows;
        n_upper_ = n_stored;
      }
    n_upper_ += A.n_rows();
  }
} // namespace Nacre
