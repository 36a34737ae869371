// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_shell_problem_h
#define nacre_simulation_shell_problem_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/base/types.h>
#include <nacre/forms/kinematics.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/exact_solution.h>
#include <nacre/problem/loads.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <optional>

namespace Nacre
{
  class Discretization;
  class Log;
  class ChosenSolver;
  class DisplacementConditions;
  class ErrorEstimator;
  class LinearSolver;
  class ShellOperator;
  struct GoalFunctional;
  struct LinearSolverParameters;
  struct SolveAccuracy;
  struct SolvedShell;

  /** What one solve of a study varies. */
  struct ShellCase
  {
    unsigned int          degree        = 2;
    unsigned int          n_refinements = 0;
    std::optional<double> eta;
    std::optional<double> thickness;
  };

  /** CPU seconds of one solve, summed over the ranks. */
  struct SolveTimes
  {
    double setup    = 0.;
    double assembly = 0.;
    double solve    = 0.;
  };

  /** The linear solver that a case took, and its iterations in all. */
  struct SolverRecord
  {
    std::string  name;
    unsigned int n_iterations = 0;
  };

  /** One shell: one mesh, one linear solve. */
  class ShellProblem : public ParameterAcceptor
  {
  public:
    /** @param section the section law, which reads its own parameters */
    ShellProblem(const MPI_Comm              communicator,
                 std::unique_ptr<SectionLaw> section);
    ~ShellProblem() override;

    /** The folder of the parameter file: mesh files are looked for there. */
    void
    set_folder(const std::string &folder);

    /** Read and check everything for a case; throws ExcMessage. */
    void
    prepare(const Constants &constants, const ShellCase &shell_case);

    /** Whether one solve is all. */
    bool
    is_linear() const
    {
      return path_parameters_.type == AnalysisType::linear;
    }

    /**
     * Set up the case given to prepare(), or the mesh that refine() has made:
     * all that can be found wrong before a system is assembled is found here,
     * as rigid motions left free, which are named.
     */
    void
    set_up(Log &log);

    /**
     * Evaluate all loads and stiffnesses on the undeformed shell, and throw
     * what is wrong with one; after set_up().
     */
    void
    check_integrands() const;

    /**
     * Assemble and solve after set_up(). Throws if the matrix isn't positive
     * definite.
     */
    void
    solve(Log &log);

    /**
     * Let each solve() compute the dual solution of a quantity of interest,
     * too; null for none.
     */
    void
    set_goal(const GoalFunctional *goal)
    {
      goal_ = goal;
    }

    /**
     * The dual solution z of the goal, ghosted: a change of the solution's
     * residual changes the quantity by the residual's work on z.
     */
    const TrilinosWrappers::MPI::Vector &
    dual_solution() const
    {
      return dual_;
    }

    /** The estimator of errors of the last solve(). */
    std::unique_ptr<ErrorEstimator>
    make_error_estimator() const;

    /**
     * Quarter the cells @p marked, by active cell index, of this rank; the
     * next solve() takes the refined mesh. solution() is gone.
     */
    void
    refine(const std::vector<bool> &marked);

    /** Called after each step of a path. */
    using PathObserver =
      std::function<void(const PathState &, const SolvedShell &)>;

    /** The start of the path after set_up(), from @p start if not null. */
    PathState
    start_path(const MotionState *start);

    /**
     * Go on along the path from @p state. Returns "", or why the path ends
     * before its end; state and solution() are then the last good ones.
     */
    std::string
    follow_path(PathState &state, const PathObserver &observer, Log &log);

    const PathParameters &
    path_parameters() const
    {
      return path_parameters_;
    }

    /** The solution of the last solve() or step. */
    const SolvedShell &
    solution() const;

    const SolveTimes &
    times() const
    {
      return times_;
    }

    const SolverRecord &
    solver_record() const
    {
      return solver_record_;
    }

    /** The largest eta taken (1). */
    double
    eta() const;

    /** The element's name. */
    const std::string &
    element_name() const
    {
      return element_;
    }

    /** That of the last set-up. */
    const Discretization &
    discretization() const
    {
      return *discretization_;
    }

    const Midsurface &
    midsurface() const
    {
      return midsurface_;
    }

    const ExactSolution &
    exact_solution() const
    {
      return exact_solution_;
    }

    const SectionLaw &
    section() const
    {
      return *section_;
    }

    /** Constants of the file and of the section. */
    const Constants &
    constants() const
    {
      return constants_;
    }

  private:
    /** Throws if rigid motions are left free, naming them. */
    void
    check_supports() const;

    /** solution() from the state of a path. */
    void
    take_state(const PathState &state);

    /** Warn, once, if a motion has gained more than 1 % of its energy. */
    void
    warn_of_energy(const PathState &state, Log &log);

    void
    warn_of_penalty(Log &log) const;

    /** Forget everything of the last set-up. */
    void
    clear();

    void
    make_solver(Log &log);

    void
    solve_linear_system(Log &log);

    /** Throws if the matrix isn't positive definite; warns of lost digits. */
    void
    judge(const SolveAccuracy &accuracy, Log &log) const;

    /** The dual solution with the factors of the system just solved. */
    void
    solve_dual(LinearSolver                    &solver,
               const AffineConstraints<double> &constraints);

    void
    check_element() const;

    Element
    element() const;

    KinematicsOptions
    kinematics_options() const;

    bool
    has_linear_kinematics() const
    {
      return kinematics_options().model == KinematicsModel::linear;
    }

    const MPI_Comm              communicator_;
    std::unique_ptr<SectionLaw> section_;
    Midsurface                  midsurface_;
    BoundaryConditions          boundary_conditions_;
    Loads                       loads_;
    ExactSolution               exact_solution_;
    PathParameters              path_parameters_;

    std::string  element_              = "Lagrange";
    unsigned int mapping_degree_       = 0;
    std::string  membrane_strain_name_ = "default";
    std::string  edge_form_name_       = "hinge";
    std::string  kinematics_name_      = "linear";
    std::string  tangent_name_         = "consistent";
    std::string  assembly_name_        = "fast";

    ShellCase    case_;
    Constants    constants_;
    SolveTimes   times_;
    SolverRecord solver_record_;

    std::unique_ptr<LinearSolverParameters> solver_parameters_;

    /** Refined, for the next set-up; null: that of the case. */
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> refined_mesh_;
    const GoalFunctional                                       *goal_ = nullptr;

    std::unique_ptr<Discretization> discretization_;
    std::unique_ptr<ShellOperator>  operator_;
    TrilinosWrappers::MPI::Vector   displacement_;
    TrilinosWrappers::MPI::Vector   dual_;
    TrilinosWrappers::MPI::Vector   residual_;
    TrilinosWrappers::MPI::Vector   velocity_;
    bool                            has_warned_of_energy_ = false;

    /** The linear system of solve(), kept for dual solutions. */
    std::unique_ptr<DisplacementConditions> conditions_;
    TrilinosWrappers::SparseMatrix          matrix_;
    std::unique_ptr<ChosenSolver>           solver_;

    std::unique_ptr<ShellSystem>  system_;
    std::unique_ptr<PathAnalysis> path_;
    std::unique_ptr<SolvedShell>  solution_;
  };
} // namespace Nacre

#endif
