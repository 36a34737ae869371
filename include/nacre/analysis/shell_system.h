// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_shell_system_h
#define nacre_analysis_shell_system_h

#include <nacre/analysis/fading_force.h>
#include <nacre/base/expression.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/assembly.h>
#include <nacre/problem/shell_model.h>
#include <nacre/solvers/linear_solver.h>
#include <nacre/solvers/newton_solver.h>

#include <functional>
#include <memory>
#include <vector>

namespace Nacre
{
  /**
   * The nonlinear algebraic system of a shell at a time: residual, tangent and
   * constraints at any displacement, with the loads and the prescribed
   * displacements of that time.
   */
  class ShellSystem
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /**
     * The system at t = 0; collective. Everything must live as long.
     * @param assembly that of @p model on @p discretization
     * @param solver of the linearised systems
     */
    ShellSystem(const Discretization &discretization,
                const Assembly       &assembly,
                const ShellModel     &model,
                LinearSolver         &solver);

    /** Take loads and conditions at @p time; collective. */
    void
    set_time(const double time);

    /** Take the loads and prescribed rotations at @p time instead. */
    void
    set_load_time(const double time);

    /** Take the loads at @p time instead. */
    void
    set_force_time(const double time);

    /**
     * From the time set on act on the shell with forces that keep it in
     * equilibrium at @p u with the @p inertia, and that fall linearly to zero
     * within @p duration. Collective.
     */
    void
    hold(const Vector &u, const Inertia &inertia, const double duration);

    /** From now on those of another shell of the same discretization. */
    void
    hold(const FadingForce &held);

    /** What hold() has been told last. */
    const FadingForce &
    held() const
    {
      return held_;
    }

    /** Whether such forces act after @p time. */
    bool
    is_held(const double time) const
    {
      return held_.share(time) > 0.;
    }

    /** These forces (force) at the time set, added to @p forces. */
    void
    add_held_forces(const double factor, Vector &forces) const
    {
      if (held_share_ > 0.)
        forces.add(factor * held_share_, held_.force);
    }

    /** The start of a step at @p u with the prescribed rotations set. */
    StepStart
    step_start(const Vector &u) const
    {
      return {with_ghosts(u), actions_.rotations};
    }

    /**
     * From now on solve with a new tangent always, or, if @p is_kept, with the
     * next one for as long as prescribed displacements don't change.
     */
    void
    keep_tangent(const bool is_kept)
    {
      keeps_tangent_ = is_kept;
      has_tangent_   = false;
    }

    /**
     * A step to the @p time ends at the displacement @p u: a section with
     * memory takes note of it, for which the time is set. Collective.
     */
    void
    accept_step(const Vector &u, const double time);

    /**
     * Whether from now on solve_linearised() fails where the matrix isn't
     * positive definite, which is quicker than solving with it.
     */
    void
    require_definite(const bool is_required)
    {
      requires_definite_ = is_required;
    }

    /** Loads and prescribed rotations at the times set. */
    const ShellActions &
    actions() const
    {
      return actions_;
    }

    /** Factor of the loads at the time of set_time(). */
    double
    load_factor() const
    {
      return factor_;
    }

    /** Hanging nodes and prescribed displacements at the time set. */
    const AffineConstraints<double> &
    constraints() const
    {
      return conditions_->constraints();
    }

    /**
     * Solve K(u) du = -r(u) such that u + du fulfils the constraints. Without
     * a finite r and K, or with a singular K, the step's failure tells so.
     */
    NewtonSolver::Step
    solve_linearised(const Vector &u, Vector &du)
    {
      return solve_linearised(u, u, du, nullptr, 1.);
    }

    /**
     * The same with inertia at a displacement @p u within a time step, such
     * that the @p end of the step, of which u holds the @p share,
     * fulfils the constraints: end + du / share.
     */
    NewtonSolver::Step
    solve_linearised(const Vector  &u,
                     const Vector  &end,
                     Vector        &du,
                     const Inertia *inertia,
                     const double   share);

    /**
     * du/dt (length/time) of equilibrium at @p u, with the matrix that
     * solve_linearised() has solved with last: K du/dt = -r,t, displacements
     * that are prescribed at @p time included. Derivatives with respect to the
     * time are differences over @p dt to both sides, exact for loads that are
     * linear in it.
     */
    struct Rate
    {
      Vector velocity;
      /** -r,t . du/dt (force times length/time^2). */
      double work = 0.;
    };

    Rate
    rate(const Vector &u, const double time, const double dt);

    /** The work of r on a virtual displacement v. */
    struct VirtualWork
    {
      /** r(u) . v (force times length) */
      double value = 0.;
      /** K(u) v (force), which is its gradient as K is symmetric. */
      Vector gradient;
      /** r,t . v (force times length/time), the displacement held. */
      double rate = 0.;
    };

    /**
     * That of all internal forces and loads at @p u and @p time, at supports as
     * well, on @p v. Derivatives with respect to the time are as rate()'s.
     */
    VirtualWork
    virtual_work(const Vector &u,
                 const Vector &v,
                 const double  time,
                 const double  dt);

    /** -r(u) . du with the constraints eliminated. */
    double
    work(const Vector  &u,
         const Vector  &du,
         const Inertia *inertia = nullptr) const;

    /** v . M w of vectors of owned entries. */
    double
    product(const MassTerms &mass, const Vector &v, const Vector &w) const;

    /**
     * Improve @p mode, a guess of the lowest eigenvector of A x = mu M x, by
     * @p n_steps steps of inverse iteration with the last matrix A that
     * solve_linearised() has solved with; x . M x is 1 afterwards. Returns mu
     * (1/time^2), which is never less than the lowest one.
     */
    double
    improve_mode(const MassTerms   &mass,
                 const unsigned int n_steps,
                 Vector            &mode);

    /**
     * If @p result has converged, count for certain the negative eigenvalues of
     * the last matrix that solve_linearised() has solved with,
     * LinearSolver::count_negative_eigenvalues(); without success where the
     * matrix is singular. Collective.
     */
    void
    count_negative_eigenvalues(NewtonSolver::Result &result);

    /**
     * The acceleration (length/time^2) that the forces at @p u give in
     * addition to that of @p inertia; zero where displacements are prescribed.
     */
    Vector
    acceleration(const Vector    &u,
                 const Inertia   &inertia,
                 const MassTerms &mass);

    /**
     * M x = b for each @p b without constraints, as residuals are; x is zero
     * where displacements are prescribed. Collective.
     * @param moves_tips whether functions of tips with dofs of their own take
     *   part; if not, these are zero
     */
    std::vector<Vector>
    solve_mass(const MassTerms           &mass,
               const std::vector<Vector> &b,
               const bool                 moves_tips = true);

    /** trace K(u) / trace M (1/time^2). */
    double
    stiffness_to_mass(const Vector &u, const MassTerms &mass);

    /** Values of @p function at the undeformed nodes. */
    Vector
    interpolate(
      const std::function<Tensor<1, spacedim>(const Point<spacedim> &)>
        &function) const;

    /** A vector with ghosts and the entries of @p owned. */
    Vector
    with_ghosts(const Vector &owned) const;

    /** A zero vector of owned entries. */
    Vector
    owned_vector() const;

    /** Position (length) of the undeformed node where @p v is largest. */
    Point<spacedim>
    position_of_largest(const Vector &v) const;

    /** Of the last increment that solve_linearised() has found. */
    Point<spacedim>
    position_of_last_increment() const
    {
      return position_of_largest(last_increment_);
    }

    /** The section's thickness (length) at some point. */
    double
    thickness() const;

    bool
    has_initial_strain() const
    {
      return model_.section->has_initial_strain();
    }

    /** Largest dimension of the shell (length). */
    double
    size() const
    {
      return size_;
    }

    const Discretization &
    discretization() const
    {
      return discretization_;
    }

    const Assembly &
    assembly() const
    {
      return assembly_;
    }

    /** CPU seconds of residuals and tangents so far on this rank. */
    double
    assembly_seconds() const
    {
      return assembly_seconds_;
    }

    /** Strain energy at the last solve_linearised(). */
    const Energies &
    energies() const
    {
      return energies_;
    }

  private:
    /** Whether the tangent is kept, and the increments of @p constraints are
     * zero but for round-off at the displacement @p u. */
    bool
    can_keep_tangent(const AffineConstraints<double> &constraints,
                     const Vector                    &u) const;

    /** Those of the time, without the prescribed values. */
    AffineConstraints<double>
    homogeneous_constraints() const;

    /** Those, with all dofs of tips' functions zero. */
    AffineConstraints<double>
    constraints_without_tips() const;

    /**
     * The largest increment (length) that @p constraints prescribe, on all
     * ranks.
     */
    double
    prescribed_increment(const AffineConstraints<double> &constraints) const;

    /** NewtonSolver::Step::round_off_work at @p u, with the matrix' tangent. */
    double
    round_off_work(const Vector &u) const;

    /**
     * Residual and, unless it is kept, a tangent ready to be solved at the
     * ghosted displacement @p u; what prevents it.
     */
    StepFailure
    linearise(const Vector                    &u,
              const AffineConstraints<double> &constraints,
              const Inertia                   *inertia,
              const bool                       keeps_tangent,
              Vector                          &right_hand_side);

    /** Why forces at the ghosted displacement @p u aren't finite. */
    StepFailure
    not_finite(const Vector &u) const;

    /** Change of the prescribed displacements from @p before to @p after. */
    Vector
    prescribed_change(const double before, const double after) const;

    /** Move the constrained entries to those that they depend on. */
    void
    condense(const AffineConstraints<double> &constraints, Vector &r) const;

    /** Constraints of du such that end + du / share fulfils the time's. */
    AffineConstraints<double>
    increment_constraints(const Vector &ghosted_end, const double share) const;

    const Discretization &discretization_;
    const Assembly       &assembly_;
    const ShellModel     &model_;
    ShellActions          actions_;
    FadingForce           held_;
    double                held_share_ = 0.;
    double                factor_     = 0.;
    double                size_;
    double                area_; // of the undeformed surface

    std::unique_ptr<DisplacementConditions> conditions_;
    TrilinosWrappers::SparseMatrix          matrix_;
    /** With no constraints eliminated, if virtual_work() was called. */
    TrilinosWrappers::SparseMatrix whole_matrix_;
    LinearSolver                  &solver_;
    bool                           keeps_tangent_     = false;
    bool                           has_tangent_       = false;
    bool                           requires_definite_ = false;
    Energies                       energies_;
    mutable double                 assembly_seconds_ = 0.;
    Vector                         last_increment_;
  };
} // namespace Nacre

#endif
