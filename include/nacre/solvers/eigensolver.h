// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_eigensolver_h
#define nacre_solvers_eigensolver_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <vector>

namespace Nacre
{
  using namespace dealii;

  /** Which eigenvalues of a map are sought. */
  enum class SpectrumEnd
  {
    largest,
    smallest
  };

  /** What is sought, and how exactly. */
  struct EigenSearch
  {
    unsigned int n_wanted = 1;
    SpectrumEnd  end      = SpectrumEnd::largest;
    /** Of the residual |A x - nu x| over |nu|, in the norm of B. */
    double tolerance = 1e-9;
  };

  /** Eigenvalues and their vectors, which are orthonormal with respect to B. */
  struct Eigenpairs
  {
    std::vector<double>                        values;
    std::vector<TrilinosWrappers::MPI::Vector> vectors;
    /** How often the map was applied. */
    unsigned int n_applications = 0;
  };

  /**
   * Eigenpairs A x = nu x at one end of the spectrum of a linear map A that is
   * self-adjoint with respect to a symmetric matrix B, x . B A y = y . B A x,
   * by the block Krylov-Schur method of Anasazi: Stewart: SIAM J. Matrix Anal.
   * Appl. 23 (2001) 601-614; Baker, Hetmaniuk, Lehoucq, Thornquist: ACM Trans.
   * Math. Softw. 36 (2009) 13:1-13:23.
   * @param apply y = A x, of vectors without ghosts
   * @param inner_product B, positive definite on the span of A
   * @param start vectors of a block, which A maps to the search's first
   * @param known vectors, orthonormal with respect to B, to which those that
   *   are sought are orthogonal
   * @return those that have converged, which may be fewer than wanted; by
   *   descending values for the largest ones, ascending for the smallest ones.
   *   Collective.
   */
  Eigenpairs
  find_eigenpairs(
    const std::function<void(TrilinosWrappers::MPI::Vector &,
                             const TrilinosWrappers::MPI::Vector &)> &apply,
    const TrilinosWrappers::SparseMatrix             &inner_product,
    const std::vector<TrilinosWrappers::MPI::Vector> &start,
    const std::vector<TrilinosWrappers::MPI::Vector> &known,
    const EigenSearch                                &search);
} // namespace Nacre

#endif
