// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_nonzero_entries_h
#define nacre_solvers_nonzero_entries_h

#include <nacre/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace Nacre
{
  /** Throw on all ranks if @p is_finite, of @p what, is false on any. */
  void
  check_finite(const bool         is_finite,
               const std::string &what,
               const MPI_Comm     communicator);

  /**
   * The entries of a symmetric matrix, distributed by rows, that factors have
   * to know: the diagonal, and those that aren't zero. A row is represented by
   * the sum of pseudo-random numbers of its columns (mod 2^64), which costs
   * little to keep and to compare.
   */
  class NonzeroEntries
  {
  public:
    using Matrix = TrilinosWrappers::SparseMatrix;

    /** No rows at all. */
    NonzeroEntries() = default;

    /**
     * Those of @p matrix. Throws on all ranks if an entry isn't finite, or if
     * the stored entries aren't those of a symmetric matrix.
     */
    explicit NonzeroEntries(const Matrix &matrix);

    /** Whether the rows of this rank are the same. */
    bool
    operator==(const NonzeroEntries &other) const
    {
      return keeps_zeros_ == other.keeps_zeros_ && rows_ == other.rows_;
    }

    /** Whether the factors need an entry @p value off the diagonal. */
    bool
    contains(const double value) const
    {
      return value != 0. || keeps_zeros_;
    }

    /** Entries on and above the diagonal in the rows of this rank. */
    std::size_t
    n_upper() const
    {
      return n_upper_;
    }

  private:
    /** Of each row of this rank: the entries that count. */
    std::vector<std::uint64_t> rows_;
    std::size_t                n_upper_ = 0;
    /**
     * Whether some a_ij is zero and a_ji is not: all stored entries count then.
     */
    bool keeps_zeros_ = false;
  };
} // namespace Nacre

#endif
