// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_newton_solver_h
#define nacre_solvers_newton_solver_h

#include <nacre/solvers/step_failure.h>

#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <string>

namespace Nacre
{
  /**
   * Newton's method for r(u) = 0 in terms of callbacks.
   *
   * It stops when the last increment is small, |du|_max at most
   * increment_tolerance times the largest change of u since the start, or when
   * the work of the residual on it, du . r, is at most energy_tolerance times
   * the largest such work before. Both compare with the step; a step without a
   * change stops when that work is no more than round-off does. The residual's
   * own norm is no measure: for thin shells it stagnates at round-off times the
   * membrane stiffness.
   */
  class NewtonSolver
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    struct Parameters
    {
      unsigned int max_iterations      = 25;
      double       increment_tolerance = 1e-8;
      double       energy_tolerance    = 1e-18;
      /** Factor of all increments, 1 for Newton's method. */
      double damping = 1.;
      /** An increment beyond this (length) counts as divergence. */
      double max_increment = 1e300;
    };

    /** One linearisation K du = -r(u). */
    struct Step
    {
      /** |r| over the free dofs (force). */
      double residual = 0.;
      /** -r . du over the free dofs (force times length). */
      double work = 0.;
      /**
       * The work that the round-off of r alone may do on its increment K^-1 r;
       * 0 if du holds more than the answer to r (force times length).
       */
      double round_off_work = 0.;
      /** Negative eigenvalues of K, as far as the solver has met them. */
      unsigned int n_negative_pivots = 0;
      /** Why there is no increment; the rest is meaningless then. */
      StepFailure failure;
    };

    struct Result
    {
      bool         converged  = false;
      unsigned int iterations = 0;
      /** Those of the last linearisation. */
      Step last;
      /** |r| of the first linearisation. */
      double first_residual = 0.;
      /** The kind of a failure, and its reason in words for the user. */
      FailureKind kind = FailureKind::no_convergence;
      std::string reason;
    };

    /** Solve K(u) du = -r(u); u is owned entries only. */
    using Linearise = std::function<Step(const Vector &u, Vector &du)>;
    /** -r(u) . du over the free dofs. */
    using Work = std::function<double(const Vector &u, const Vector &du)>;

    explicit NewtonSolver(const Parameters &parameters);

    /**
     * Change @p u into the solution; after a failure it is meaningless.
     * @param work if given, increments are shortened until the work of the
     *   residual along them no longer grows (line search), the first one only
     *   if there are no finite forces at its end
     */
    Result
    solve(Vector &u, const Linearise &linearise, const Work &work = {}) const;

  private:
    /** The factor of the increment. */
    static double
    search(const Vector &u,
           const Vector &du,
           const double  initial_work,
           const Work   &work);

    const Parameters parameters_;
  };
} // namespace Nacre

#endif
