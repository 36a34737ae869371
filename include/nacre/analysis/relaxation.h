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
   *   (K(u_k) + sigma_k M) (u_{k+1} - u_k) = f - F(u_k), sigma_k = 1 / dt_k^2.
   *
   * The shift sigma is raised until the matrix is positive definite, so that
   * the energy falls; an increment that goes beyond the energy's minimum along
   * it is shortened. Where K itself has a negative eigenvalue the state is
   * pushed along the eigenvector as well: an unstable state of perfect
   * symmetry, where nothing else drives it away, is left like this. The shift
   * falls as the linearisation gets better: in the end it is zero, and
   * Newton's method converges to a stable state.
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
    /** How much of an increment was taken. */
    struct Part
    {
      /** Factor of the increment; 0: none was good. */
      double factor = 1.;
      /**
       * The force along the increment at its end, by that at its start: 1 in a
       * slope, negative beyond the minimum.
       */
      double share = 0.;
    };

    /** A smooth field without any symmetry, to find eigenvectors from. */
    Vector
    start_mode() const;

    /** Move @p u by the answer @p du to its residual, or by a part of it. */
    Part
    take_increment(Vector &u, const Vector &du, const NewtonSolver::Step &step);

    /**
     * After a matrix that isn't positive definite. The first shift takes as
     * much work along the increment @p du of such a matrix as the tangent did.
     */
    void
    raise_shift(const Vector &du, const NewtonSolver::Step &step);

    /** After an increment of which @p part was taken. */
    void
    adapt_shift(const Part &part, const double expected_share);

    /**
     * Move @p u along the eigenvector of the lowest eigenvalue, if that is
     * negative, as far as the energy falls like its curvature says.
     */
    void
    push_along_mode(Vector &u, const NewtonSolver::Step &step);

    ShellSystem                    &system_;
    const MassTerms                &mass_;
    const NewtonSolver::Parameters &newton_;

    /** sigma, and the least one that isn't zero (1/time^2). */
    double shift_ = 0., least_shift_ = 0.;
    /** The last increment was too long: raise the time step slowly. */
    bool is_careful_ = false;
    /** Nearly the eigenvector of K's lowest eigenvalue, and that (1/time^2). */
    Vector mode_;
    bool   has_mode_   = false;
    double eigenvalue_ = 0.;
    /** Largest displacement of the last push (length). */
    double amplitude_;
  };
} // namespace Nacre

#endif
