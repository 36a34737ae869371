// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/node_values.h>
#include <nacre/simulation/mode_analysis.h>
#include <nacre/simulation/path_start.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    OutputOptions
    mode_files(const Recorder &recorder)
    {
      OutputOptions options = recorder.options();
      options.name          = recorder.names().own_name;
      return options;
    }

    /** The table of modes, in columns or separated by commas. */
    std::string
    table_of_modes(const ModeValues               &modes,
                   const std::string              &name,
                   const std::vector<std::string> &remarks,
                   const bool                      csv)
    {
      std::ostringstream text;
      const auto         cell = [&](const auto &entry, const int width) {
        if (csv)
          text << (width == 0 ? "" : ",") << entry;
        else
          text << std::setw(width == 0 ? 5 : width) << entry;
      };
      text << std::setprecision(csv ? 12 : 8);
      cell("mode", 0);
      cell(name, 18);
      if (modes.are_frequencies)
        cell("frequency", 18);
      cell("multiplicity", 14);
      text << (csv ? ",remark\n" : "\n");
      for (unsigned int k = 0; k < modes.values.size(); ++k)
        {
          cell(modes.n_below + k + 1, 0);
          cell(modes.values[k], 18);
          if (modes.are_frequencies)
            cell(modes.values[k] / (2. * numbers::PI), 18);
          cell(modes.multiplicities[k], 14);
          const std::string remark = k < remarks.size() ? remarks[k] : "";
          text << (csv ? "," : remark.empty() ? "" : "  ") << remark << '\n';
        }
      return text.str();
    }
  } // namespace

  ModeAnalysis::ModeAnalysis(const MPI_Comm      communicator,
                             const ShellProblem &problem,
                             Log                &log)
    : communicator_(communicator)
    , problem_(problem)
    , log_(log)
  {}

  void
  ModeAnalysis::check(const Recorder &recorder, const bool)
  {
    DiscreteShell shell(communicator_, problem_, nullptr, 1, log_);
    recorder.check_quantities(shell.discretization());
    shell.check_integrands();
    const Prestress prestress(shell.discretization(),
                              shell.assembly(),
                              problem_.model,
                              problem_.modes);
    load_start_state(shell, recorder);
    check_problem(shell, prestress);
  }

  void
  ModeAnalysis::load_start_state(DiscreteShell &shell, const Recorder &recorder)
  {
    const PathParameters &path = problem_.path;
    if (path.start_from.empty())
      return;
    PathState state =
      load_start(path,
                 current_problem(communicator_, problem_.model.midsurface),
                 shell.discretization(),
                 mode_files(recorder).file(""),
                 log_)
        .state;
    ShellSystem system(shell.discretization(),
                       shell.assembly(),
                       problem_.model,
                       shell.solver());
    auto found = find_equilibrium(path, system, state, state.time, false);
    AssertThrow(found.result.converged,
                ExcMessage("Analysis/Start from: under the loads and supports "
                           "of this file at its t = " +
                           std::to_string(state.time) +
                           " that state isn't near an equilibrium: " +
                           found.result.reason +
                           ". Take those of the run that it is of."));
    const Vector &u    = found.motion.u;
    Vector        du   = shell.owned_vector();
    const auto    step = system.solve_linearised(u, du);
    AssertThrow(step.failure.kind == FailureKind::none,
                ExcMessage("Analysis/Start from: in that state " +
                           step.failure.text +
                           ". Take one a little before it."));
    const auto rate = system.rate(u, state.time, 0.01 * path.time_step);
    start_.emplace(StartState{system.with_ghosts(u),
                              system.with_ghosts(rate.velocity),
                              state.time});
  }

  void
  ModeAnalysis::run(Recorder &recorder, const bool)
  {
    CpuTimer        timer(communicator_);
    DiscreteShell   shell(communicator_, problem_, nullptr, 1, log_);
    const Prestress prestress(shell.discretization(),
                              shell.assembly(),
                              problem_.model,
                              problem_.modes);
    SolveRecord     record;
    record.setup  = timer.lap();
    record.eta    = shell.assembly().penalty().eta();
    record.solver = "direct";
    recorder.check_quantities(shell.discretization());
    load_start_state(shell, recorder);
    check_problem(shell, prestress);
    const Modes modes = find_modes(shell, prestress);
    record.assembly   = modes.assembly;
    record.solve      = timer.lap() - record.assembly;

    const ShellActions actions =
      shell.assembly().actions(problem_.model.at(start_ ? start_->time : 1.));
    Vector            residual = shell.owned_vector();
    const SolvedShell solved{
      {shell.discretization(), problem_.model, modes.state, actions.loads},
      shell.assembly(),
      actions,
      shell.conditions(),
      residual,
      shell.assembly().residual(modes.state, actions, residual),
      nullptr,
      nullptr,
      nullptr,
      {},
      &modes.values};
    const auto row = recorder.make_row(solved, record);
    write_table(modes, recorder);
    if (recorder.options().write_vtu)
      write_fields(modes, prestress, shell, recorder);
    recorder.add(row, solved, record);
  }

  void
  ModeAnalysis::write_table(const Modes &modes, Recorder &recorder) const
  {
    const OutputOptions options = mode_files(recorder);
    run_on_root(communicator_, [&]() {
      write_file(options.file("_modes.csv"), [&](std::ostream &out) {
        out << table_of_modes(modes.values, value_name(), modes.remarks, true);
      });
    });
    std::ostringstream text;
    text << '\n'
         << recorder.names().progress << "modes, " << options.file("_modes.csv")
         << ":\n"
         << table_of_modes(modes.values, value_name(), modes.remarks, false);
    for (const auto &note : modes.notes)
      text << note << '\n';
    if (options.report_seconds)
      text << modes.n_factorisations << " factorisations, "
           << modes.n_substitutions << " substitutions\n";
    log_.results() << text.str() << std::endl;
  }

  ModeAnalysis::Vector
  ModeAnalysis::scaled_mode(const Vector                    &mode,
                            const AffineConstraints<double> &constraints,
                            const DiscreteShell             &shell) const
  {
    Vector owned(mode);
    constraints.distribute(owned);
    Vector ghosted = shell.ghosted_vector();
    ghosted        = owned;
    // The largest displacement, the first such one along a positive axis.
    const auto &node_dofs = shell.discretization().node_dofs();
    double      largest   = 0.;
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const CellPart &part : shell.discretization().owned_parts())
      {
        shell.discretization().get_dof_indices(part, dofs);
        for (unsigned int a = 0; a < node_dofs.size() / spacedim; ++a)
          {
            Tensor<1, spacedim> u;
            for (unsigned int c = 0; c < spacedim; ++c)
              u[c] = ghosted(dofs[node_dofs[spacedim * a + c]]);
            largest = std::max(largest, u.norm());
          }
      }
    ghosted /= Utilities::MPI::max(largest, communicator_);
    return ghosted;
  }

  void
  ModeAnalysis::write_fields(const Modes         &modes,
                             const Prestress     &prestress,
                             const DiscreteShell &shell,
                             Recorder            &recorder) const
  {
    const OutputOptions options = mode_files(recorder);
    VtuOutput           output(options.fields);
    for (unsigned int k = 0; k < modes.vectors.size(); ++k)
      {
        const unsigned int number = modes.values.n_below + k + 1;
        const Vector       mode =
          scaled_mode(modes.vectors[k], prestress.constraints(), shell);
        VtuOutput::Entry entry(number, number, "mode" + std::to_string(number));
        // Finite strains of a mode mean nothing: it stands beside the state.
        if (start_)
          entry.mode = &mode;
        output.write({shell.discretization(),
                      problem_.model,
                      start_ ? start_->u : mode},
                     options.folder,
                     options.name,
                     entry);
        write_node_values({shell.discretization(), problem_.model, mode},
                          options.file("_mode" + std::to_string(number) +
                                       ".csv"));
      }
    recorder.add_summary(
      "Modes: " + options.file("_modeNUMBER") +
      (options.fields.format == FieldFormat::hdf5 ? ".h5" : ".vtu"));
  }

  IndexSet
  ModeAnalysis::free_dofs(const DiscreteShell             &shell,
                          const AffineConstraints<double> &constraints)
  {
    IndexSet free = shell.discretization().locally_owned_dofs();
    IndexSet constrained(free.size());
    for (const auto &line : constraints.get_lines())
      constrained.add_index(line.index);
    free.subtract_set(constrained);
    return free;
  }

  void
  ModeAnalysis::check_number(const types::global_dof_index n_free) const
  {
    AssertThrow(problem_.modes.n_modes + 2 <= n_free,
                ExcMessage("Analysis/Number of modes: " +
                           std::to_string(problem_.modes.n_modes) +
                           " are too many for " + std::to_string(n_free) +
                           " unconstrained degrees of freedom; leave 2 more."));
  }

  std::string
  ModeAnalysis::counted_in_words(const Spectrum    &spectrum,
                                 const std::string &quantity,
                                 const double       lower,
                                 const double       upper)
  {
    std::ostringstream text;
    text << std::setprecision(6) << "Sturm's count: " << spectrum.values.size()
         << (spectrum.values.size() == 1 ? " mode" : " modes") << " with "
         << quantity << " from " << lower << " to " << upper
         << ", all of them found";
    if (spectrum.n_missed > 0)
      text << ", " << spectrum.n_missed << " by another search";
    text << '.';
    return text.str();
  }

  std::vector<unsigned int>
  ModeAnalysis::multiplicities(const std::vector<double> &values) const
  {
    const double              tolerance = problem_.modes.multiplicity_tolerance;
    std::vector<unsigned int> result(values.size(), 1);
    for (unsigned int begin = 0, end = 1; begin < values.size(); begin = end++)
      {
        while (end < values.size() &&
               std::abs(values[end] - values[end - 1]) <=
                 tolerance *
                   std::max(std::abs(values[end]), std::abs(values[end - 1])))
          ++end;
        for (unsigned int k = begin; k < end; ++k)
          result[k] = end - begin;
      }
    return result;
  }
} // namespace Nacre
