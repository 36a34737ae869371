// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_chosen_solver_h
#define nacre_simulation_chosen_solver_h

#include <nacre/base/selection.h>
#include <nacre/solvers/direct_solver.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <memory>
#include <string>

namespace Nacre
{
  class Log;

  /** How linear systems are solved. */
  enum class SolverType
  {
    /** Whichever is expected to be faster. */
    automatic,
    direct,
    multigrid
  };

  const Selection<SolverType> &selection(SolverType);

  struct SolverParameters
  {
    SolverType type = SolverType::automatic;
    /** Of multigrid, before it gives up. */
    unsigned int max_iterations = 100;
    /** Multigrid coarsens until so many unknowns are left, or fewer. */
    unsigned int coarse_dofs = 30000;
  };

  /** The section Linear solver of a parameter file. */
  struct LinearSolverParameters : public ParameterAcceptor
  {
    LinearSolverParameters();

    SolverParameters values;
  };

  /** What the choice of a solver depends on. */
  struct SolverTask
  {
    types::global_dof_index n_dofs             = 0;
    unsigned int            degree             = 2;
    unsigned int            n_right_hand_sides = 1;
    /** Levels of refinement above the coarse mesh. */
    unsigned int n_levels = 0;
    /** What is free on all ranks' machines together (GB). */
    double memory = 0.;
  };

  /**
   * Whether multigrid is expected to take less time than a factorisation, or
   * is the only one to fit into the memory, from times measured on one core:
   * doc/solvers.md.
   */
  bool
  prefers_multigrid(const SolverTask &task);

  /**
   * The linear solver of a case: direct, or multigrid with the direct one in
   * reserve. If multigrid fails, a warning says why, and the direct solver
   * takes over: for indefinite matrices until it meets a definite one again,
   * whatever else was the cause for good.
   */
  class ChosenSolver : public LinearSolver
  {
  public:
    using Factory = std::function<std::unique_ptr<LinearSolver>()>;

    /** @param make_multigrid if it is or makes null: the direct solver only */
    ChosenSolver(const MPI_Comm communicator,
                 const Factory &make_multigrid,
                 Log           &log);

    bool
    try_prepare(const LinearSystem &system) override;

    SolveAccuracy
    solve(TrilinosWrappers::MPI::Vector       &x,
          const TrilinosWrappers::MPI::Vector &b) override;

    /**
     * Zero for a matrix that multigrid has solved: it fails where an iteration
     * meets a direction of negative curvature.
     */
    std::optional<unsigned int>
    n_negative_pivots() const override;

    std::optional<unsigned int>
    count_negative_eigenvalues() override;

    /** The one that solved last, direct or multigrid. */
    SolverType
    type() const
    {
      return has_factors_ ? SolverType::direct : SolverType::multigrid;
    }

    std::string
    name() const;

  private:
    /** Take the direct solver; returns whether it finds the matrix regular. */
    bool
    fall_back(const ExcIterationFailed &failure);

    /** Have the direct solver factorise the matrix of prepare(), likewise. */
    bool
    factorize();

    DirectSolver                  direct_;
    std::unique_ptr<LinearSolver> multigrid_;
    /** Whether the direct solver takes the matrix of prepare(). */
    bool has_factors_;
    /** Whether the last matrix that it has taken was. */
    bool is_indefinite_ = false;
    bool has_warned_    = false;
    Log &log_;
    /** The system of prepare(), for the solver in reserve. */
    std::unique_ptr<const LinearSystem> system_;
  };
} // namespace Nacre

#endif
