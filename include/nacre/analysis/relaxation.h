// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_relaxation_h
#define nacre_analysis_relaxation_h

#include <nacre/analysis/shell_system.h>

namespace Nacre
{
  /**
   * Dynamic relaxation: linearly implicit Euler steps, each from rest, of a
   * shell of unit mass per area,
   *
   *   (M / dt_k^2 + K(u_k)) (u_{k+1} - u_k) = f - F(u_k).
   *
   * The step is cut until the matrix is positive definite, so that the
   * energy falls, and grows as the linearisation gets better: in the end it
   * is infinite, and Newton's method converges to a stable state.
   */
  class Relaxation
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /**
     * @param system at the time of the state that is looked for
     * @param mass of 1 per area
     * @param newton tolerance of the increments, and how many there may be
     */
    Relaxation(ShellSystem                    &system,
               const MassTerms                &mass,
               const NewtonSolver::Parameters &newton);

    /**
     * Change @p u, a state of another time, into a stable state; after a
     * failure it is meaningless. Collective.
     */
    NewtonSolver::Result
    run(Vector &u);

  private:
    ShellSystem                    &system_;
    const MassTerms                &mass_;
    const NewtonSolver::Parameters &newton_;
  };
} // namespace Nacre

#endif
