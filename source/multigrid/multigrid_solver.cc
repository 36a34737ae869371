// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/assembly.h>
#include <nacre/multigrid/coarse_mesh.h>
#include <nacre/multigrid/level_matrix.h>
#include <nacre/multigrid/level_transfer.h>
#include <nacre/multigrid/multigrid_solver.h>
#include <nacre/multigrid/patch_smoother.h>
#include <nacre/multigrid/subspace_correction.h>
#include <nacre/multigrid/vertex_patches.h>
#include <nacre/problem/shell_model.h>
#include <nacre/solvers/direct_solver.h>

#include <deal.II/fe/mapping_q.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>

namespace Nacre
{
  namespace
  {
    using TrilinosVector = TrilinosWrappers::MPI::Vector;

    template <typename To, typename From>
    void
    copy_entries(To &to, const From &from)
    {
      std::copy(from.begin(), from.end(), to.begin());
    }

    PatchExtent
    patch_extent(const Element &element)
    {
      return element.degree == 2 ? PatchExtent::closed_star : PatchExtent::star;
    }

    /** Sweeps before and after each coarse correction. */
    unsigned int
    n_steps(const Element &element)
    {
      return element.type == ElementType::triangle ? 2 : 1;
    }

    const unsigned int lowest_degree = 2;

    /**
     * Of the responses to the functions of tips, as Parameters::tolerance:
     * smaller ones save an iteration or none.
     */
    constexpr double tip_tolerance = 0.1;

    /** The unconstrained dofs of tips' functions, of all ranks. */
    std::set<types::global_dof_index>
    tip_function_dofs(const Discretization            &discretization,
                      const AffineConstraints<double> &constraints)
    {
      std::vector<types::global_dof_index> dofs, mine;
      const std::size_t n = discretization.node_dofs().size();
      for (const CellPart &part : discretization.owned_parts())
        if (part.enrichment() != nullptr)
          {
            discretization.get_dof_indices(part, dofs);
            std::copy_if(dofs.begin() + n,
                         dofs.end(),
                         std::back_inserter(mine),
                         [&](const auto i) {
                           return !constraints.is_constrained(i);
                         });
          }
      std::set<types::global_dof_index> all;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(discretization.communicator(), mine))
        all.insert(of_rank.begin(), of_rank.end());
      return all;
    }

    bool
    has_lower_degree(const Discretization &fine)
    {
      return fine.element().type == ElementType::lagrange &&
             fine.element().degree > lowest_degree;
    }
  } // namespace


  /** A mesh of the hierarchy with all that belongs to it. */
  struct MultigridSolver::Level
  {
    /** @name Other than on the finest level, built here */
    //@{
    std::unique_ptr<Discretization>         own_discretization;
    std::unique_ptr<DisplacementConditions> conditions;
    std::unique_ptr<Assembly>               assembly;
    TrilinosWrappers::SparseMatrix          own_matrix;
    //@}

    const Discretization *discretization = nullptr;
    /** Null on the coarsest level. */
    std::unique_ptr<LevelTransfer> to_coarser;
    std::unique_ptr<VertexPatches> patches;
    /** On the coarsest level only. */
    std::unique_ptr<DirectSolver> direct;

    LevelMatrix   matrix;
    PatchSmoother smoother;
    /** On the finest level only: the tips' functions. */
    SubspaceCorrection at_tips;
    Vector             x, b, r;
  };


  MultigridSolver::MultigridSolver(const Discretization         &fine,
                                   const ShellModel             &model,
                                   const Parameters             &parameters,
                                   const DisplacementConditions *conditions)
    : model_(model)
    , conditions_(conditions)
    , parameters_(parameters)
    , mapping_degree_(0)
  {
    if (const auto *mapping =
          dynamic_cast<const MappingQ<dim, spacedim> *>(&fine.mapping()))
      if (fine.element().type == ElementType::lagrange && model.cuts.is_empty())
        mapping_degree_ = mapping->get_degree();
    levels_.push_back(std::make_unique<Level>());
    levels_.back()->discretization = &fine;
    while ((levels_.size() == 1 ||
            n_dofs(n_levels() - 1) > parameters_.coarse_dofs) &&
           add_coarser_level())
      {}
  }


  MultigridSolver::~MultigridSolver() = default;


  bool
  MultigridSolver::has_coarser_mesh(const Discretization &fine)
  {
    return can_coarsen(fine.triangulation()) || has_lower_degree(fine);
  }


  types::global_dof_index
  MultigridSolver::n_dofs(const unsigned int l) const
  {
    return levels_[l]->discretization->n_dofs();
  }


  bool
  MultigridSolver::add_coarser_level()
  {
    const Discretization &fine    = *levels_.back()->discretization;
    const auto           &mesh    = fine.triangulation();
    Element               element = fine.element();
    if (can_coarsen(mesh) &&
        add_level(coarsen(model_.midsurface, mesh), element))
      return true;
    // If no mesh is coarser, the next level has the lowest degree on this one.
    if (!has_lower_degree(fine))
      return false;
    element.degree = lowest_degree;
    return add_level(copy(model_.midsurface, mesh), element);
  }


  bool
  MultigridSolver::add_level(
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> mesh,
    const Element                                              &element)
  {
    auto level = std::make_unique<Level>();
    // Only the finest level has functions of tips.
    Cuts cuts = model_.cuts;
    cuts.tips = CutTips::closed;
    try
      {
        level->own_discretization =
          std::make_unique<Discretization>(std::move(mesh),
                                           model_.midsurface,
                                           element,
                                           mapping_degree_,
                                           cuts);
        level->own_discretization->set_coarse_level();
        level->conditions =
          std::make_unique<DisplacementConditions>(*level->own_discretization,
                                                   model_.supports,
                                                   Instant(),
                                                   conditions_);
      }
    catch (const ExcMessage &error)
      {
        // Cells may be too large for the cuts: all ranks know.
        if (model_.cuts.is_empty())
          throw;
        why_no_coarser_level_ = error_text(error);
        return false;
      }
    level->assembly = std::make_unique<Assembly>(*level->own_discretization,
                                                 model_,
                                                 TermSelection::with_tangent);
    level->discretization = level->own_discretization.get();
    if (level->discretization->n_dofs() >=
        levels_.back()->discretization->n_dofs())
      return false;
    levels_.push_back(std::move(level));
    return true;
  }


  void
  MultigridSolver::connect_levels(
    const AffineConstraints<double> &finest_constraints)
  {
    const AffineConstraints<double> *constraints = &finest_constraints;
    for (unsigned int l = 0; l + 1 < n_levels(); ++l)
      {
        Level      &level              = *levels_[l];
        Level      &coarser            = *levels_[l + 1];
        const auto &coarse_constraints = coarser.conditions->constraints();
        level.to_coarser =
          std::make_unique<LevelTransfer>(*level.discretization,
                                          *constraints,
                                          *coarser.discretization,
                                          coarse_constraints);
        level.patches =
          std::make_unique<VertexPatches>(*level.discretization,
                                          *constraints,
                                          patch_extent(
                                            level.discretization->element()));
        constraints = &coarse_constraints;
      }
    levels_.back()->direct = std::make_unique<DirectSolver>(
      levels_.back()->discretization->communicator());
  }


  void
  MultigridSolver::assemble_coarse_levels(const LinearSystem &system)
  {
    TrilinosVector u;
    for (unsigned int l = 1; l < n_levels(); ++l)
      {
        Level         &level       = *levels_[l];
        const auto    &constraints = level.conditions->constraints();
        TrilinosVector unused(level.discretization->locally_owned_dofs(),
                              level.discretization->communicator());
        if (level.own_matrix.m() == 0)
          level.assembly->reinit_matrix(constraints, level.own_matrix);
        if (system.u == nullptr)
          {
            level.assembly->assemble_system(constraints,
                                            level.own_matrix,
                                            unused);
            continue;
          }
        const TrilinosVector coarse_u =
          levels_[l - 1]->to_coarser->interpolate(l == 1 ? *system.u : u);
        u.reinit(coarse_u);
        u = coarse_u;
        level.assembly->assemble(u,
                                 level.assembly->actions(system.instant),
                                 constraints,
                                 level.own_matrix,
                                 unused);
      }
  }


  bool
  MultigridSolver::try_prepare(const LinearSystem &system)
  {
    has_solved_ = false;
    if (levels_.back()->direct == nullptr)
      connect_levels(system.constraints);
    assemble_coarse_levels(system);
    bool is_definite = true;
    // The coarse levels come first, since they free memory for the finest one.
    for (unsigned int l = n_levels(); l-- > 0;)
      {
        Level      &level  = *levels_[l];
        const auto &matrix = l == 0 ? system.matrix : level.own_matrix;
        if (level.direct != nullptr)
          {
            level.matrix.reinit(matrix, IndexSet(matrix.m()));
            // The coarse matrix of a deformed shell may be indefinite or hold
            // NaN.
            is_definite &= std::isfinite(matrix.frobenius_norm()) &&
                           level.direct->try_factorize(matrix) &&
                           *level.direct->n_negative_pivots() == 0;
          }
        else
          {
            level.matrix.reinit(matrix, level.patches->foreign_dofs);
            if (l > 0)
              {
                level.matrix.copy_values();
                level.own_matrix.clear();
              }
            is_definite &=
              level.smoother.reinit(level.matrix,
                                    *level.patches,
                                    n_steps(level.discretization->element()));
          }
        for (Vector *vector : {&level.x, &level.b, &level.r})
          vector->reinit(level.matrix.partitioner());
      }
    AssertThrow(is_definite,
                ExcIterationFailed("the matrix is not positive definite"));
    prepare_tips(system.constraints);
    return true;
  }


  void
  MultigridSolver::prepare_tips(const AffineConstraints<double> &constraints)
  {
    Level              &level = *levels_[0];
    std::vector<Vector> responses;
    level.at_tips.reinit(level.matrix, {});
    if (level.direct != nullptr)
      return;
    for (const auto dof : tip_function_dofs(*level.discretization, constraints))
      {
        Vector w(level.matrix.partitioner()), r(w), zero(w);
        if (w.in_local_range(dof))
          w(dof) = 1.;
        w.update_ghost_values();
        level.matrix.residual(r, w, zero);
        w.zero_out_ghost_values();
        const Vector b(r);
        Vector       x(zero);
        start(x, r);
        iterate(x, r, b, tip_tolerance);
        w += x;
        w.update_ghost_values();
        responses.push_back(w);
      }
    level.at_tips.reinit(level.matrix, std::move(responses));
  }


  void
  MultigridSolver::cycle(const unsigned int l)
  {
    Level &level = *levels_[l];
    if (level.direct != nullptr)
      {
        solve_coarsest();
        return;
      }
    Level &coarser = *levels_[l + 1];
    level.b.update_ghost_values();
    std::fill(level.x.begin(), level.x.begin() + level.matrix.n_local(), 0.);
    level.smoother.forward(level.x, level.b);
    level.matrix.residual(level.r, level.x, level.b);
    level.to_coarser->restrict_to(coarser.b, level.r);
    cycle(l + 1);
    level.to_coarser->prolongate_and_add(level.x, coarser.x);
    level.x.update_ghost_values();
    level.smoother.backward(level.x, level.b);
  }


  void
  MultigridSolver::precondition()
  {
    Level &level = *levels_[0];
    cycle(0);
    level.at_tips.add_to(level.x, level.b);
  }


  void
  MultigridSolver::solve_coarsest()
  {
    Level         &level = *levels_.back();
    const auto    &owned = level.discretization->locally_owned_dofs();
    TrilinosVector x(owned, level.discretization->communicator());
    TrilinosVector b(x);
    copy_entries(b, level.b);
    level.direct->substitute(x, b);
    copy_entries(level.x, x);
  }


  void
  MultigridSolver::solve_coarser_levels(const Vector &b)
  {
    std::vector<Vector> rhs(n_levels());
    for (unsigned int l = 1; l < n_levels(); ++l)
      {
        rhs[l].reinit(levels_[l]->matrix.partitioner());
        levels_[l - 1]->to_coarser->restrict_to(rhs[l],
                                                l == 1 ? b : rhs[l - 1]);
      }
    levels_.back()->b = rhs.back();
    solve_coarsest();
    for (unsigned int l = n_levels() - 2; l > 0; --l)
      {
        Level &level = *levels_[l];
        Vector x(level.matrix.partitioner());
        level.to_coarser->prolongate_and_add(x, levels_[l + 1]->x);
        x.update_ghost_values();
        level.matrix.residual(level.b, x, rhs[l]);
        cycle(l);
        level.x += x;
      }
  }


  void
  MultigridSolver::start(Vector &x, Vector &r)
  {
    Level       &level  = *levels_[0];
    const double r_norm = r.l2_norm();
    AssertThrow(std::isfinite(r_norm),
                ExcIterationFailed("the residual is not a finite number"));
    if (r_norm == 0.)
      return;
    // The right-hand side may lie beyond the range of the patches' single
    // precision.
    level.b.equ(1. / r_norm, r);
    solve_coarser_levels(level.b);
    Vector u(level.matrix.partitioner()), Au(u), zero(u);
    level.to_coarser->prolongate_and_add(u, levels_[1]->x);
    u.update_ghost_values();
    level.matrix.residual(Au, u, zero);
    // A coarser level may be too stiff or too soft. Take the multiple of its
    // solution that has the least error in the energy norm.
    const double uAu = -(u * Au), ur = u * r;
    if (std::isfinite(ur) && std::isfinite(uAu) && uAu > 0.)
      {
        x.equ(ur / uAu, u);
        r.add(ur / uAu, Au);
      }
  }


  unsigned int
  MultigridSolver::iterate(Vector       &x,
                           Vector       &r,
                           const Vector &b,
                           const double  tolerance)
  {
    Level &level = *levels_[0];
    Vector p(level.matrix.partitioner()), Ap(p), zero(p);
    double rz_old = 1.;
    for (unsigned int k = 0;; ++k)
      {
        const double r_norm = r.l2_norm();
        if (r_norm == 0.)
          return k;
        AssertThrow(k < parameters_.max_iterations,
                    ExcIterationFailed("no convergence within " +
                                       std::to_string(k) + " iterations"));
        level.b.equ(1. / r_norm, r); // as in start()
        precondition();
        const double rz = (r * level.x) * r_norm;
        AssertThrow(std::isfinite(rz) && rz > 0.,
                    ExcIterationFailed(
                      "the preconditioner is not positive definite"));
        p.sadd(k == 0 ? 0. : rz / rz_old, r_norm, level.x);
        rz_old = rz;
        p.update_ghost_values();
        level.matrix.residual(Ap, p, zero);
        const double pAp = -(p * Ap);
        AssertThrow(std::isfinite(pAp) && pAp > 0.,
                    ExcIterationFailed("the matrix is not positive definite"));
        x.add(rz / pAp, p);
        r.add(rz / pAp, Ap);
        // The squares of the energy norms of the error before this step, but
        // for the preconditioner, and of the solution.
        const double energy = x * b - x * r;
        if (rz <= Utilities::fixed_power<2>(tolerance) * energy)
          return k + 1;
      }
  }


  SolveAccuracy
  MultigridSolver::solve(TrilinosVector &x, const TrilinosVector &b)
  {
    Level &level = *levels_[0];
    has_solved_  = false;
    AssertThrow(std::isfinite(b.l2_norm()),
                ExcMessage("The right-hand side of the linear system holds an "
                           "infinite or undefined (NaN) number."));
    SolveAccuracy accuracy;
    if (level.direct != nullptr)
      accuracy = level.direct->solve(x, b);
    else
      {
        Vector solution(level.matrix.partitioner());
        Vector right_hand_side(solution), r(solution), correction(solution);
        copy_entries(right_hand_side, b);
        // Rows of constrained dofs are diagonal.
        for (unsigned int i = 0; i < level.matrix.n_owned(); ++i)
          if (level.matrix.row_length(i) == 1)
            solution.begin()[i] =
              right_hand_side.begin()[i] / level.matrix.diagonal(i);
        solution.update_ghost_values();
        level.matrix.residual(r, solution, right_hand_side);
        solution.zero_out_ghost_values();
        const Vector missing(r);
        start(correction, r);
        accuracy.n_iterations =
          iterate(correction, r, missing, parameters_.tolerance);
        solution += correction;
        solution.update_ghost_values();
        accuracy.backward_error =
          level.matrix.residual_and_error(r, solution, right_hand_side);
        copy_entries(x, solution);
      }
    has_solved_ = true;
    return accuracy;
  }


  std::optional<unsigned int>
  MultigridSolver::n_negative_pivots() const
  {
    if (!has_solved_)
      return {};
    return 0;
  }


  std::optional<unsigned int>
  MultigridSolver::count_negative_eigenvalues()
  {
    Level &level = *levels_[0];
    if (level.direct != nullptr)
      return level.direct->n_negative_pivots();
    Vector       x(level.matrix.partitioner()), b(x);
    std::mt19937 random(
      Utilities::MPI::this_mpi_process(level.discretization->communicator()));
    std::uniform_real_distribution<double> entry(-1., 1.);
    // Rows of constrained dofs are diagonal.
    for (unsigned int i = 0; i < level.matrix.n_owned(); ++i)
      if (level.matrix.row_length(i) > 1)
        b.begin()[i] = entry(random);
    Vector r(b);
    // Of a random vector an eigenvector has a share of about 1 / n, and soft
    // ones more.
    iterate(x, r, b, 1e-6);
    return 0;
  }


  void
  MultigridSolver::apply_cycle(TrilinosVector &x, const TrilinosVector &b)
  {
    Level &level = *levels_[0];
    copy_entries(level.b, b);
    precondition();
    copy_entries(x, level.x);
  }
} // namespace Nacre
