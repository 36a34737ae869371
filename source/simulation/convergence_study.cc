// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/base/parameter_input.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/reactions.h>
#include <nacre/postprocess/results_table.h>
#include <nacre/postprocess/vtu_output.h>
#include <nacre/simulation/checkpoint.h>
#include <nacre/simulation/convergence_study.h>
#include <nacre/simulation/memory_estimate.h>
#include <nacre/simulation/path_monitor.h>
#include <nacre/simulation/path_start.h>
#include <nacre/simulation/run_warnings.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    std::string
    in_text(const double number, const int n_digits)
    {
      std::ostringstream text;
      text << std::setprecision(n_digits) << number;
      return text.str();
    }

    /** Most cells of a rank over the mean of all ranks. */
    double
    cell_imbalance(const Discretization &discretization)
    {
      const auto &mesh = discretization.triangulation();
      const auto  cells =
        Utilities::MPI::min_max_avg(double(mesh.n_locally_owned_active_cells()),
                                    mesh.get_communicator());
      return cells.max / cells.avg;
    }
  } // namespace

  ConvergenceStudy::Heading::Heading()
    : ParameterAcceptor("/")
  {
    add_parameter("Title", title, "What the file computes; for the tables.");
    add_parameter("Constants",
                  constants,
                  "Named numbers for all expressions: 'R = 25, L = 2*R'. pi, "
                  "and E, nu, h of the section where they are numbers, are "
                  "known as well.");
  }

  ConvergenceStudy::ConvergenceStudy(const MPI_Comm              communicator,
                                     std::unique_ptr<SectionLaw> section)
    : ParameterAcceptor("/Study")
    , communicator_(communicator)
    , problem_(communicator, std::move(section))
  {
    add_parameter("Name",
                  name_,
                  "Name of the output files; by default that of the .prm.");
    add_parameter("Output folder",
                  output_folder_,
                  "Made if it doesn't exist; a relative path starts from the "
                  "current folder.");
    add_parameter("Degrees",
                  degrees_,
                  "Degrees p of the element, from 2 to 5. Units: none.",
                  prm,
                  Patterns::List(Patterns::Integer(2, 5), 1));
    add_parameter("Penalties",
                  penalties_,
                  "Values of eta, the penalty (15); 'default': twice the bound "
                  "of each cell. Units: none.");
    add_parameter("Thicknesses",
                  thicknesses_,
                  "Thicknesses, expressions of constants; none: "
                  "'Section/Thickness'. Units: length.");
    add_parameter("Refinements",
                  refinements_,
                  "Global refinements of the coarse mesh; each quarters the "
                  "cells. Units: none.",
                  prm,
                  Patterns::List(Patterns::Integer(0, 12), 1));
    add_parameter("Write VTU",
                  write_vtu_,
                  "Write the fields of every case for ParaView.");
    add_parameter("Output format",
                  field_format_,
                  "Files of the fields. vtu: higher-order cells, a .pvd lists "
                  "all times; hdf5: linear cells, one file for any number of "
                  "ranks, an .xdmf lists all times.",
                  prm,
                  Patterns::Selection("vtu|hdf5"));
    add_parameter("Ranks per VTU file",
                  ranks_per_file_,
                  "The cells of so many ranks share a .vtu; if it takes more "
                  "than one, a .pvtu lists them. Units: none.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Output subdivisions",
                  n_subdivisions_,
                  "Parts of each edge of quadrilaterals in the fields: points "
                  "(vtu) or linear cells (hdf5), up to 10; 0: the degree p. "
                  "Units: none.",
                  prm,
                  Patterns::Integer(0, 10));
    add_parameter("Report seconds",
                  report_seconds_,
                  "Whether the terminal shows CPU seconds; without them the "
                  "output is the same from run to run. The .csv has them.");
  }

  void
  ConvergenceStudy::check_lists() const
  {
    AssertThrow(!penalties_.empty(),
                ExcMessage("Study/Penalties: give 'default' or a number."));
    AssertThrow(!name_.empty() && name_.find('/') == std::string::npos,
                ExcMessage("Study/Name: '" + name_ +
                           "' is no file name; use 'Output folder' for the "
                           "folder."));
  }

  std::vector<ShellCase>
  ConvergenceStudy::make_cases() const
  {
    const auto constants = parse_constants(heading_.constants, "Constants");

    std::vector<std::optional<double>> thicknesses, penalties;
    for (const auto &text : thicknesses_)
      {
        thicknesses.emplace_back(
          evaluate_number(text, "Study/Thicknesses", constants));
        AssertThrow(*thicknesses.back() > 0.,
                    ExcMessage("Study/Thicknesses: '" + text +
                               "' is not positive."));
      }
    if (thicknesses.empty())
      thicknesses.emplace_back();
    for (const auto &text : penalties_)
      if (text == "default")
        penalties.emplace_back();
      else
        {
          penalties.emplace_back(
            evaluate_number(text,
                            "Study/Penalties, 'default' or a number",
                            constants));
          AssertThrow(*penalties.back() > 0.,
                      ExcMessage("Study/Penalties: eta = '" + text +
                                 "' is not positive."));
        }

    std::vector<ShellCase> cases;
    for (const auto &thickness : thicknesses)
      for (const auto &eta : penalties)
        for (const auto degree : degrees_)
          for (const auto n_refinements : refinements_)
            cases.push_back({degree, n_refinements, eta, thickness});
    return cases;
  }

  void
  ConvergenceStudy::prepare(const std::string &prm_file)
  {
    if (name_.empty())
      {
        std::filesystem::path path = std::filesystem::path(prm_file).stem();
        if (path.extension() == ".used")
          path = path.stem();
        name_ = path.string();
      }
    check_lists();
    problem_.set_folder(std::filesystem::path(prm_file).parent_path().string());
    for (const auto &shell_case : make_cases())
      prepare_case(shell_case);
  }

  void
  ConvergenceStudy::prepare_case(const ShellCase &shell_case)
  {
    problem_.prepare(parse_constants(heading_.constants, "Constants"),
                     shell_case);
    quantities_.prepare(problem_.midsurface(),
                        problem_.exact_solution(),
                        problem_.constants());
    adaptive_.prepare(problem_, quantities_);
    problem_.set_goal(adaptive_.goal());
  }

  std::vector<std::string>
  ConvergenceStudy::notes() const
  {
    return problem_.midsurface().notes();
  }

  std::string
  ConvergenceStudy::base_name() const
  {
    return (std::filesystem::path(output_folder_) / name_).string();
  }

  void
  ConvergenceStudy::prepare_output(const bool keeps_results) const
  {
    run_on_root(communicator_, [&]() {
      create_folder(output_folder_);
      // A run that fails must not leave an older one's results.
      std::error_code not_there;
      if (!keeps_results)
        for (const auto *const ending :
             {".csv", ".txt", ".tex", ".pvd", ".xdmf"})
          std::filesystem::remove(base_name() + ending, not_there);
      write_used_parameters(base_name() + ".used.prm");
    });
  }

  void
  ConvergenceStudy::check_restart(const bool        restart,
                                  const std::size_t n_cases) const
  {
    AssertThrow(!restart || (n_cases == 1 && !problem_.is_linear()),
                ExcMessage("--restart: only a study of one case with an "
                           "'Analysis/Type' other than linear can go on; this "
                           "one has " +
                           std::to_string(n_cases) + "."));
  }

  void
  ConvergenceStudy::set_up_case(Log &log)
  {
    problem_.set_up(log);
    for (const auto &quantity : quantities_.quantities())
      if (quantity.goal.load)
        quantity.goal.load(problem_.discretization());
  }

  void
  ConvergenceStudy::check(Log &log, const bool restart)
  {
    const auto cases = make_cases();
    check_restart(restart, cases.size());
    for (const auto &shell_case : cases)
      {
        prepare_case(shell_case);
        set_up_case(log);
        problem_.check_integrands();
        if (problem_.is_linear())
          continue;
        const std::string base    = path_base(path_name(cases, shell_case));
        const auto        problem = current_problem(communicator_);
        Checkpoint        checkpoint(problem_.discretization(), base);
        load_state(problem, base, restart, checkpoint, log);
      }
  }

  std::string
  ConvergenceStudy::label(const ShellCase &shell_case) const
  {
    std::string text = "p" + std::to_string(shell_case.degree) + "_r" +
                       std::to_string(shell_case.n_refinements);
    if (thicknesses_.size() > 1)
      text += "_h" + in_text(*shell_case.thickness, 6);
    if (penalties_.size() > 1)
      text +=
        "_eta" + (shell_case.eta ? in_text(*shell_case.eta, 4) : "default");
    return text;
  }

  std::string
  ConvergenceStudy::path_name(const std::vector<ShellCase> &cases,
                              const ShellCase              &shell_case) const
  {
    return cases.size() == 1 ? name_ : name_ + "_" + label(shell_case);
  }

  std::string
  ConvergenceStudy::path_base(const std::string &name) const
  {
    return (std::filesystem::path(output_folder_) / name).string();
  }

  ResultsTable::Row
  ConvergenceStudy::make_row(const ShellCase &shell_case) const
  {
    const SolvedShell &shell = problem_.solution();
    ResultsTable::Row  row;
    row.element = problem_.element_name();
    row.degree  = shell_case.degree;
    row.cells   = shell.discretization.triangulation().n_global_active_cells();
    row.dofs    = shell.discretization.dof_handler().n_dofs();
    row.eta     = shell_case.eta ? in_text(*shell_case.eta, 4) : "default";
    const auto thickness = problem_.constants().find("h");
    row.thickness        = thickness == problem_.constants().end() ?
                             "varies" :
                             in_text(thickness->second, 6);
    row.setup_s          = problem_.times().setup;
    row.assembly_s       = problem_.times().assembly;
    row.solve_s          = problem_.times().solve;
    row.solver           = problem_.solver_record().name;
    row.iterations       = problem_.solver_record().n_iterations;
    row.memory_gb        = peak_memory(communicator_);
    for (const auto &quantity : quantities_.quantities())
      {
        row.values.push_back(quantity.evaluate(shell));
        AssertThrow(std::isfinite(row.values.back()),
                    ExcMessage("The quantity '" + quantity.name +
                               "' is not a finite number. Are the loads "
                               "or the section's values extreme?"));
        row.references.push_back(quantity.reference);
      }
    return row;
  }

  void
  ConvergenceStudy::add_balance()
  {
    const auto &origin = quantities_.balance_origin();
    if (!origin)
      return;
    const SolvedShell &shell = problem_.solution();
    std::ostringstream text;
    text << '\n'
         << problem_.element_name() << ", p " << shell.discretization.degree()
         << ", " << shell.discretization.dof_handler().n_dofs() << " dofs: ";
    write_balance(Balance(shell, *origin), *origin, text);
    balances_ += text.str();
  }

  std::string
  ConvergenceStudy::progress_line(const ResultsTable::Row &row) const
  {
    std::ostringstream line;
    line << "p " << row.degree << ", h " << row.thickness << ", eta "
         << in_text(problem_.eta(), 4) << ", " << row.cells << " cells, "
         << row.dofs << " dofs";
    if (report_seconds_)
      line << ", " << std::fixed << std::setprecision(2)
           << row.setup_s + row.assembly_s + row.solve_s << " s";
    if (row.iterations > 0)
      line << ", " << row.solver << ", " << row.iterations << " iterations";
    const double imbalance = cell_imbalance(problem_.discretization());
    if (adaptive_.is_on() && Utilities::MPI::n_mpi_processes(communicator_) > 1)
      line << ", cells of a rank max/mean " << std::fixed
           << std::setprecision(3) << imbalance;
    if (!row.values.empty())
      line << ", " << quantities_.quantities().front().name << " = "
           << std::scientific << std::setprecision(6) << row.values.front();
    return line.str();
  }

  VtuOutput::Options
  ConvergenceStudy::field_options() const
  {
    return {field_format_ == "hdf5" ? FieldFormat::hdf5 : FieldFormat::vtu,
            ranks_per_file_,
            n_subdivisions_};
  }

  std::optional<CheckpointData>
  ConvergenceStudy::load_state(const ProblemRecord &problem,
                               const std::string   &base,
                               const bool           restart,
                               Checkpoint          &checkpoint,
                               Log                 &log) const
  {
    const auto &path = problem_.path_parameters();
    warn_of_load_factor(path, problem, log);
    if (restart)
      return load_restart(path, problem, checkpoint, log);
    if (!path.start_from.empty())
      return load_start(path, problem, problem_.discretization(), base, log);
    return {};
  }

  std::string
  ConvergenceStudy::follow_path(const std::string &name,
                                const bool         restart,
                                Log               &log)
  {
    const auto         &path    = problem_.path_parameters();
    const ProblemRecord problem = current_problem(communicator_);
    const std::string   base    = path_base(name);
    Checkpoint          checkpoint(problem_.discretization(), base);
    PathMonitor         monitor(communicator_,
                        {output_folder_,
                                 name,
                                 field_options(),
                                 write_vtu_,
                                 report_seconds_,
                                 path.vtu_steps,
                                 path.checkpoint_steps,
                                 path.time_grid()},
                        quantities_,
                        checkpoint,
                        log);
    const auto data = load_state(problem, base, restart, checkpoint, log);
    PathState  state;
    if (restart)
      {
        // A restart that is refused leaves all files as they were.
        prepare_output(true);
        monitor.resume(*data, problem);
        state = data->state;
      }
    else
      {
        state = problem_.start_path(data ? &data->state.motion : nullptr);
        run_on_root(communicator_, [&]() { checkpoint.remove(); });
        monitor.start(problem);
      }

    const std::string failure = problem_.follow_path(
      state,
      [&](const PathState &step, const SolvedShell &solved) {
        monitor.observe(step, solved);
      },
      log);
    monitor.finish(state, problem_.solution());
    AssertThrow(failure.empty(), ExcMessage(failure));
    return monitor.summary();
  }

  void
  ConvergenceStudy::solve_cycles(const ShellCase   &shell_case,
                                 const std::string &progress,
                                 ResultsTable      &table,
                                 VtuOutput         &vtu_output,
                                 Log               &log)
  {
    for (unsigned int cycle = 0; cycle <= adaptive_.n_cycles(); ++cycle)
      {
        set_up_case(log);
        problem_.solve(log);
        auto          row = make_row(shell_case);
        ErrorEstimate estimate;
        if (adaptive_.is_on())
          {
            estimate = adaptive_.estimate(problem_);
            adaptive_.add_to_row(problem_, estimate, row);
          }
        const std::string line = progress_line(row);
        log.progress() << progress
                       << (adaptive_.is_on() ?
                             "cycle " + std::to_string(cycle) + ", " :
                             "")
                       << line << std::endl;
        const unsigned int counter = table.rows().size();
        table.add_row(row);
        add_balance();
        run_on_root(communicator_, [&]() { table.write_files(base_name()); });

        const SolvedShell &shell = problem_.solution();
        const std::string  name =
          label(shell_case) +
          (adaptive_.is_on() ? "_c" + std::to_string(cycle) : "");
        if (write_vtu_)
          vtu_output.write(shell.discretization,
                           shell.section,
                           shell.kinematics,
                           shell.displacement,
                           output_folder_,
                           name_,
                           {counter, double(counter), name},
                           estimate.indicators);
        if (cycle == adaptive_.n_cycles())
          return;
        const auto marked = adaptive_.mark(estimate, shell.discretization);
        if (!marked)
          return;
        problem_.refine(*marked);
      }
  }

  void
  ConvergenceStudy::run(Log &log, const bool restart)
  {
    const auto cases = make_cases();
    check_restart(restart, cases.size());
    if (!restart)
      prepare_output(false);
    std::vector<ResultsTable::Quantity> columns;
    for (const auto &quantity : quantities_.quantities())
      columns.push_back({quantity.name,
                         quantity.reference,
                         quantity.is_error || quantity.reference.has_value()});
    for (const auto &column : adaptive_.columns(problem_.exact_solution()))
      columns.push_back(column);
    ResultsTable table(heading_.title, columns);
    VtuOutput    vtu_output(field_options());
    std::string  paths;
    const auto   n_warnings = log.n_warnings();

    balances_.clear();
    for (unsigned int k = 0; k < cases.size(); ++k)
      {
        prepare_case(cases[k]);
        const std::string progress = '[' + std::to_string(k + 1) + '/' +
                                     std::to_string(cases.size()) + "] ";
        if (problem_.is_linear())
          {
            solve_cycles(cases[k], progress, table, vtu_output, log);
            continue;
          }
        set_up_case(log);
        paths += follow_path(path_name(cases, cases[k]), restart, log) + '\n';
        table.add_row(make_row(cases[k]));
        add_balance();
        log.progress() << progress << progress_line(table.rows().back())
                       << std::endl;
        run_on_root(communicator_, [&]() { table.write_files(base_name()); });
      }
    print_results(table, paths, log.n_warnings() - n_warnings, log);
  }

  void
  ConvergenceStudy::print_results(const ResultsTable &table,
                                  const std::string  &paths,
                                  const unsigned int  n_warnings,
                                  Log                &log) const
  {
    const bool         has_fields = write_vtu_ && problem_.is_linear();
    const auto        &rows       = table.rows();
    std::ostringstream text;
    table.write_text(text, report_seconds_);
    text << balances_ << "\nResults: " << base_name() << ".csv (.txt, .tex"
         << (!has_fields             ? ")" :
             field_format_ == "hdf5" ? ", .xdmf)" :
                                       ", .pvd)")
         << '\n';
    if (has_fields)
      text << "Fields: " << base_name() << "_pP_rR"
           << (thicknesses_.size() > 1 ? "_hH" : "")
           << (penalties_.size() > 1 ? "_etaETA" : "")
           << (adaptive_.is_on() ? "_cCYCLE" : "")
           << (field_format_ == "hdf5" ? ".h5" : ".vtu") << ", " << rows.size()
           << (rows.size() == 1 ? " solution" : " solutions") << '\n';
    text << paths << "Solved: " << rows.size()
         << (problem_.is_linear() ? " linear system" : " path")
         << (rows.size() == 1 ? " of " : "s of up to ")
         << std::max_element(rows.begin(),
                             rows.end(),
                             [](const auto &a, const auto &b) {
                               return a.dofs < b.dofs;
                             })
              ->dofs
         << " dofs";
    text << ", " << n_warnings << (n_warnings == 1 ? " warning" : " warnings");
    if (!heading_.title.empty())
      log.results() << '\n' << heading_.title << std::endl;
    log.results() << text.str() << std::endl;
  }
} // namespace Nacre
