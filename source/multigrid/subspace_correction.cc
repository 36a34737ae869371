// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/multigrid/subspace_correction.h>
#include <nacre/solvers/linear_solver.h>

#include <cmath>
#include <utility>

namespace Nacre
{
  void
  SubspaceCorrection::reinit(const LevelMatrix    &matrix,
                             std::vector<Vector> &&vectors)
  {
    vectors_             = std::move(vectors);
    const unsigned int n = vectors_.size();
    if (n == 0)
      return;
    FullMatrix<double> gram(n);
    Vector             Kw(matrix.partitioner()), zero(Kw);
    for (unsigned int k = 0; k < n; ++k)
      {
        matrix.residual(Kw, vectors_[k], zero);
        for (unsigned int l = 0; l < n; ++l)
          gram(k, l) = -(vectors_[l] * Kw);
      }
    scales_.resize(n);
    for (unsigned int k = 0; k < n; ++k)
      {
        AssertThrow(std::isfinite(gram(k, k)) && gram(k, k) > 0.,
                    ExcIterationFailed("the matrix is not positive definite"));
        scales_[k] = 1. / std::sqrt(gram(k, k));
      }
    factors_.reinit(n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        factors_(k, l) =
          0.5 * scales_[k] * scales_[l] * (gram(k, l) + gram(l, k));
    try
      {
        factors_.compute_lu_factorization();
      }
    // The same numbers on all ranks.
    catch (const LACExceptions::ExcSingular &)
      {
        AssertThrow(false,
                    ExcIterationFailed("the matrix is not positive definite"));
      }
  }


  void
  SubspaceCorrection::add_to(Vector &x, const Vector &b) const
  {
    const unsigned int n = vectors_.size();
    if (n == 0)
      return;
    dealii::Vector<double> coefficients(n);
    for (unsigned int k = 0; k < n; ++k)
      coefficients[k] = scales_[k] * (vectors_[k] * b);
    factors_.solve(coefficients);
    for (unsigned int k = 0; k < n; ++k)
      x.add(scales_[k] * coefficients[k], vectors_[k]);
  }
} // namespace Nacre
