// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/simulation/adaptive_refinement.h>
#include <nacre/simulation/discrete_shell.h>
#include <nacre/simulation/displacement_transfer.h>
#include <nacre/simulation/path_monitor.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/path_start.h>
#include <nacre/simulation/run_warnings.h>

#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    bool
    has_linear_kinematics(const ShellProblem &problem)
    {
      return problem.model.kinematics.model == KinematicsModel::linear;
    }

    /** Folder and name of a path's files, without their endings. */
    OutputOptions
    own_options(const Recorder &recorder)
    {
      OutputOptions options = recorder.options();
      options.name          = recorder.names().own_name;
      return options;
    }

  } // namespace

  /** A shell, its system of equations and the steps that solve it. */
  struct PathRun::SteppedShell
  {
    /**
     * Everything that is wrong without a step is found here.
     * @param mesh null: that of the problem
     */
    SteppedShell(const MPI_Comm                       communicator,
                 const ShellProblem                  &problem,
                 std::unique_ptr<DiscreteShell::Mesh> mesh,
                 Log                                 &log)
      : shell(communicator, problem, std::move(mesh), 1, log)
      , system(shell.discretization(),
               shell.assembly(),
               problem.model,
               shell.solver())
      , path(problem.path, system, problem.model.section)
    {}

    DiscreteShell shell;
    ShellSystem   system;
    PathAnalysis  path;
  };

  /** A state of the path with its forces, as the quantities see it. */
  class PathRun::SolvedState
  {
  public:
    /** Sets the time of the system. Collective. */
    SolvedState(const PathState &state, SteppedShell &stepped)
      : SolvedState(state, stepped.shell, stepped.path, stepped.system)
    {}

    const SolvedShell &
    shell() const
    {
      return shell_;
    }

  private:
    SolvedState(const PathState     &state,
                const DiscreteShell &shell,
                const PathAnalysis  &path,
                ShellSystem         &system)
      : displacement_(ghosted(state.time, state.motion.u, system))
      , velocity_(system.with_ghosts(state.motion.v))
      , residual_(shell.owned_vector())
      , shell_{{shell.discretization(),
                shell.problem().model,
                displacement_,
                system.actions().loads},
               shell.assembly(),
               system.actions(),
               shell.conditions(),
               residual_,
               forces(state, shell, path, system),
               path.dynamic_mass(),
               &velocity_,
               state.balance}
    {}

    using Vector = TrilinosWrappers::MPI::Vector;

    static Vector
    ghosted(const double time, const Vector &u, ShellSystem &system)
    {
      system.set_time(time);
      return system.with_ghosts(u);
    }

    /** Fills residual_: inertia is part of the reactions. */
    Energies
    forces(const PathState     &state,
           const DiscreteShell &shell,
           const PathAnalysis  &path,
           const ShellSystem   &system)
    {
      const MassTerms *const mass     = path.dynamic_mass();
      const Assembly        &assembly = shell.assembly();
      if (mass == nullptr)
        return assembly.residual(displacement_, system.actions(), residual_);
      Vector w(state.motion.a);
      w.add(shell.problem().path.mass_damping, state.motion.v);
      const Vector  ghosted_w = system.with_ghosts(w);
      const Inertia inertia{*mass, ghosted_w, 0.};
      return assembly.residual(displacement_,
                               system.actions(),
                               residual_,
                               &inertia);
    }

    const Vector      displacement_;
    const Vector      velocity_;
    Vector            residual_;
    const SolvedShell shell_;
  };

  PathRun::PathRun(const MPI_Comm            communicator,
                   const ShellProblem       &problem,
                   const AdaptiveRefinement &adaptive,
                   Log                      &log)
    : communicator_(communicator)
    , problem_(problem)
    , adaptive_(adaptive)
    , log_(log)
  {
    if (has_linear_kinematics(problem))
      warn_of_linear_path(log);
  }

  void
  PathRun::check_restart(const bool restart) const
  {
    AssertThrow(!restart || !adaptive_.is_on(),
                ExcMessage("--restart: a path with 'Adaptive "
                           "refinement/Cycles' above 0 has no checkpoints, "
                           "since they don't hold the mesh; begin anew."));
  }

  void
  PathRun::check(const Recorder &recorder, const bool restart)
  {
    check_restart(restart);
    const SteppedShell   stepped(communicator_, problem_, nullptr, log_);
    const DiscreteShell &shell = stepped.shell;
    recorder.check_quantities(shell.discretization());
    shell.check_integrands();
    const std::string base = own_options(recorder).file("");
    Checkpoint        checkpoint(shell.discretization(), base);
    load_state(shell,
               current_problem(communicator_),
               base,
               restart,
               checkpoint);
  }

  void
  PathRun::run(Recorder &recorder, const bool restart)
  {
    check_restart(restart);
    CpuTimer timer(communicator_);
    auto     stepped =
      std::make_unique<SteppedShell>(communicator_, problem_, nullptr, log_);
    SolveRecord record;
    record.setup = timer.lap();
    record.eta   = stepped->shell.assembly().penalty().eta();
    recorder.check_quantities(stepped->shell.discretization());

    const ProblemRecord problem = current_problem(communicator_);
    const OutputOptions options = own_options(recorder);
    // Of the first mesh: where it changes, nothing is saved.
    Checkpoint  checkpoint(stepped->shell.discretization(), options.file(""));
    PathMonitor monitor(communicator_,
                        options,
                        problem_.path,
                        recorder.quantities(),
                        checkpoint,
                        !adaptive_.is_on(),
                        log_);
    const auto  data = load_state(stepped->shell,
                                 problem,
                                 options.file(""),
                                 restart,
                                 checkpoint);
    PathState   state;
    if (restart)
      {
        // A restart that is refused leaves all files as they were.
        recorder.start_files(true);
        monitor.resume(*data, problem);
        state = data->state;
      }
    else
      {
        state =
          stepped->path.initial_state(data ? &data->state.motion : nullptr);
        run_on_root(communicator_, [&]() { checkpoint.remove(); });
        monitor.start(problem);
      }

    timer.lap();
    const std::string failure = follow(stepped, state, monitor);
    record.assembly           = Utilities::MPI::sum(assembly_seconds_ +
                                            stepped->system.assembly_seconds(),
                                          communicator_);
    record.solve              = timer.lap() - record.assembly;
    finish(*stepped, state, failure, record, monitor, recorder);
  }

  std::string
  PathRun::follow(std::unique_ptr<SteppedShell> &stepped,
                  PathState                     &state,
                  PathMonitor                   &monitor)
  {
    const auto observe = [&](const PathState &step) {
      const SolvedState solved(step, *stepped);
      warn_of_energy(step);
      monitor.observe(step, solved.shell());
    };
    const auto observe_point = [&](const PathPoint &point) {
      const SolvedState solved(point.state, *stepped);
      monitor.observe_point(point, solved.shell());
    };
    const auto tell = [&](const std::string &text) {
      log_.progress() << text << std::endl;
    };
    while (true)
      {
        bool       pauses = false;
        const auto is_due = [&](const PathState &step) {
          pauses = n_refinements_ < adaptive_.n_cycles() &&
                   adaptive_.is_due(step.step);
          return pauses;
        };
        const std::string failure =
          stepped->path.run(state, {observe, observe_point, tell, is_due});
        if (!pauses)
          return failure;
        refine(stepped, state);
        observe(state);
      }
  }

  void
  PathRun::refine(std::unique_ptr<SteppedShell> &stepped, PathState &state)
  {
    std::unique_ptr<DiscreteShell::Mesh> mesh;
    std::optional<DisplacementTransfer>  transfer;
    double                               estimated = 0.;
    {
      const SolvedState solved(state, *stepped);
      const auto        estimate = adaptive_.estimate(solved.shell(), {});
      const auto        marked   = adaptive_.mark(estimate, solved.shell());
      if (!marked)
        return;
      estimated = estimate.value;
      transfer.emplace(stepped->shell.discretization(),
                       solved.shell().displacement,
                       *marked);
    }
    assembly_seconds_ += stepped->system.assembly_seconds();
    mesh = stepped->shell.release_mesh();
    stepped.reset();
    transfer->refine(*mesh);
    stepped = std::make_unique<SteppedShell>(communicator_,
                                             problem_,
                                             std::move(mesh),
                                             log_);
    ++n_refinements_;
    const auto        &discretization = stepped->shell.discretization();
    std::ostringstream text;
    text << std::setprecision(3) << "refined after step " << state.step
         << ": estimate " << estimated << " before, "
         << discretization.triangulation().n_global_active_cells() << " cells, "
         << discretization.dof_handler().n_dofs() << " dofs";
    log_.progress() << text.str() << std::endl;
    state.motion.u = transfer->displacement_on(discretization);
    state.motion.v = state.motion.a = stepped->system.owned_vector();
    const std::string failure       = stepped->path.settle(state);
    AssertThrow(failure.empty(),
                ExcMessage("Adaptive refinement/Cycles: the refined mesh has "
                           "no equilibrium close to that of the mesh before at "
                           "t = " +
                           std::to_string(state.time) + ": " + failure +
                           ". Begin with a finer mesh, 'Study/Refinements', or "
                           "refine less at a time, 'Adaptive "
                           "refinement/Fraction'."));
  }

  void
  PathRun::finish(SteppedShell      &stepped,
                  const PathState   &state,
                  const std::string &failure,
                  SolveRecord       &record,
                  PathMonitor       &monitor,
                  Recorder          &recorder)
  {
    const SolvedState last(state, stepped);
    if (has_linear_kinematics(problem_))
      warn_of_large_displacements(stepped.shell.discretization(),
                                  last.shell().displacement,
                                  log_);
    record.solver = stepped.shell.solver().name();
    monitor.finish(state, last.shell());
    AssertThrow(failure.empty(), ExcMessage(failure));
    recorder.add_summary(monitor.summary());
    auto row = recorder.make_row(last.shell(), record);
    if (adaptive_.is_on())
      adaptive_.add_to_row(last.shell(),
                           adaptive_.estimate(last.shell(), {}),
                           row);
    recorder.add(row, last.shell(), record);
  }

  std::optional<CheckpointData>
  PathRun::load_state(const DiscreteShell &shell,
                      const ProblemRecord &record,
                      const std::string   &base,
                      const bool           restart,
                      Checkpoint          &checkpoint) const
  {
    const PathParameters &path = problem_.path;
    warn_of_load_factor(*problem_.model.load_factor, record, log_);
    if (restart)
      return load_restart(path, record, checkpoint, log_);
    if (!path.start_from.empty())
      return load_start(path, record, shell.discretization(), base, log_);
    return {};
  }

  void
  PathRun::warn_of_energy(const PathState &state)
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
    log_.warning(text.str());
  }
} // namespace Nacre
