// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/forms/assembly.h>
#include <nacre/simulation/path_monitor.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  PathMonitor::PathMonitor(const MPI_Comm              communicator,
                           const OutputOptions        &options,
                           const PathParameters       &path,
                           const QuantitiesOfInterest &quantities,
                           Checkpoint                 &checkpoint,
                           const bool                  saves,
                           Log                        &log)
    : communicator_(communicator)
    , options_(options)
    , path_(path)
    , grid_(path.time_grid())
    , quantities_(quantities)
    , checkpoint_(checkpoint)
    , checkpoint_steps_(saves ? path.checkpoint_steps : 0)
    , log_(log)
    , vtu_output_(options.fields)
  {}

  std::string
  PathMonitor::csv_header() const
  {
    std::string header =
      "step,time,load_factor,iterations,residual,negative_pivots";
    for (const auto &quantity : quantities_.quantities())
      header += ',' + quantity.name;
    return header;
  }

  void
  PathMonitor::start(const ProblemRecord &problem)
  {
    written_         = CheckpointData();
    written_.problem = problem;
    run_on_root(communicator_, [&]() {
      std::filesystem::remove(options_.file("_points.csv"));
    });
  }

  namespace
  {
    /**
     * The header of a table of steps and its rows up to @p last_step: those
     * after a checkpoint will be written again.
     */
    std::pair<std::string, std::string>
    read_rows(const std::string &csv, const unsigned int last_step)
    {
      std::ifstream      in(csv);
      std::string        header, line;
      std::ostringstream rows;
      std::getline(in, header);
      while (std::getline(in, line))
        if (std::strtoul(line.c_str(), nullptr, 10) <= last_step)
          rows << line << '\n';
      return {header, rows.str()};
    }
  } // namespace

  void
  PathMonitor::resume(const CheckpointData &data, const ProblemRecord &problem)
  {
    written_         = data;
    written_.problem = problem;
    start_step_      = data.state.step;
    // Another format has a list of its own.
    if (has_changed("Study/Output format", data.problem, problem))
      written_.written_fields.clear();
    vtu_output_.resume(options_.folder, options_.name, written_.written_fields);
    const bool same_quantities =
      !has_changed("Quantities/Quantities", data.problem, problem);
    run_on_root(communicator_, [&]() {
      const auto [header, kept] =
        read_rows(options_.file("_path.csv"), data.state.step);
      const bool goes_on = same_quantities && header == csv_header();
      if (!goes_on && !kept.empty())
        {
          earlier_rows_ = options_.file(
            "_path_until_" + std::to_string(data.state.step) + ".csv");
          write_file(earlier_rows_, [&](std::ostream &out) {
            out << header << '\n' << kept;
          });
        }
      write_file(options_.file("_path.csv"), [&](std::ostream &out) {
        out << csv_header() << '\n' << (goes_on ? kept : "");
      });
      const std::string points = options_.file("_points.csv");
      if (std::filesystem::exists(points))
        {
          const auto table = read_rows(points, data.state.step);
          write_file(points, [&](std::ostream &out) {
            out << table.first << '\n' << table.second;
          });
        }
    });
    if (!earlier_rows_.empty())
      log_.progress() << "other quantities than before: the rows up to step "
                      << data.state.step << " are now in " << earlier_rows_
                      << std::endl;
  }

  void
  PathMonitor::observe(const PathState &state, const SolvedShell &shell)
  {
    std::vector<double> values;
    for (const auto &quantity : quantities_.quantities())
      {
        values.push_back(quantity.evaluate(shell));
        AssertThrow(std::isfinite(values.back()),
                    ExcMessage("The quantity '" + quantity.name +
                               "' is not a finite number in step " +
                               std::to_string(state.step) + "."));
      }
    write_row(state, values);
    print_line(state, values);
    written_.state = state;
    has_saved_     = false;
    const bool is_due =
      (path_.vtu_steps > 0 && state.step % path_.vtu_steps == 0) ||
      grid_.is_listed(state.time);
    if (options_.write_vtu && is_due)
      write_fields(state, shell);
    if (checkpoint_steps_ > 0 && state.step % checkpoint_steps_ == 0)
      save(state);
  }

  void
  PathMonitor::finish(const PathState &state, const SolvedShell &shell)
  {
    if (options_.write_vtu && written_.written_fields.count(state.step) == 0)
      write_fields(state, shell);
    if (checkpoint_steps_ > 0 && !has_saved_)
      save(state);
  }

  void
  PathMonitor::observe_point(const PathPoint &point, const SolvedShell &shell)
  {
    const PathState   &state = point.state;
    std::ostringstream header, row, line;
    header << "step,kind,time,load_factor,pivots_before,pivots_after";
    row << std::setprecision(12) << state.step << ',' << point.kind << ','
        << state.time << ',' << state.load_factor << ',' << point.n_before
        << ',' << point.n_after;
    line << point.kind << " point before step " << state.step << ": t "
         << std::setprecision(8) << state.time << ", load factor "
         << state.load_factor << ", negative pivots " << point.n_before
         << " -> " << point.n_after << std::setprecision(6);
    for (const auto &quantity : quantities_.quantities())
      {
        const double value = quantity.evaluate(shell);
        header << ',' << quantity.name;
        row << ',' << value;
        line << ", " << quantity.name << " = " << value;
      }
    log_.progress() << line.str() << std::endl;
    run_on_root(communicator_, [&]() {
      const std::string csv = options_.file("_points.csv");
      if (!std::ifstream(csv))
        write_file(csv,
                   [&](std::ostream &out) { out << header.str() << '\n'; });
      std::ofstream out(csv, std::ios::app);
      out << row.str() << '\n' << std::flush;
      AssertThrow(out,
                  ExcMessage("Writing '" + csv +
                             "' failed: is the disk full?"));
    });
  }

  void
  PathMonitor::write_fields(const PathState &state, const SolvedShell &shell)
  {
    vtu_output_.write(shell,
                      options_.folder,
                      options_.name,
                      {state.step, state.time, std::to_string(state.step)});
    written_.written_fields =
      vtu_output_.records(options_.folder, options_.name);
  }

  void
  PathMonitor::save(const PathState &state)
  {
    written_.state = state;
    checkpoint_.save(written_);
    has_saved_ = true;
  }

  void
  PathMonitor::write_row(const PathState           &state,
                         const std::vector<double> &values)
  {
    run_on_root(communicator_, [&]() {
      const std::string  csv = options_.file("_path.csv");
      std::ostringstream text;
      if (state.step == 0)
        text << csv_header() << '\n';
      text << std::setprecision(12) << state.step << ',' << state.time << ','
           << state.load_factor << ',' << state.iterations << ','
           << state.residual << ',' << state.n_negative_pivots;
      for (const double value : values)
        text << ',' << value;
      text << '\n';
      if (state.step == 0)
        {
          write_file(csv, [&](std::ostream &out) { out << text.str(); });
          return;
        }
      std::ofstream out(csv, std::ios::app);
      out << text.str() << std::flush;
      AssertThrow(out,
                  ExcMessage("Writing '" + csv +
                             "' failed: is the disk full?"));
    });
  }

  namespace
  {
    /** Energies now, what came in and went out, and what can't be. */
    void
    print_balance(const EnergyBalance &balance, std::ostream &line)
    {
      line << std::setprecision(3) << ", energy: kinetic " << balance.kinetic
           << ", strain " << balance.strain << ", work "
           << balance.external_work + balance.prescribed_work << ", damped "
           << balance.dissipation << ", gain " << std::setprecision(1)
           << balance.relative_gain();
    }
  } // namespace

  void
  PathMonitor::print_line(const PathState           &state,
                          const std::vector<double> &values)
  {
    std::ostringstream line;
    line << "step " << state.step << ", t " << std::setprecision(6)
         << state.time << ", load factor " << state.load_factor << ", "
         << state.iterations << " iterations, residual " << std::scientific
         << std::setprecision(1) << state.residual;
    if (state.n_negative_pivots > 0)
      line << ", unstable (" << state.n_negative_pivots << " negative pivot"
           << (state.n_negative_pivots > 1 ? "s)" : ")");
    if (state.balance.is_kept)
      print_balance(state.balance, line);
    line << std::setprecision(6);
    for (unsigned int k = 0; k < values.size(); ++k)
      line << ", " << quantities_.quantities()[k].name << " = " << values[k];
    const unsigned int n_done = state.step - start_step_;
    // An arc-length path doesn't know how far it has to go.
    if (options_.report_seconds && n_done > 0 &&
        path_.type != AnalysisType::arc_length)
      line << std::fixed << std::setprecision(0) << ", "
           << timer_.wall_time() / n_done *
                grid_.n_steps_left(state.time, state.next_step)
           << " s left";
    log_.progress() << line.str() << std::endl;
  }

  std::string
  PathMonitor::summary() const
  {
    std::ostringstream text;
    text << "Path: " << written_.state.step
         << " steps to t = " << written_.state.time << ": "
         << options_.file("_path.csv");
    const auto n_fields = written_.written_fields.size();
    if (n_fields > 0)
      text << "; fields of " << n_fields
           << (n_fields == 1 ? " step: " : " steps: ")
           << options_.file(
                options_.fields.format == FieldFormat::hdf5 ? ".xdmf" : ".pvd");
    if (has_saved_)
      text << "; " << options_.file(".checkpoint");
    return text.str();
  }
} // namespace Nacre
