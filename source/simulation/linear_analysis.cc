// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/forms/reference_assembly.h>
#include <nacre/simulation/adaptive_refinement.h>
#include <nacre/simulation/conditioning.h>
#include <nacre/simulation/linear_analysis.h>
#include <nacre/simulation/run_warnings.h>

#include <iomanip>
#include <sstream>
#include <utility>

namespace Nacre
{
  LinearSolution::LinearSolution(DiscreteShell        &shell,
                                 const GoalFunctional *goal,
                                 const double          setup_seconds,
                                 Log                  &log)
    : shell_(shell)
    , timer_(shell.discretization().communicator())
    , record_{setup_seconds, 0., 0., "", 0, 0.}
    , actions_(shell.assembly().actions(Instant()))
    , displacement_(solve(log))
    , dual_(goal != nullptr ? solve_dual(*goal) : Vector())
    , residual_(shell.owned_vector())
    , solved_{{shell.discretization(),
               shell.problem().model,
               displacement_,
               Instant()},
              shell.assembly(),
              actions_,
              shell.conditions(),
              residual_,
              shell.assembly().residual(displacement_, actions_, residual_)}
  {
    warn_of_large_displacements(shell.discretization(), displacement_, log);
  }

  LinearSolution::Vector
  LinearSolution::solve(Log &log)
  {
    const ShellModel &model           = shell_.problem().model;
    const auto       &constraints     = shell_.conditions().constraints();
    Vector            right_hand_side = shell_.owned_vector();
    Vector            solution        = shell_.owned_vector();
    const auto        assemble        = [&](const auto &assembly) {
      assembly.reinit_matrix(constraints, matrix_);
      record_.setup += timer_.lap();
      assembly.assemble_system(constraints, matrix_, right_hand_side);
      record_.assembly += timer_.lap();
    };
    if (shell_.problem().assembly == AssemblyMethod::fast)
      assemble(shell_.assembly());
    else
      assemble(ReferenceAssembly(shell_.discretization(),
                                 model,
                                 shell_.assembly().penalty()));

    ChosenSolver &solver = shell_.solver();
    solver.prepare({matrix_, constraints});
    const auto accuracy = solver.solve(solution, right_hand_side);
    check_regular(accuracy.is_regular);
    record_.solver       = solver.name();
    record_.n_iterations = accuracy.n_iterations;
    record_.eta          = shell_.assembly().penalty().eta();
    record_.solve += timer_.lap();
    judge(accuracy, log);

    constraints.distribute(solution);
    Vector displacement = shell_.ghosted_vector();
    displacement        = solution;
    return displacement;
  }

  void
  LinearSolution::judge(const SolveAccuracy &accuracy, Log &log) const
  {
    const unsigned int n_negative =
      shell_.solver().n_negative_pivots().value_or(0);
    std::ostringstream message;
    message << "The stiffness matrix is not positive definite: " << n_negative
            << (n_negative == 1 ? " negative pivot" : " negative pivots")
            << ". Study/Penalties: eta = " << record_.eta
            << " is too small; the bound is "
            << shell_.assembly().penalty().bound() << ".";
    AssertThrow(n_negative == 0, ExcMessage(message.str()));
    if (accuracy.correction <= 1e-5)
      return;
    std::ostringstream text;
    text << std::setprecision(1) << std::scientific
         << "the stiffness matrix is so ill-conditioned that the "
            "displacements are uncertain by about "
         << accuracy.correction << " of their size: "
         << measure_conditioning(shell_.discretization(),
                                 *shell_.problem().model.section)
              .cause();
    log.warning(text.str());
  }

  LinearSolution::Vector
  LinearSolution::dual_load(const GoalFunctional &goal, Vector &edge) const
  {
    const Assembly &assembly = shell_.assembly();
    if (goal.load)
      return goal.load(shell_.discretization());
    // z = w - v with w the response to K v.
    edge        = goal.reaction(shell_.discretization(), shell_.conditions());
    Vector v    = shell_.ghosted_vector();
    Vector zero = shell_.ghosted_vector();
    v           = edge;
    Vector load = shell_.owned_vector(), without = shell_.owned_vector();
    assembly.residual(zero, actions_, without);
    assembly.residual(v, actions_, load);
    load.add(-1., without);
    return load;
  }

  LinearSolution::Vector
  LinearSolution::solve_dual(const GoalFunctional &goal)
  {
    Vector dual = shell_.ghosted_vector();
    if (goal.is_energy)
      {
        // U = l(u)/2 for data that do no work of their own.
        dual = displacement_;
        dual *= 0.5;
        return dual;
      }
    const auto  &constraints = shell_.conditions().constraints();
    Vector       edge        = shell_.owned_vector();
    const Vector load        = dual_load(goal, edge);
    Vector       condensed   = shell_.owned_vector();
    for (const auto i : shell_.discretization().locally_owned_dofs())
      if (!constraints.is_constrained(i))
        condensed(i) += load(i);
      else
        for (const auto &[j, weight] : *constraints.get_constraint_entries(i))
          condensed(j) += weight * load(i);
    condensed.compress(VectorOperation::add);

    Vector solution = shell_.owned_vector(), offset = shell_.owned_vector();
    shell_.solver().solve(solution, condensed);
    constraints.distribute(solution);
    constraints.distribute(offset);
    solution.add(-1., offset);
    solution.add(-1., edge);
    dual = solution;
    record_.solve += timer_.lap();
    return dual;
  }


  LinearAnalysis::LinearAnalysis(const MPI_Comm            communicator,
                                 const ShellProblem       &problem,
                                 const AdaptiveRefinement &adaptive,
                                 Log                      &log)
    : communicator_(communicator)
    , problem_(problem)
    , adaptive_(adaptive)
    , log_(log)
  {}

  unsigned int
  LinearAnalysis::n_right_hand_sides() const
  {
    const GoalFunctional *const goal = adaptive_.goal();
    return goal != nullptr && !goal->is_energy ? 2 : 1;
  }

  void
  LinearAnalysis::check(const Recorder &recorder, const bool)
  {
    const DiscreteShell shell(communicator_,
                              problem_,
                              nullptr,
                              n_right_hand_sides(),
                              log_);
    recorder.check_quantities(shell.discretization());
    shell.check_integrands();
  }

  void
  LinearAnalysis::run(Recorder &recorder, const bool)
  {
    std::unique_ptr<Mesh> mesh;
    for (unsigned int cycle = 0; cycle <= adaptive_.n_cycles(); ++cycle)
      {
        mesh = run_cycle(cycle, std::move(mesh), recorder);
        if (mesh == nullptr)
          return;
      }
  }

  std::unique_ptr<LinearAnalysis::Mesh>
  LinearAnalysis::run_cycle(const unsigned int    cycle,
                            std::unique_ptr<Mesh> mesh,
                            Recorder             &recorder) const
  {
    std::optional<std::vector<bool>> marked;
    {
      CpuTimer      timer(communicator_);
      DiscreteShell shell(communicator_,
                          problem_,
                          std::move(mesh),
                          n_right_hand_sides(),
                          log_);
      const double  setup_seconds = timer.lap();
      recorder.check_quantities(shell.discretization());
      const LinearSolution solution(shell,
                                    adaptive_.goal(),
                                    setup_seconds,
                                    log_);
      const SolvedShell   &solved = solution.solved();
      auto                 row = recorder.make_row(solved, solution.record());
      ErrorEstimate        estimate;
      if (adaptive_.is_on())
        {
          estimate = adaptive_.estimate(solved, solution.dual());
          adaptive_.add_to_row(solved, estimate, row);
        }
      const std::string number = std::to_string(cycle);
      recorder.add(row,
                   solved,
                   solution.record(),
                   adaptive_.is_on() ? "cycle " + number + ", " : "",
                   adaptive_.is_on());
      recorder.write_fields(solved,
                            adaptive_.is_on() ? "_c" + number : "",
                            estimate.indicators);
      if (cycle == adaptive_.n_cycles())
        return nullptr;
      marked = adaptive_.mark(estimate, solved);
      if (!marked)
        return nullptr;
      mesh = shell.release_mesh();
    }
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() && (*marked)[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    return mesh;
  }
} // namespace Nacre
