// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_anderson_mixing_h
#define nacre_solvers_anderson_mixing_h

#include <deal.II/lac/trilinos_vector.h>

#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Makes an iteration u += g(u) that converges slowly, as Newton's method
   * with an approximate tangent does, converge faster: Anderson mixing (Walker
   * and Ni, SIAM J. Numer. Anal. 49, 2011). For a linear g it is GMRES with
   * the approximate tangent as preconditioner.
   */
  class AndersonMixing
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /** Forget all iterations. */
    void
    reset();

    /** Replace the increment @p du = g(u) by a better one; collective. */
    void
    improve(const Vector &u, Vector &du);

  private:
    /** Store the changes of u and of g since the last iteration. */
    void
    learn(const Vector &u, const Vector &du);

    /** Changes of u and of g, the latter orthonormal. */
    std::vector<std::pair<Vector, Vector>> changes_;
    /** u and g(u) of the last iteration; empty after reset(). */
    std::vector<std::pair<Vector, Vector>> last_;
  };
} // namespace Nacre

#endif
