// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_symmetric_factors_h
#define nacre_solvers_symmetric_factors_h

#include <nacre/solvers/nonzero_entries.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace Nacre
{
  /** Sparse factors of a symmetric matrix; collective on its ranks. */
  class SymmetricFactors
  {
  public:
    using Matrix = TrilinosWrappers::SparseMatrix;
    using Vector = TrilinosWrappers::MPI::Vector;

    virtual ~SymmetricFactors() = default;

    /**
     * Prepare for matrices of a pattern.
     * @param place of each unknown in the order of pivots, on rank 0
     */
    virtual void
    analyse(const Matrix           &matrix,
            const NonzeroEntries   &pattern,
            const std::vector<int> &place) = 0;

    /**
     * Factorise a matrix of that pattern; lack of memory throws.
     * @return whether there are factors: no pivot is zero or of a sign that
     *   the method doesn't take
     */
    virtual bool
    factorize(const Matrix &matrix, const NonzeroEntries &pattern) = 0;

    /** x = A^{-1} b, without refinement. */
    virtual void
    substitute(Vector &x, const Vector &b) = 0;

    /** Of the last factors. */
    virtual unsigned int
    n_negative_pivots() const = 0;

    /** What factorize() will take on all ranks together, analysed (bytes). */
    virtual double
    memory() const = 0;

  protected:
    /** Throw for @p n unknowns; @p reason is the library's. */
    [[noreturn]] static void
    throw_lack_of_memory(const std::size_t n, const std::string &reason);
  };

  /**
   * Supernodal Cholesky by CHOLMOD, for positive definite matrices on one
   * rank: Chen, Davis, Hager, Rajamanickam: ACM Trans. Math. Softw. 35 (2008)
   * 22:1-22:14.
   */
  std::unique_ptr<SymmetricFactors>
  make_cholmod_factors();

  /**
   * Multifrontal L D L^T by MUMPS: Amestoy, Duff, Koster, L'Excellent: SIAM J.
   * Matrix Anal. Appl. 23 (2001) 15-41.
   * @param with_pivoting also exchange pivots that are small in their columns,
   *   as they may become in indefinite matrices, and form 2x2 blocks of them
   */
  std::unique_ptr<SymmetricFactors>
  make_mumps_factors(const MPI_Comm communicator, const bool with_pivoting);
} // namespace Nacre

#endif
