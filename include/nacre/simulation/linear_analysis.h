// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_linear_analysis_h
#define nacre_simulation_linear_analysis_h

#include <nacre/base/cpu_timer.h>
#include <nacre/simulation/analysis.h>
#include <nacre/simulation/discrete_shell.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Nacre
{
  /** The linear solution on one mesh, and what it took. */
  class LinearSolution
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /**
     * Assemble and solve. Throws if the matrix isn't positive definite; warns
     * of lost digits. Collective.
     * @param shell must live as long
     * @param goal whose dual solution is computed, too; null: none
     * @param setup_seconds of the shell
     */
    LinearSolution(DiscreteShell        &shell,
                   const GoalFunctional *goal,
                   const double          setup_seconds,
                   Log                  &log);

    const SolvedShell &
    solved() const
    {
      return solved_;
    }

    /**
     * The dual solution z of the goal, ghosted: a change of the solution's
     * residual changes the quantity by the residual's work on z.
     */
    const Vector &
    dual() const
    {
      return dual_;
    }

    const SolveRecord &
    record() const
    {
      return record_;
    }

  private:
    Vector
    solve(Log &log);

    /** Throws if the matrix isn't positive definite; warns of lost digits. */
    void
    judge(const SolveAccuracy &accuracy, Log &log) const;

    /** The dual solution with the factors of the system just solved. */
    Vector
    solve_dual(const GoalFunctional &goal);

    /** The goal's load (force) beside its prescribed displacement @p edge. */
    Vector
    dual_load(const GoalFunctional &goal, Vector &edge) const;

    DiscreteShell                 &shell_;
    CpuTimer                       timer_;
    SolveRecord                    record_;
    TrilinosWrappers::SparseMatrix matrix_;
    const ShellActions             actions_;
    const Vector                   displacement_;
    const Vector                   dual_;
    Vector                         residual_;
    const SolvedShell              solved_;
  };

  /**
   * One linear solve; with adaptive refinement one on each of its meshes, with
   * an estimate of the error.
   */
  class LinearAnalysis : public Analysis
  {
  public:
    LinearAnalysis(const MPI_Comm            communicator,
                   const ShellProblem       &problem,
                   const AdaptiveRefinement &adaptive,
                   Log                      &log);

    std::string
    name() const override
    {
      return "linear system";
    }

    bool
    can_restart() const override
    {
      return false;
    }

    void
    check(const Recorder &recorder, const bool restart) override;

    void
    run(Recorder &recorder, const bool restart) override;

  private:
    using Mesh = DiscreteShell::Mesh;

    /**
     * Solve on @p mesh, null for that of the problem. Returns the mesh refined
     * for the next cycle, or null if this is the last one.
     */
    std::unique_ptr<Mesh>
    run_cycle(const unsigned int    cycle,
              std::unique_ptr<Mesh> mesh,
              Recorder             &recorder) const;

    /** Right-hand sides of each matrix. */
    unsigned int
    n_right_hand_sides() const;

    const MPI_Comm            communicator_;
    const ShellProblem       &problem_;
    const AdaptiveRefinement &adaptive_;
    Log                      &log_;
  };
} // namespace Nacre

#endif
