// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_linear_solver_h
#define nacre_solvers_linear_solver_h

#include <nacre/base/instant.h>
#include <nacre/base/types.h>

#include <deal.II/base/exceptions.h>

#include <optional>
#include <string>

namespace dealii
{
  template <typename number>
  class AffineConstraints;
  namespace TrilinosWrappers
  {
    class SparseMatrix;
    namespace MPI
    {
      class Vector;
    }
  } // namespace TrilinosWrappers
} // namespace dealii

namespace Nacre
{
  /** How exact a solution of a linear system is, and what it took. */
  struct SolveAccuracy
  {
    /**
     * Componentwise backward error max_i |r|_i / (|A||x| + |b|)_i: the
     * relative change of the data that x solves exactly.
     */
    double backward_error = 0.;
    /**
     * |dx| / |x| of the first step of refinement. It estimates the condition
     * number times round-off: the solution has about -log10 of it correct
     * digits.
     */
    double correction = 0.;
    /** Iterations of an iterative solver; 0 for a direct one. */
    unsigned int n_iterations = 0;
    /**
     * False if a solver that took over found the matrix singular; the solution
     * is meaningless then.
     */
    bool is_regular = true;
  };

  /** A linear system of a shell, K x = b, as solvers need to know it. */
  struct LinearSystem
  {
    /** K with the constraints eliminated symmetrically. */
    const TrilinosWrappers::SparseMatrix &matrix;
    /** Hanging nodes and prescribed displacements that were eliminated. */
    const AffineConstraints<double> &constraints;
    /** The ghosted displacement of which K is the tangent; null for zero. */
    const TrilinosWrappers::MPI::Vector *u = nullptr;
    /** The loads and prescribed rotations of which K is the tangent. */
    Instant instant = Instant();
    /**
     * Only a positive definite K is wanted: try_prepare() may return false for
     * another one, which takes less than its factors.
     */
    bool definite_only = false;
  };

  /**
   * Thrown on all ranks if an iterative solver can't solve a system. The text
   * says why: the iteration stagnates, or the matrix is not positive definite.
   */
  DeclException1(ExcIterationFailed, std::string, << arg1);

  /** Throw an error that names the likely causes if a matrix is not regular. */
  void
  check_regular(const bool is_regular);

  /** A solver of symmetric linear systems for any number of right-hand sides.
   */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /**
     * Take a new matrix, which must stay alive and unchanged for solve().
     * Throws on all ranks, for a singular matrix too; collective.
     */
    void
    prepare(const LinearSystem &system)
    {
      check_regular(try_prepare(system));
    }

    /**
     * The same, but returns false for a matrix that is singular to working
     * precision, as a tangent may be, or isn't definite if it has to be.
     */
    virtual bool
    try_prepare(const LinearSystem &system) = 0;

    /**
     * The vectors are distributed as the matrix' rows, without ghosts; a
     * right-hand side that is not finite throws on all ranks. Collective.
     */
    virtual SolveAccuracy
    solve(TrilinosWrappers::MPI::Vector       &x,
          const TrilinosWrappers::MPI::Vector &b) = 0;

    /**
     * Number of negative eigenvalues of K, where the solver knows it; an
     * iterative solver knows only whether there are any.
     */
    virtual std::optional<unsigned int>
    n_negative_pivots() const = 0;

    /**
     * Number of negative eigenvalues of K, for certain: that takes one more
     * solution where there are no factors. Empty if a solver that took over
     * finds K singular. Throws as solve(). Collective.
     */
    virtual std::optional<unsigned int>
    count_negative_eigenvalues()
    {
      return n_negative_pivots();
    }
  };
} // namespace Nacre

#endif
