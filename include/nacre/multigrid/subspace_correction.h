// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_subspace_correction_h
#define nacre_multigrid_subspace_correction_h

#include <nacre/multigrid/level_matrix.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <vector>

namespace Nacre
{
  /**
   * The exact solution in the span of a few vectors w_k, all ranks' together:
   *
   *   x += W (W^T K W)^-1 W^T b,
   *
   * a further subspace of an additive preconditioner (Xu: SIAM Review 34
   * (1992) 581-613).
   */
  class SubspaceCorrection
  {
  public:
    using Vector = LevelMatrix::Vector;

    /**
     * The span of @p vectors, whose ghosts must be up to date; none: no
     * correction. Throws ExcIterationFailed where @p matrix isn't positive
     * definite on one of them, or singular on their span. Collective.
     */
    void
    reinit(const LevelMatrix &matrix, std::vector<Vector> &&vectors);

    /** Collective. */
    void
    add_to(Vector &x, const Vector &b) const;

  private:
    std::vector<Vector> vectors_;
    /** Of W^T K W, scaled to a unit diagonal. */
    LAPACKFullMatrix<double> factors_;
    std::vector<double>      scales_;
  };
} // namespace Nacre

#endif
