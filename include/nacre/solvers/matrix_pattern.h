// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_matrix_pattern_h
#define nacre_solvers_matrix_pattern_h

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
   * Which entries of a symmetric matrix, distributed by rows, factors have to
   * know: those that aren't zero, and the diagonal. A row is known by the sum
   * of pseudo-random numbers of its columns (mod 2^64), so that patterns cost
   * little to keep and to compare.
   */
  class MatrixPattern
  {
  public:
    using Matrix = TrilinosWrappers::SparseMatrix;

    /** No rows at all. */
    MatrixPattern() = default;

    /**
     * That of @p matrix. Throws on all ranks if an entry isn't finite, or if
     * the stored entries aren't those of a symmetric matrix.
     */
    explicit MatrixPattern(const Matrix &matrix);

    /** Whether the rows of this rank are the same. */
    bool
    operator==(const MatrixPattern &other) const
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

    /**
     * On rank 0, the place (from zero) of each unknown of @p matrix in an
     * order of pivots that keeps the factors sparse; nothing on other ranks.
     * Unknowns with the same neighbours, such as the displacements of a node,
     * are one vertex of the graph that is ordered. Collective.
     */
    std::vector<int>
    fill_reducing_order(const Matrix &matrix) const;

  private:
    /** Of each row of this rank: the entries that count, all stored ones. */
    std::vector<std::uint64_t> rows_, stored_;
    std::size_t                n_upper_ = 0;
    /** a_ij is zero and a_ji is not, somewhere: then all are kept. */
    bool keeps_zeros_ = false;
  };
} // namespace Nacre

#endif
