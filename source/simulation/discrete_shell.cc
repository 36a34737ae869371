// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/discretization/cut_growth.h>
#include <nacre/discretization/removed_parts.h>
#include <nacre/mechanics/elastic_plate.h>
#include <nacre/multigrid/multigrid_solver.h>
#include <nacre/simulation/discrete_shell.h>
#include <nacre/simulation/memory_estimate.h>

#include <sstream>
#include <utility>

namespace Nacre
{
  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  create_mesh(const MPI_Comm communicator, const ShellProblem &problem)
  {
    return problem.model.midsurface.create_triangulation(
      communicator,
      problem.model.element.reference_cell(),
      problem.n_refinements);
  }

  namespace
  {
    Discretization
    discretize(const MPI_Comm                       communicator,
               const ShellProblem                  &problem,
               std::unique_ptr<DiscreteShell::Mesh> mesh)
    {
      const ShellModel &model = problem.model;
      if (mesh == nullptr)
        mesh = create_mesh(communicator, problem);
      Cuts cuts = model.cuts;
      cuts.poissons_ratio =
        [&](const auto &x, const auto &e_1, const auto &e_2) {
          const auto plate = elastic_plate(*model.section, x, e_1, e_2);
          // Any other is a shape function, too.
          if (!plate && model.cuts.tips != CutTips::branch_functions)
            return 0.3;
          AssertThrow(plate.has_value(),
                      ExcMessage("Cuts/Tips: branch functions are those of a "
                                 "homogeneous isotropic section; choose "
                                 "'closed'."));
          return plate->poissons_ratio;
        };
      return Discretization(std::move(mesh),
                            model.midsurface,
                            model.element,
                            model.mapping_degree,
                            cuts);
    }

    /** Throws if rigid motions are left free, naming them. */
    void
    check_supports(const DisplacementConditions &conditions, const Cuts &cuts)
    {
      const auto motions = conditions.free_rigid_motions();
      if (motions.empty())
        return;
      std::string text = "Boundary conditions: the shell can move freely:";
      for (const auto &motion : motions)
        text += (&motion == &motions.front() ? " " : "; ") + motion;
      AssertThrow(false,
                  ExcMessage(text +
                             ". Prescribe more on its edges, or at points" +
                             (cuts.is_empty() ?
                                "." :
                                "; a piece that the cuts separate can be taken "
                                "away (Cuts/Remove).")));
    }
  } // namespace

  DiscreteShell::DiscreteShell(const MPI_Comm        communicator,
                               const ShellProblem   &problem,
                               std::unique_ptr<Mesh> mesh,
                               const unsigned int    n_right_hand_sides,
                               Log                  &log)
    : problem_(problem)
    , discretization_(discretize(communicator, problem, std::move(mesh)))
    , conditions_(discretization_,
                  problem.model.supports,
                  Instant(),
                  nullptr,
                  &problem.model.foundation)
    , assembly_(discretization_, problem.model)
  {
    check_removed_edges(discretization_,
                        problem.model.midsurface,
                        problem.model.supports,
                        problem.model.loads);
    check_loaded_lips(discretization_, problem.model.cuts, problem.model.loads);
    // Inertia holds a shell as well.
    if (!problem.path.has_inertia())
      check_supports(conditions_, problem.model.cuts);
    warn_of_penalty(log);
    if (!problem.growth.is_on())
      for (const CoarseCrack &crack : coarse_cracks(discretization_))
        log.warning("Cuts/Cuts: " + in_words(crack, problem.model.cuts) +
                    " (Study/Refinements).");
    if (const auto *const openings = discretization_.tip_openings())
      for (const auto &remark : openings->remarks(problem.model.cuts))
        log.warning(remark);
    solver_ = make_solver(n_right_hand_sides, log);
    report_memory(discretization_,
                  solver_->type() == SolverType::direct ?
                    SolverStorage::factors :
                    SolverStorage::multigrid,
                  free_memory(communicator),
                  log);
  }

  void
  DiscreteShell::warn_of_penalty(Log &log) const
  {
    const auto  &eta   = problem_.model.eta;
    const double bound = assembly_.penalty().bound();
    if (!eta || *eta >= bound)
      return;
    std::ostringstream text;
    text << "Study/Penalties: eta = " << *eta << " is below the bound " << bound
         << " that makes the form coercive; the matrix may be indefinite.";
    log.warning(text.str());
  }

  std::unique_ptr<ChosenSolver>
  DiscreteShell::make_solver(const unsigned int n_right_hand_sides,
                             Log               &log) const
  {
    const SolverParameters &chosen = problem_.solver;
    const bool              can_coarsen =
      MultigridSolver::has_coarser_mesh(discretization_) &&
      problem_.model.section->n_state_variables() == 0;
    if (chosen.type == SolverType::multigrid && !can_coarsen)
      log.warning(
        "Linear solver/Solver: the mesh is not refined from a coarser one, "
        "nor is there a coarser space than degree 2; the direct solver is "
        "taken.");
    SolverTask task;
    task.n_dofs             = discretization_.n_dofs();
    task.degree             = discretization_.degree();
    task.n_right_hand_sides = n_right_hand_sides;
    // The eight functions of a tip cost as much as a solution.
    if (discretization_.has_tip_functions() &&
        discretization_.tip_openings() == nullptr)
      task.n_right_hand_sides += discretization_.tips().size();
    task.n_levels = discretization_.triangulation().n_global_levels() - 1;
    task.memory   = free_memory(discretization_.communicator());

    ChosenSolver::Factory make_multigrid;
    if (can_coarsen && !problem_.path.needs_direct_solver() &&
        (chosen.type == SolverType::multigrid ||
         (chosen.type == SolverType::automatic && prefers_multigrid(task))))
      make_multigrid = [&]() -> std::unique_ptr<LinearSolver> {
        MultigridSolver::Parameters parameters;
        parameters.max_iterations = chosen.max_iterations;
        parameters.coarse_dofs    = chosen.coarse_dofs;
        auto solver = std::make_unique<MultigridSolver>(discretization_,
                                                        problem_.model,
                                                        parameters,
                                                        &conditions_);
        if (solver->n_levels() > 1 || solver->why_no_coarser_level().empty())
          return solver;
        if (chosen.type == SolverType::multigrid)
          log.warning("Linear solver/Solver: the cells of a coarser mesh are "
                      "too large for the cuts, and the direct solver is "
                      "taken. There: " +
                      solver->why_no_coarser_level());
        return nullptr;
      };
    return std::make_unique<ChosenSolver>(discretization_.communicator(),
                                          make_multigrid,
                                          log);
  }

  void
  DiscreteShell::check_integrands() const
  {
    const TrilinosWrappers::MPI::Vector zero   = ghosted_vector();
    TrilinosWrappers::MPI::Vector       unused = owned_vector();
    assembly_.residual(zero, assembly_.actions(problem_.model.at(0.)), unused);
  }
} // namespace Nacre
