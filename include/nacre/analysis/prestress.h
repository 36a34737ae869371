// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_prestress_h
#define nacre_analysis_prestress_h

#include <nacre/analysis/mode_parameters.h>
#include <nacre/forms/assembly.h>
#include <nacre/problem/shell_model.h>
#include <nacre/solvers/linear_solver.h>

#include <deal.II/lac/affine_constraints.h>

#include <functional>
#include <utility>

namespace Nacre
{
  /**
   * The stiffness of a shell in a linear state: K + G, where G is what the
   * state adds; or that of a nonlinear state. Matrices have the constraints
   * eliminated, which are those of the eigenproblem, homogeneous ones.
   */
  class Prestress
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /** All must live as long; @p assembly that of @p model. */
    Prestress(const Discretization &discretization,
              const Assembly       &assembly,
              const ShellModel     &model,
              const ModeOptions    &options);

    /** Hanging nodes and supports, with zero for prescribed displacements. */
    const AffineConstraints<double> &
    constraints() const
    {
      return constraints_;
    }

    /** K without any load. */
    void
    assemble_stiffness(Matrix &K) const;

    /** Whether loads, prescribed values or membrane forces act at @p time. */
    bool
    acts(const double time) const;

    /**
     * The linear solution at @p time, ghosted; zero if none is needed.
     * @param solver which is prepared for @p K here
     */
    Vector
    solve(const Matrix &K, const double time, LinearSolver &solver) const;

    /**
     * Add factor G of the state @p u at @p time to the @p matrix, and clear
     * the rows of constrained dofs.
     */
    void
    add(const Vector &u,
        const double  time,
        const double  factor,
        Matrix       &matrix) const;

    /** The tangent K(u) of the nonlinear state @p u, ghosted, at @p time. */
    void
    assemble_tangent(const Vector &u, const double time, Matrix &K) const;

    /**
     * Add factor times dK/dt of the tangent at @p u along the curve of
     * equilibria, du/dt = @p velocity (length/time), both ghosted, the change
     * of the loads included; and clear the rows of constrained dofs.
     */
    void
    add_tangent_rate(const Vector &u,
                     const Vector &velocity,
                     const double  time,
                     const double  factor,
                     Matrix       &matrix) const;

  private:
    /** A place on a line through a state, and what acts there. */
    using Line = std::function<std::pair<Vector, Instant>(const double place)>;

    /**
     * Add factor times the derivative of the tangent along @p line at 0, by
     * differences of the size @p step.
     */
    void
    differentiate(const Assembly &assembly,
                  const Line     &line,
                  const double    step,
                  const double    factor,
                  Matrix         &matrix) const;

    Vector
    ghosted(const Vector &owned) const;

    /** Add factor times the load stiffness at @p instant. */
    void
    add_load_stiffness(const Instant &instant,
                       const double   factor,
                       Matrix        &matrix) const;

    /** Add factor times G of options_.membrane_force. */
    void
    add_membrane_force(const Instant &instant,
                       const double   factor,
                       Matrix        &matrix) const;

    /**
     * Add factor times the derivative of the tangent along @p u, or of its
     * part that forces and moments make, the load stiffness included.
     */
    void
    add_tangent_derivative(const Vector &u,
                           const double  time,
                           const double  factor,
                           Matrix       &matrix) const;

    /** Largest |u,a a^a| (none): strains and rotations are of this size. */
    double
    largest_gradient(const Vector &u) const;

    /** Remove what stands in rows of constrained dofs. */
    void
    clear_constrained(Matrix &matrix) const;

    const Discretization     &discretization_;
    const Assembly           &assembly_;
    const ShellModel         &model_;
    const ModeOptions        &options_;
    AffineConstraints<double> constraints_;
    IndexSet                  relevant_dofs_;
  };
} // namespace Nacre

#endif
