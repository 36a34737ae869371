// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_direct_solver_h
#define nacre_solvers_direct_solver_h

#include <nacre/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <memory>

namespace Nacre
{
  /**
   * Sparse factors of a symmetric matrix on any number of ranks: supernodal
   * Cholesky by CHOLMOD on one rank; L D L^T without pivoting by MUMPS on
   * several, and where the matrix is not positive definite; with pivoting,
   * where pivots (nearly) vanish by accident, as they may in indefinite
   * matrices. The factors are kept for any number of right-hand sides. The
   * number of negative pivots (negative eigenvalues) tells whether the matrix
   * is positive definite.
   */
  class DirectSolver : public LinearSolver
  {
  public:
    explicit DirectSolver(const MPI_Comm communicator);
    ~DirectSolver() override;

    DirectSolver(const DirectSolver &) = delete;
    DirectSolver &
    operator=(const DirectSolver &) = delete;

    /**
     * Analyse and factorise @p matrix, which must stay alive and unchanged
     * for solve()'s refinement; its rows must be contiguous on each rank and
     * rise with the rank. The analysis is kept while the pattern of nonzero
     * entries stays the same. Lack of memory, entries that are not finite,
     * and a matrix singular to working precision throw on all ranks.
     */
    void
    factorize(const TrilinosWrappers::SparseMatrix &matrix);

    /** The same, but returns false for a matrix that is singular. */
    bool
    try_factorize(const TrilinosWrappers::SparseMatrix &matrix,
                  const bool                            definite_only = false);

    /** try_factorize() its matrix. */
    bool
    try_prepare(const LinearSystem &system) override;

    /** Number of negative pivots of the last factorisation. */
    std::optional<unsigned int>
    n_negative_pivots() const override;

    /**
     * Solve with iterative refinement, one to three steps, until the
     * componentwise backward error max_i |r|_i / (|A||x| + |b|)_i stops
     * halving. (Rows whose denominator is round-off add |A_i|_1 |x|_max.)
     * The vectors are distributed as the matrix' rows, without ghosts; a
     * right-hand side that is not finite throws on all ranks.
     */
    SolveAccuracy
    solve(TrilinosWrappers::MPI::Vector       &x,
          const TrilinosWrappers::MPI::Vector &b) override;

    /** x = A^{-1} b of the factors alone, for preconditioners. Collective. */
    void
    substitute(TrilinosWrappers::MPI::Vector       &x,
               const TrilinosWrappers::MPI::Vector &b) const;

    /**
     * x = K^{-1} b without refinement or any check: a linear and symmetric map,
     * as preconditioners need it. Collective.
     */
    void
    substitute(TrilinosWrappers::MPI::Vector       &x,
               const TrilinosWrappers::MPI::Vector &b);

    /**
     * Analyse @p matrix, as factorize() does and will not do again, and
     * estimate the memory (GB) that its factors take on all ranks together.
     */
    double
    factor_memory(const TrilinosWrappers::SparseMatrix &matrix);

    /** Number of analyses so far. */
    unsigned int
    n_analyses() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
  };
} // namespace Nacre

#endif
