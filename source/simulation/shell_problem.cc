// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/base/log.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/reference_assembly.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/multigrid/multigrid_solver.h>
#include <nacre/postprocess/error_estimator.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/chosen_solver.h>
#include <nacre/simulation/conditioning.h>
#include <nacre/simulation/memory_estimate.h>
#include <nacre/simulation/run_warnings.h>
#include <nacre/simulation/shell_problem.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** The value of the enumeration whose name is @p name. */
    template <typename Enumeration>
    Enumeration
    selected(const std::vector<std::string> &names, const std::string &name)
    {
      return static_cast<Enumeration>(
        std::find(names.begin(), names.end(), name) - names.begin());
    }
  } // namespace

  ShellProblem::ShellProblem(const MPI_Comm              communicator,
                             std::unique_ptr<SectionLaw> section)
    : ParameterAcceptor("/Discretization")
    , communicator_(communicator)
    , section_(std::move(section))
    , solver_parameters_(std::make_unique<LinearSolverParameters>())
  {
    add_parameter(
      "Element",
      element_,
      "Displacement element, continuous: Lagrange, (p+1)^2 nodes on "
      "quadrilaterals, p = 2 to 5; serendipity, 8 nodes; "
      "triangle, 6 nodes on halves of the quadrilaterals.",
      prm,
      Patterns::Selection("Lagrange|serendipity|triangle"));
    add_parameter("Mapping degree",
                  mapping_degree_,
                  "Degree of the mid-surface's geometry, 1 to 6; 0 is that of "
                  "the element (isoparametric), the only one for other than "
                  "Lagrange cells. Above the element's degree, rigid rotations "
                  "store some energy.",
                  prm,
                  Patterns::Integer(0, 6));
    add_parameter("Membrane strain",
                  membrane_strain_name_,
                  "tied: sampled at Gauss points and interpolated, free of "
                  "membrane locking; full: integrated as it is, locks; "
                  "reduced: p x p points with a share of full integration, for "
                  "8-node cells 2 x 2 points and for triangles 3 points for "
                  "the bending strain as well; default: reduced for 8-node "
                  "cells, tied for all others.",
                  prm,
                  Patterns::Selection("default|tied|full|reduced"));
    add_parameter("Edge form",
                  edge_form_name_,
                  "hinge: rotations and moments of an edge in each cell's own "
                  "frame, independent of creases; averaged normal: in a frame "
                  "with the mean of both cells' normals, the same where the "
                  "surface is smooth, but dependent on the angle of a crease.",
                  prm,
                  Patterns::Selection("hinge|averaged normal"));
    add_parameter("Kinematics",
                  kinematics_name_,
                  "linear: small displacements; corotational: large rotations "
                  "with small strains, in frames that turn with the material; "
                  "finite: exact rotations and Green strains of any size, one "
                  "energy with its exact gradient and symmetric derivative.",
                  prm,
                  Patterns::Selection("linear|corotational|finite"));
    add_parameter(
      "Tangent",
      tangent_name_,
      "For co-rotational kinematics: consistent, the derivative of "
      "the internal forces, of which the symmetric solver takes the "
      "symmetric part; frozen, with the rotations held, which "
      "needs many more iterations and may not converge. Finite kinematics has "
      "the consistent one only.",
      prm,
      Patterns::Selection("frozen|consistent"));
    add_parameter("Assembly",
                  assembly_name_,
                  "fast: tables and blocks of nodes; reference: a textbook's "
                  "loop over FEValues and FEInterfaceValues, several times "
                  "slower, for linear analyses in the hinge form. Both give "
                  "the same numbers.",
                  prm,
                  Patterns::Selection("fast|reference"));
  }

  ShellProblem::~ShellProblem() = default;

  void
  ShellProblem::set_folder(const std::string &folder)
  {
    midsurface_.set_files(communicator_, folder);
  }

  void
  ShellProblem::prepare(const Constants &constants, const ShellCase &shell_case)
  {
    case_ = shell_case;
    refined_mesh_.reset();
    check_element();
    if (case_.thickness)
      section_->set_thickness(*case_.thickness);
    section_->prepare(constants);
    constants_ = constants;
    for (const auto &[name, value] : section_->named_constants())
      {
        AssertThrow(constants.count(name) == 0,
                    ExcMessage("Constants: '" + name +
                               "' is the section's; choose another name."));
        constants_[name] = value;
      }
    midsurface_.prepare(constants_);
    section_->set_regions(midsurface_.regions());
    auto edges_in_use = boundary_conditions_.named_edges();
    for (const std::string &name : loads_.named_edges())
      edges_in_use.push_back(name);
    midsurface_.use_edges(edges_in_use);
    boundary_conditions_.prepare(midsurface_, constants_);
    loads_.prepare(midsurface_, constants_);
    exact_solution_.prepare(constants_);
    path_parameters_.prepare(constants_);
    AssertThrow(kinematics_name_ == "linear" || edge_form_name_ == "hinge",
                ExcMessage("Discretization/Edge form: co-rotational and finite "
                           "kinematics have the hinge form only; found '" +
                           edge_form_name_ + "'."));
    AssertThrow(solver_parameters_->solver != "multigrid" ||
                  path_parameters_.type != AnalysisType::dynamic,
                ExcMessage("Linear solver/Solver: 'multigrid' doesn't know the "
                           "inertia of a dynamic analysis; choose auto or "
                           "direct."));
    AssertThrow(assembly_name_ == "fast" ||
                  (is_linear() && edge_form_name_ == "hinge"),
                ExcMessage("Discretization/Assembly: 'reference' knows linear "
                           "analyses in the hinge form only; choose 'fast'."));
    if (is_linear())
      {
        AssertThrow(kinematics_name_ == "linear",
                    ExcMessage("Discretization/Kinematics: '" +
                               kinematics_name_ +
                               "' is nonlinear; choose 'Analysis/Type = "
                               "static', relaxation or dynamic."));
        AssertThrow(!loads_.pressure_follows(),
                    ExcMessage("Loads/Pressure follows: a linear analysis "
                               "knows the undeformed surface only; choose "
                               "another 'Analysis/Type'."));
        loads_.set_time(0., 1.);
        boundary_conditions_.set_time(0., 1.);
      }
  }

  void
  ShellProblem::check_element() const
  {
    if (element().type == ElementType::lagrange)
      return;
    AssertThrow(case_.degree == 2,
                ExcMessage("Study/Degrees: the element '" + element_ +
                           "' is of degree 2; found " +
                           std::to_string(case_.degree) + "."));
    AssertThrow(mapping_degree_ == 0 || mapping_degree_ == 2,
                ExcMessage("Discretization/Mapping degree: the element '" +
                           element_ + "' is isoparametric: 0 or 2; found " +
                           std::to_string(mapping_degree_) + "."));
  }

  Element
  ShellProblem::element() const
  {
    return {selected<ElementType>(element_names(), element_), case_.degree};
  }

  KinematicsOptions
  ShellProblem::kinematics_options() const
  {
    KinematicsOptions options;
    options.membrane_strain =
      membrane_strain_name_ == "default" ?
        default_membrane_strain(element().type) :
        selected<MembraneStrain>(membrane_strain_names(),
                                 membrane_strain_name_);
    options.edge_form = selected<EdgeForm>(edge_form_names(), edge_form_name_);
    options.model =
      selected<KinematicsModel>(kinematics_model_names(), kinematics_name_);
    // The direct solver reads one triangle of the matrix.
    options.tangent =
      tangent_name_ == "frozen" ? TangentType::frozen : TangentType::symmetric;
    return options;
  }

  double
  ShellProblem::eta() const
  {
    return operator_->penalty().eta();
  }

  const SolvedShell &
  ShellProblem::solution() const
  {
    Assert(solution_ != nullptr, ExcNotInitialized());
    return *solution_;
  }

  void
  ShellProblem::warn_of_penalty(Log &log) const
  {
    const double bound = operator_->penalty().bound();
    if (case_.eta && *case_.eta < bound)
      {
        std::ostringstream text;
        text << "Study/Penalties: eta = " << *case_.eta
             << " is below the bound " << bound
             << " that makes the form coercive; the matrix may be indefinite.";
        log.warning(text.str());
      }
  }

  void
  ShellProblem::clear()
  {
    times_ = SolveTimes();
    solution_.reset();
    path_.reset();
    system_.reset();
    solver_record_ = SolverRecord();
    solver_.reset();
    matrix_.clear();
    conditions_.reset();
    operator_.reset();
    discretization_.reset();
  }

  void
  ShellProblem::set_up(Log &log)
  {
    clear();
    CpuTimer timer(communicator_);
    discretization_ = std::make_unique<Discretization>(
      refined_mesh_ != nullptr ?
        std::move(refined_mesh_) :
        midsurface_.create_triangulation(communicator_,
                                         element().reference_cell(),
                                         case_.n_refinements),
      [this](const auto &cell, const auto &unit) {
        return midsurface_.position(cell, unit);
      },
      element(),
      mapping_degree_);
    conditions_ =
      std::make_unique<DisplacementConditions>(*discretization_,
                                               boundary_conditions_);
    if (path_parameters_.type != AnalysisType::dynamic)
      check_supports();
    operator_ = std::make_unique<ShellOperator>(*discretization_,
                                                *section_,
                                                boundary_conditions_,
                                                loads_,
                                                kinematics_options(),
                                                case_.eta);
    warn_of_penalty(log);
    make_solver(log);
    report_memory(*discretization_,
                  solver_->name() == "direct" ? SolverStorage::factors :
                                                SolverStorage::multigrid,
                  free_memory(communicator_),
                  log);
    if (!is_linear())
      {
        if (has_linear_kinematics())
          warn_of_linear_path(log);
        system_ = std::make_unique<ShellSystem>(*discretization_,
                                                *operator_,
                                                boundary_conditions_,
                                                loads_,
                                                path_parameters_.load_factor,
                                                *solver_);
        path_ =
          std::make_unique<PathAnalysis>(path_parameters_, *system_, *section_);
      }
    times_.setup = timer.lap();
  }

  void
  ShellProblem::check_integrands() const
  {
    const IndexSet               &owned = discretization_->locally_owned_dofs();
    TrilinosWrappers::MPI::Vector zero(owned,
                                       discretization_->locally_relevant_dofs(),
                                       communicator_);
    TrilinosWrappers::MPI::Vector unused(owned, communicator_);
    operator_->residual(zero, unused);
  }

  void
  ShellProblem::check_supports() const
  {
    const auto motions = conditions_->free_rigid_motions();
    if (motions.empty())
      return;
    std::string text = "Boundary conditions: the shell can move freely:";
    for (const auto &motion : motions)
      text += (&motion == &motions.front() ? " " : "; ") + motion;
    AssertThrow(false,
                ExcMessage(text + ". Prescribe more on its edges, or at "
                                  "points."));
  }

  void
  ShellProblem::solve(Log &log)
  {
    solve_linear_system(log);
    warn_of_large_displacements(*discretization_, displacement_, log);

    residual_.reinit(discretization_->locally_owned_dofs(), communicator_);
    const Energies energies = operator_->residual(displacement_, residual_);
    solution_ = std::make_unique<SolvedShell>(SolvedShell{*discretization_,
                                                          *section_,
                                                          *operator_,
                                                          *conditions_,
                                                          kinematics_options(),
                                                          exact_solution_,
                                                          displacement_,
                                                          residual_,
                                                          energies});
  }

  PathState
  ShellProblem::start_path(const MotionState *start)
  {
    return path_->initial_state(start);
  }

  std::string
  ShellProblem::follow_path(PathState          &state,
                            const PathObserver &observer,
                            Log                &log)
  {
    CpuTimer          timer(communicator_);
    const std::string failure = path_->run(
      state,
      [&](const PathState &step) {
        take_state(step);
        warn_of_energy(step, log);
        observer(step, *solution_);
      },
      [&](const std::string &text) { log.progress() << text << std::endl; });
    take_state(state);
    if (has_linear_kinematics())
      warn_of_large_displacements(*discretization_, displacement_, log);
    solver_record_.name = solver_->name();
    times_.assembly =
      Utilities::MPI::sum(system_->assembly_seconds(), communicator_);
    times_.solve = timer.lap() - times_.assembly;
    return failure;
  }

  void
  ShellProblem::warn_of_energy(const PathState &state, Log &log)
  {
    const double gain = state.balance.relative_gain();
    if (gain <= 0.01 || has_warned_of_energy_)
      return;
    has_warned_of_energy_ = true;
    std::ostringstream text;
    text << std::setprecision(2) << "Analysis/Scheme: at t = " << state.time
         << " the motion has gained " << 100. * gain
         << " % of its largest energy that nothing has put in; 10 % end the "
            "run. 'energy momentum' conserves energy, a smaller 'Time step' "
            "helps the other schemes.";
    log.warning(text.str());
  }

  void
  ShellProblem::take_state(const PathState &state)
  {
    system_->set_time(state.time);
    displacement_.reinit(system_->with_ghosts(state.motion.u));
    displacement_ = state.motion.u;
    velocity_.reinit(displacement_);
    velocity_ = state.motion.v;
    // Inertia is part of the reactions.
    const MassTerms              *mass = path_->mass();
    TrilinosWrappers::MPI::Vector w(state.motion.a);
    w.add(path_parameters_.mass_damping, state.motion.v);
    const auto             ghosted_w = system_->with_ghosts(w);
    std::optional<Inertia> inertia;
    const bool dynamic = (path_parameters_.type == AnalysisType::dynamic);
    if (dynamic)
      inertia.emplace(Inertia{*mass, ghosted_w, 0.});
    residual_.reinit(discretization_->locally_owned_dofs(), communicator_);
    const Energies energies =
      operator_->residual(displacement_,
                          residual_,
                          inertia ? &*inertia : nullptr);
    solution_ =
      std::make_unique<SolvedShell>(SolvedShell{*discretization_,
                                                *section_,
                                                *operator_,
                                                *conditions_,
                                                kinematics_options(),
                                                exact_solution_,
                                                displacement_,
                                                residual_,
                                                energies,
                                                dynamic ? mass : nullptr,
                                                &velocity_,
                                                state.balance});
  }

  void
  ShellProblem::make_solver(Log &log)
  {
    const auto &chosen = solver_parameters_->solver;
    const bool  can_coarsen =
      MultigridSolver::has_coarser_mesh(*discretization_);
    if (chosen == "multigrid" && !can_coarsen)
      log.warning(
        "Linear solver/Solver: the mesh is not refined from a coarser one, "
        "nor is there a coarser space than degree 2; the direct solver is "
        "taken.");
    SolverTask task;
    task.n_dofs             = discretization_->dof_handler().n_dofs();
    task.degree             = discretization_->degree();
    task.n_right_hand_sides = (goal_ != nullptr && !goal_->is_energy) ? 2 : 1;
    task.n_levels = discretization_->triangulation().n_global_levels() - 1;
    task.memory   = free_memory(communicator_);

    ChosenSolver::Factory make_multigrid;
    if (can_coarsen && path_parameters_.type != AnalysisType::dynamic &&
        (chosen == "multigrid" ||
         (chosen == "auto" && prefers_multigrid(task))))
      make_multigrid = [this]() {
        MultigridSolver::Parameters parameters;
        parameters.max_iterations = solver_parameters_->max_iterations;
        return std::make_unique<MultigridSolver>(
          *discretization_,
          ShellDescription{midsurface_,
                           *section_,
                           boundary_conditions_,
                           loads_,
                           kinematics_options(),
                           case_.eta,
                           conditions_.get()},
          parameters);
      };
    solver_ =
      std::make_unique<ChosenSolver>(communicator_, make_multigrid, log);
  }

  void
  ShellProblem::solve_linear_system(Log &log)
  {
    CpuTimer                      timer(communicator_);
    const IndexSet               &owned = discretization_->locally_owned_dofs();
    const auto                   &constraints = conditions_->constraints();
    TrilinosWrappers::MPI::Vector right_hand_side(owned, communicator_);
    TrilinosWrappers::MPI::Vector solution(owned, communicator_);
    const auto                    assemble = [&](const auto &assembly) {
      assembly.reinit_matrix(constraints, matrix_);
      times_.setup += timer.lap();
      assembly.assemble_system(constraints, matrix_, right_hand_side);
      times_.assembly += timer.lap();
    };
    if (assembly_name_ == "fast")
      assemble(*operator_);
    else
      assemble(ReferenceAssembly(*discretization_,
                                 *section_,
                                 boundary_conditions_,
                                 loads_,
                                 operator_->penalty(),
                                 kinematics_options().membrane_strain));

    solver_->prepare({matrix_, constraints, nullptr});
    const auto accuracy = solver_->solve(solution, right_hand_side);
    check_regular(accuracy.is_regular);
    solver_record_ = {solver_->name(), accuracy.n_iterations};
    times_.solve += timer.lap();
    judge(accuracy, log);

    constraints.distribute(solution);
    displacement_.reinit(owned, conditions_->relevant_dofs(), communicator_);
    displacement_ = solution;
    if (goal_ != nullptr)
      {
        solve_dual(*solver_, constraints);
        times_.solve += timer.lap();
      }
  }

  void
  ShellProblem::judge(const SolveAccuracy &accuracy, Log &log) const
  {
    const unsigned int n_negative = solver_->n_negative_pivots().value_or(0);
    std::ostringstream message;
    message << "The stiffness matrix is not positive definite: " << n_negative
            << (n_negative == 1 ? " negative pivot" : " negative pivots")
            << ". Study/Penalties: eta = " << eta()
            << " is too small; the bound is " << operator_->penalty().bound()
            << ".";
    AssertThrow(n_negative == 0, ExcMessage(message.str()));
    if (accuracy.correction > 1e-5)
      {
        std::ostringstream text;
        text << std::setprecision(1) << std::scientific
             << "the stiffness matrix is so ill-conditioned that the "
                "displacements are uncertain by about "
             << accuracy.correction << " of their size: "
             << measure_conditioning(*discretization_, *section_).cause();
        log.warning(text.str());
      }
  }

  void
  ShellProblem::solve_dual(LinearSolver                    &solver,
                           const AffineConstraints<double> &constraints)
  {
    using Vector          = TrilinosWrappers::MPI::Vector;
    const IndexSet &owned = discretization_->locally_owned_dofs();
    dual_.reinit(displacement_);
    if (goal_->is_energy)
      {
        // U = l(u)/2 for data that do no work of their own.
        dual_ = displacement_;
        dual_ *= 0.5;
        return;
      }
    Vector load(owned, communicator_), edge(owned, communicator_);
    if (goal_->load)
      load = goal_->load(*discretization_);
    else
      {
        // z = w - v with w the response to K v.
        edge  = goal_->reaction(*discretization_, *conditions_);
        dual_ = edge;
        Vector without(owned, communicator_), zero(dual_);
        zero = 0.;
        operator_->residual(zero, without);
        operator_->residual(dual_, load);
        load.add(-1., without);
      }
    Vector condensed(owned, communicator_);
    for (const auto i : owned)
      if (!constraints.is_constrained(i))
        condensed(i) += load(i);
      else
        for (const auto &[j, weight] : *constraints.get_constraint_entries(i))
          condensed(j) += weight * load(i);
    condensed.compress(VectorOperation::add);

    Vector solution(owned, communicator_), offset(owned, communicator_);
    solver.solve(solution, condensed);
    constraints.distribute(solution);
    constraints.distribute(offset);
    solution.add(-1., offset);
    solution.add(-1., edge);
    dual_ = solution;
  }

  std::unique_ptr<ErrorEstimator>
  ShellProblem::make_error_estimator() const
  {
    return std::make_unique<ErrorEstimator>(*discretization_,
                                            *section_,
                                            boundary_conditions_,
                                            loads_,
                                            operator_->penalty(),
                                            kinematics_options());
  }

  void
  ShellProblem::refine(const std::vector<bool> &marked)
  {
    auto mesh = discretization_->release_triangulation();
    clear();
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() && marked[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    refined_mesh_ = std::move(mesh);
  }
} // namespace Nacre
