// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/simulation/discrete_shell.h>
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

    /** A shell, its system of equations and the steps that solve it. */
    struct SteppedShell
    {
      /** Everything that is wrong without a step is found here. */
      SteppedShell(const MPI_Comm      communicator,
                   const ShellProblem &problem,
                   Log                &log)
        : shell(communicator, problem, nullptr, 1, log)
        , system(shell.discretization(),
                 shell.shell_operator(),
                 problem.model,
                 shell.solver())
        , path(problem.path, system, problem.model.section)
      {
        if (has_linear_kinematics(problem))
          warn_of_linear_path(log);
      }

      DiscreteShell shell;
      ShellSystem   system;
      PathAnalysis  path;
    };
  } // namespace

  /** A state of the path with its forces, as the quantities see it. */
  class PathRun::SolvedState
  {
  public:
    /** Sets the time of the @p system. Collective. */
    SolvedState(const PathState     &state,
                const DiscreteShell &shell,
                const PathAnalysis  &path,
                ShellSystem         &system)
      : displacement_(ghosted(state.time, state.motion.u, system))
      , velocity_(system.with_ghosts(state.motion.v))
      , residual_(shell.owned_vector())
      , shell_{{shell.discretization(), shell.problem().model, displacement_},
               shell.shell_operator(),
               system.actions(),
               shell.conditions(),
               residual_,
               forces(state, shell, path, system),
               path.dynamic_mass(),
               &velocity_,
               state.balance}
    {}

    const SolvedShell &
    shell() const
    {
      return shell_;
    }

  private:
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
      const MassTerms *const mass           = path.dynamic_mass();
      const ShellOperator   &shell_operator = shell.shell_operator();
      if (mass == nullptr)
        return shell_operator.residual(displacement_,
                                       system.actions(),
                                       residual_);
      Vector w(state.motion.a);
      w.add(shell.problem().path.mass_damping, state.motion.v);
      const Vector  ghosted_w = system.with_ghosts(w);
      const Inertia inertia{*mass, ghosted_w, 0.};
      return shell_operator.residual(displacement_,
                                     system.actions(),
                                     residual_,
                                     &inertia);
    }

    const Vector      displacement_;
    const Vector      velocity_;
    Vector            residual_;
    const SolvedShell shell_;
  };

  PathRun::PathRun(const MPI_Comm      communicator,
                   const ShellProblem &problem,
                   Log                &log)
    : communicator_(communicator)
    , problem_(problem)
    , log_(log)
  {}

  void
  PathRun::check(const Recorder &recorder, const bool restart)
  {
    const SteppedShell   stepped(communicator_, problem_, log_);
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
    CpuTimer       timer(communicator_);
    SteppedShell   stepped(communicator_, problem_, log_);
    DiscreteShell &shell  = stepped.shell;
    ShellSystem   &system = stepped.system;
    PathAnalysis  &path   = stepped.path;
    SolveRecord    record;
    record.setup = timer.lap();
    record.eta   = shell.shell_operator().penalty().eta();
    recorder.check_quantities(shell.discretization());

    const ProblemRecord problem = current_problem(communicator_);
    const OutputOptions options = own_options(recorder);
    Checkpoint          checkpoint(shell.discretization(), options.file(""));
    PathMonitor         monitor(communicator_,
                        options,
                        problem_.path,
                        recorder.quantities(),
                        checkpoint,
                        log_);
    const auto          data =
      load_state(shell, problem, options.file(""), restart, checkpoint);
    PathState state;
    if (restart)
      {
        // A restart that is refused leaves all files as they were.
        recorder.start_files(true);
        monitor.resume(*data, problem);
        state = data->state;
      }
    else
      {
        state = path.initial_state(data ? &data->state.motion : nullptr);
        run_on_root(communicator_, [&]() { checkpoint.remove(); });
        monitor.start(problem);
      }

    timer.lap();
    const std::string failure = path.run(
      state,
      [&](const PathState &step) {
        const SolvedState solved(step, shell, path, system);
        warn_of_energy(step);
        monitor.observe(step, solved.shell());
      },
      [&](const std::string &text) { log_.progress() << text << std::endl; });
    const SolvedState last(state, shell, path, system);
    if (has_linear_kinematics(problem_))
      warn_of_large_displacements(shell.discretization(),
                                  last.shell().displacement,
                                  log_);
    record.solver = shell.solver().name();
    record.assembly =
      Utilities::MPI::sum(system.assembly_seconds(), communicator_);
    record.solve = timer.lap() - record.assembly;
    monitor.finish(state, last.shell());
    AssertThrow(failure.empty(), ExcMessage(failure));
    recorder.add_summary(monitor.summary());
    recorder.add(recorder.make_row(last.shell(), record), last.shell(), record);
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
