// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/base/parameter_input.h>
#include <nacre/discretization/discretization.h>
#include <nacre/postprocess/reactions.h>
#include <nacre/simulation/memory_estimate.h>
#include <nacre/simulation/recorder.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
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

  std::string
  in_text(const double number, const int n_digits)
  {
    std::ostringstream text;
    text << std::setprecision(n_digits) << number;
    return text.str();
  }

  Recorder::Recorder(const MPI_Comm              communicator,
                     const OutputOptions        &options,
                     const std::string          &title,
                     const Columns              &columns,
                     const QuantitiesOfInterest &quantities,
                     Log                        &log)
    : communicator_(communicator)
    , options_(options)
    , title_(title)
    , table_(title, columns)
    , quantities_(quantities)
    , log_(log)
    , n_warnings_before_(log.n_warnings())
    , vtu_output_(options.fields)
  {}

  void
  Recorder::start_files(const bool keeps_results) const
  {
    run_on_root(communicator_, [&]() {
      create_folder(options_.folder);
      // A run that fails must not leave an older one's results.
      std::error_code not_there;
      if (!keeps_results)
        for (const auto *const ending :
             {".csv", ".txt", ".tex", ".pvd", "_thick.pvd", ".xdmf"})
          std::filesystem::remove(options_.file(ending), not_there);
      write_used_parameters(options_.file(".used.prm"));
    });
  }

  void
  Recorder::begin_case(const ShellProblem &problem, const CaseNames &names)
  {
    problem_ = &problem;
    names_   = names;
  }

  void
  Recorder::check_quantities(const Discretization &mesh) const
  {
    for (const auto &quantity : quantities_.quantities())
      {
        if (quantity.point)
          mesh.locate(*quantity.point,
                      "Quantities/Quantities, '" + quantity.name + "'");
        if (quantity.check)
          quantity.check(mesh);
      }
  }

  ResultsTable::Row
  Recorder::make_row(const SolvedShell &shell, const SolveRecord &record) const
  {
    const auto       &model = problem_->model;
    ResultsTable::Row row;
    row.element = name_of(model.element.type);
    row.degree  = model.element.degree;
    row.cells   = shell.discretization.triangulation().n_global_active_cells();
    row.dofs    = shell.discretization.n_dofs();
    row.eta     = model.eta ? in_text(*model.eta, 4) : "default";
    const auto thickness = problem_->constants.find("h");
    row.thickness        = thickness == problem_->constants.end() ?
                             "varies" :
                             in_text(thickness->second, 6);
    row.setup_s          = record.setup;
    row.assembly_s       = record.assembly;
    row.solve_s          = record.solve;
    row.solver           = record.solver;
    row.iterations       = record.n_iterations;
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
  Recorder::add(const ResultsTable::Row &row,
                const SolvedShell       &shell,
                const SolveRecord       &record,
                const std::string       &note,
                const bool               shows_imbalance)
  {
    const std::string line = progress_line(row, shell, record, shows_imbalance);
    log_.progress() << names_.progress << note << line << std::endl;
    table_.add_row(row);
    add_balance(shell);
    run_on_root(communicator_,
                [&]() { table_.write_files(options_.file("")); });
  }

  void
  Recorder::write_fields(const SolvedShell         &shell,
                         const std::string         &ending,
                         const std::vector<double> &indicators)
  {
    if (!options_.write_vtu)
      return;
    const unsigned int counter = table_.rows().size() - 1;
    vtu_output_.write(shell,
                      options_.folder,
                      options_.name,
                      {counter, double(counter), names_.label + ending},
                      indicators);
    has_fields_ = true;
  }

  void
  Recorder::add_balance(const SolvedShell &shell)
  {
    const auto &origin = quantities_.balance_origin();
    if (!origin)
      return;
    std::ostringstream text;
    text << '\n'
         << name_of(problem_->model.element.type) << ", p "
         << shell.discretization.degree() << ", "
         << shell.discretization.n_dofs() << " dofs: ";
    write_balance(Balance(shell, *origin), *origin, text);
    balances_ += text.str();
  }

  std::string
  Recorder::progress_line(const ResultsTable::Row &row,
                          const SolvedShell       &shell,
                          const SolveRecord       &record,
                          const bool               shows_imbalance) const
  {
    std::ostringstream line;
    line << "p " << row.degree << ", h " << row.thickness << ", eta "
         << in_text(record.eta, 4) << ", " << row.cells << " cells, "
         << row.dofs << " dofs";
    if (options_.report_seconds)
      line << ", " << std::fixed << std::setprecision(2)
           << row.setup_s + row.assembly_s + row.solve_s << " s";
    if (row.iterations > 0)
      line << ", " << row.solver << ", " << row.iterations << " iterations";
    if (shows_imbalance && Utilities::MPI::n_mpi_processes(communicator_) > 1)
      line << ", cells of a rank max/mean " << std::fixed
           << std::setprecision(3) << cell_imbalance(shell.discretization);
    if (!row.values.empty())
      line << ", " << quantities_.quantities().front().name << " = "
           << std::scientific << std::setprecision(6) << row.values.front();
    return line.str();
  }

  void
  Recorder::print_results(const std::string &what,
                          const std::string &pattern) const
  {
    const bool         is_hdf5    = options_.fields.format == FieldFormat::hdf5;
    const auto         n_warnings = log_.n_warnings() - n_warnings_before_;
    const auto        &rows       = table_.rows();
    std::ostringstream text;
    table_.write_text(text, options_.report_seconds);
    text << balances_ << "\nResults: " << options_.file(".csv (.txt, .tex")
         << (!has_fields_ ? ")" :
             is_hdf5      ? ", .xdmf)" :
                            ", .pvd)")
         << '\n';
    if (has_fields_)
      text << "Fields: " << options_.file(pattern) << (is_hdf5 ? ".h5" : ".vtu")
           << ", " << rows.size()
           << (rows.size() == 1 ? " solution" : " solutions") << '\n';
    text << summaries_ << "Solved: " << rows.size() << ' ' << what
         << (rows.size() == 1 ? " of " : "s of up to ")
         << std::max_element(rows.begin(),
                             rows.end(),
                             [](const auto &a, const auto &b) {
                               return a.dofs < b.dofs;
                             })
              ->dofs
         << " dofs";
    text << ", " << n_warnings << (n_warnings == 1 ? " warning" : " warnings");
    if (!title_.empty())
      log_.results() << '\n' << title_ << std::endl;
    log_.results() << text.str() << std::endl;
  }
} // namespace Nacre
