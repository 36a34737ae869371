// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_multigrid_solver_h
#define nacre_multigrid_multigrid_solver_h

#include <nacre/base/types.h>
#include <nacre/solvers/linear_solver.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  class Discretization;
  class DisplacementConditions;
  struct Element;
  struct ShellModel;

  /**
   * Conjugate gradients, preconditioned by a V-cycle of geometric multigrid
   * with one multiplicative sweep over vertex patches (PatchSmoother) before
   * and one, backwards, after each coarse correction. The first solution comes
   * from the coarsest level up, with one V-cycle on each (full multigrid).
   *
   * The levels are complete discretizations on meshes that are coarsened
   * everywhere as far as hanging nodes permit, with stiffness matrices
   * assembled there: the Galerkin product of a penalty would be twice as stiff
   * on each coarser level. The coarsest level is solved by a DirectSolver.
   * Cuts divide the cells of each level; the levels end where cells are too
   * large for them.
   *
   * Unlike deal.II's multigrid, this needs neither level dofs nor constraints
   * of refinement edges, and works with whatever a Discretization can do.
   */
  class MultigridSolver : public LinearSolver
  {
  public:
    struct Parameters
    {
      /**
       * Energy norm of the error before the last iteration, as the
       * preconditioner sees it, relative to that of the solution:
       * r . B r <= tolerance^2 u . K u.
       */
      double tolerance = 1e-9;
      /** The solver fails if it hasn't converged after so many iterations. */
      unsigned int max_iterations = 60;
      /** Coarsen until the number of dofs is at most this. */
      unsigned int coarse_dofs = 30000;
    };

    /**
     * Build the levels of @p fine; collective. Everything must live as long.
     * @param conditions on the finest mesh, for the planes of symmetry of all
     *   levels; null: each level finds its own
     */
    MultigridSolver(const Discretization         &fine,
                    const ShellModel             &model,
                    const Parameters             &parameters,
                    const DisplacementConditions *conditions = nullptr);
    ~MultigridSolver() override;

    /** Whether the mesh of @p fine was refined from a coarser one. */
    static bool
    has_coarser_mesh(const Discretization &fine);

    /** Number of levels; with one, multigrid is a direct solver. */
    unsigned int
    n_levels() const
    {
      return levels_.size();
    }

    /**
     * What stands against a level coarser than the last one: cuts that its
     * cells are too large for. Empty if nothing was found.
     */
    const std::string &
    why_no_coarser_level() const
    {
      return why_no_coarser_level_;
    }

    /** Number of dofs of the level @p l, 0 is the finest. */
    types::global_dof_index
    n_dofs(const unsigned int l) const;

    /**
     * Assemble the coarse matrices at the displacement of @p system, and invert
     * the patches. Throws ExcIterationFailed if a patch is not positive
     * definite, or a coarse matrix neither finite nor regular.
     */
    bool
    try_prepare(const LinearSystem &system) override;

    /**
     * Throws ExcIterationFailed if the iteration doesn't converge, or if
     * the matrix turns out not to be positive definite.
     */
    SolveAccuracy
    solve(TrilinosWrappers::MPI::Vector       &x,
          const TrilinosWrappers::MPI::Vector &b) override;

    /** 0 after a solution: no negative curvature was met. */
    std::optional<unsigned int>
    n_negative_pivots() const override;

    /**
     * 0, after conjugate gradients for a right-hand side that no symmetry
     * spares. Their residual has the polynomial p(l) = prod (1 - l/theta) of
     * the eigenvalues l of B K, which are as many negative ones as those of K.
     * As long as no curvature, thus no Ritz value theta, is negative, p > 1 at
     * a negative l: the part of its eigenvector grows, and the iteration can't
     * converge (Saad: Iterative methods for sparse linear systems, 2003,
     * sections 6.7.3 and 9.2). Throws ExcIterationFailed if there are any.
     */
    std::optional<unsigned int>
    count_negative_eigenvalues() override;

    /** x = B b, one V-cycle from zero; for tests. Collective. */
    void
    apply_cycle(TrilinosWrappers::MPI::Vector       &x,
                const TrilinosWrappers::MPI::Vector &b);

  private:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    struct Level;

    /** Append the level after the last one, if there is one. */
    bool
    add_coarser_level();

    /** The same on @p mesh; false if it isn't smaller, or can't be cut. */
    bool
    add_level(std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> mesh,
              const Element &element);

    /** What depends on the meshes and the constraints only. */
    void
    connect_levels(const AffineConstraints<double> &finest_constraints);

    /** The coarse matrices at the displacement and the instant of @p system. */
    void
    assemble_coarse_levels(const LinearSystem &system);

    /**
     * The functions of tips c_k that only the finest level has, (C.4) of
     * doc/cutting.md: w_k is the function with the approximate response of all
     * other dofs, -A^-1 B e_k. Throws ExcIterationFailed.
     */
    void
    prepare_tips(const AffineConstraints<double> &constraints);

    /** levels_[l].x = B levels_[l].b */
    void
    cycle(const unsigned int l);

    /**
     * The same on the finest level with the functions of tips, added as a
     * subspace of its own.
     */
    void
    precondition();

    void
    solve_coarsest();

    /**
     * Solve for the right-hand side @p b of the finest level on the coarser
     * ones, from the coarsest up, with one V-cycle on each: levels_[1]->x.
     */
    void
    solve_coarser_levels(const Vector &b);

    /**
     * A first solution @p x, from zero, and its residual @p r, which is the
     * right-hand side before.
     */
    void
    start(Vector &x, Vector &r);

    /**
     * Conjugate gradients for K x = b on the finest level, from @p x with the
     * residual @p r; returns the number of iterations.
     * @param tolerance as Parameters::tolerance
     */
    unsigned int
    iterate(Vector &x, Vector &r, const Vector &b, const double tolerance);

    const ShellModel                   &model_;
    const DisplacementConditions       *conditions_;
    const Parameters                    parameters_;
    unsigned int                        mapping_degree_;
    std::vector<std::unique_ptr<Level>> levels_;
    std::string                         why_no_coarser_level_;
    bool                                has_solved_ = false;
  };
} // namespace Nacre

#endif
