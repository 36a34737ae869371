// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/simulation/growth_analysis.h>
#include <nacre/simulation/growth_monitor.h>

#include <utility>

namespace Nacre
{
  /** A linear solution with all loads and prescribed values times a factor. */
  class GrowthAnalysis::FactoredSolution
  {
  public:
    /** Collective. */
    FactoredSolution(const SolvedShell   &unit,
                     const DiscreteShell &shell,
                     const double         factor)
      : displacement_(factored(unit.displacement, factor))
      , actions_(shell.assembly().actions({0., factor}))
      , residual_(shell.owned_vector())
      , solved_{{shell.discretization(),
                 shell.problem().model,
                 displacement_,
                 actions_.loads},
                shell.assembly(),
                actions_,
                shell.conditions(),
                residual_,
                shell.assembly().residual(displacement_, actions_, residual_)}
    {}

    const SolvedShell &
    solved() const
    {
      return solved_;
    }

  private:
    using Vector = TrilinosWrappers::MPI::Vector;

    static Vector
    factored(Vector u, const double factor)
    {
      u *= factor;
      return u;
    }

    const Vector       displacement_;
    const ShellActions actions_;
    Vector             residual_;
    const SolvedShell  solved_;
  };

  /** The files of the run's own. */
  struct GrowthAnalysis::Output
  {
    Output(const MPI_Comm       communicator,
           const ShellProblem  &problem,
           const OutputOptions &options,
           const Recorder      &recorder,
           Log                 &log)
      : options(options)
      , monitor(communicator, options, problem, recorder.quantities(), log)
      , fields(options.fields)
    {}

    void
    write(const SolvedShell &shell, const unsigned int step)
    {
      if (options.write_vtu)
        fields.write(shell,
                     options.folder,
                     options.name,
                     {step, double(step), std::to_string(step)});
    }

    const OutputOptions options;
    GrowthMonitor       monitor;
    VtuOutput           fields;
  };

  GrowthAnalysis::GrowthAnalysis(const MPI_Comm communicator,
                                 ShellProblem  &problem,
                                 Log           &log)
    : communicator_(communicator)
    , problem_(problem)
    , log_(log)
    , growth_(problem, log)
  {}

  void
  GrowthAnalysis::check(const Recorder &recorder, const bool)
  {
    const DiscreteShell shell(communicator_, problem_, nullptr, 1, log_);
    growth_.check(shell.discretization());
    recorder.check_quantities(shell.discretization());
    shell.check_integrands();
  }

  void
  GrowthAnalysis::run(Recorder &recorder, const bool)
  {
    OutputOptions options = recorder.options();
    options.name          = recorder.names().own_name;
    Output output(communicator_, problem_, options, recorder, log_);
    std::unique_ptr<DiscreteShell::Mesh> mesh;
    do
      mesh = run_step(std::move(mesh), recorder, output);
    while (mesh != nullptr);
    recorder.add_summary(output.monitor.summary());
  }

  std::unique_ptr<DiscreteShell::Mesh>
  GrowthAnalysis::run_step(std::unique_ptr<DiscreteShell::Mesh> mesh,
                           Recorder                            &recorder,
                           Output                              &output)
  {
    CpuTimer      timer(communicator_);
    const bool    is_first = mesh == nullptr;
    DiscreteShell shell(communicator_, problem_, std::move(mesh), 1, log_);
    const auto   &discretization = shell.discretization();
    const double  setup_seconds  = timer.lap();
    if (is_first)
      {
        growth_.check(discretization);
        recorder.check_quantities(discretization);
      }
    const LinearSolution solution(shell, nullptr, setup_seconds, log_);
    growth_.observe(solution.solved());
    const double           factor = growth_.critical_factor();
    const FactoredSolution factored(solution.solved(), shell, factor);
    growth_.scale(factor);
    output.monitor.observe(growth_, growth_.n_steps(), factored.solved());
    output.write(factored.solved(), growth_.n_steps());
    if (!growth_.has_ended())
      {
        growth_.advance(discretization, growth_.n_steps(), true);
        if (growth_.has_tips())
          return shell.release_mesh();
        log_.progress() << "growth ends: this step leaves no tip inside the "
                           "surface, and isn't solved or counted"
                        << std::endl;
      }
    recorder.add(recorder.make_row(factored.solved(), solution.record()),
                 factored.solved(),
                 solution.record());
    return nullptr;
  }
} // namespace Nacre
