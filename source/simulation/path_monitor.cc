// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/forms/assembly.h>
#include <nacre/simulation/path_monitor.h>
#include <nacre/simulation/table_file.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  PathMonitor::PathMonitor(const MPI_Comm              communicator,
                           const OutputOptions        &options,
                           const std::string          &points_csv,
                           const int                   branch,
                           const PathParameters       &path,
                           const QuantitiesOfInterest &quantities,
                           Checkpoint                 &checkpoint,
                           const Completion           &completion,
                           Log                        &log)
    : communicator_(communicator)
    , options_(options)
    , points_csv_(points_csv)
    , branch_(branch)
    , path_(path)
    , grid_(path.time_grid())
    , quantities_(quantities)
    , checkpoint_(checkpoint)
    , completion_(completion)
    , checkpoint_steps_(path.checkpoint_steps)
    , log_(log)
    , vtu_output_(options.fields)
    , point_output_(options.fields)
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
  }

  std::string
  PathMonitor::point_file(const OutputOptions &options,
                          const unsigned int   number)
  {
    return options.file("_point" + std::to_string(number));
  }

  void
  PathMonitor::resume_points(const PathState &state)
  {
    FieldRecords records;
    run_on_root(communicator_, [&]() {
      if (!std::filesystem::exists(points_csv_))
        return;
      // Points after the checkpoint will be found again.
      const auto keeps = [&](const std::string &line) {
        const auto cells  = Text::split(line, ',', points_csv_);
        const bool is_own = !path_.branches.has_several() ||
                            cells.at(0) == std::to_string(branch_);
        const auto number = std::stoul(cells.at(1));
        if (is_own && number > state.n_points)
          return false;
        for (const auto *const ending : {".vtu", ".pvtu", ".h5"})
          if (const std::filesystem::path file =
                point_file(options_, number) + ending;
              is_own && std::filesystem::exists(file))
            records[number] = {std::stod(cells.at(4)),
                               file.filename().string()};
        return true;
      };
      TableFile::read(points_csv_, keeps).write(points_csv_);
    });
    // A list of .h5 holds more than their names: it begins anew.
    if (options_.fields.format == FieldFormat::vtu)
      point_output_.resume(options_.folder, options_.name + "_points", records);
  }

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
      // Steps after the checkpoint will be taken again.
      const std::string csv = options_.file("_path.csv");
      TableFile table = TableFile::read(csv, [&](const std::string &line) {
        return std::strtoul(line.c_str(), nullptr, 10) <= data.state.step;
      });
      if (!same_quantities || table.header != csv_header())
        {
          if (!table.rows.empty())
            {
              earlier_rows_ = options_.file(
                "_path_until_" + std::to_string(data.state.step) + ".csv");
              table.write(earlier_rows_);
            }
          table = {csv_header(), {}};
        }
      table.write(csv);
    });
    resume_points(data.state);
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
    last_time_     = state.time;
    written_.state = state;
    has_saved_     = false;
    const bool is_due =
      (path_.vtu_steps > 0 && state.step % path_.vtu_steps == 0) ||
      grid_.is_listed(state.time);
    if (options_.write_vtu && is_due)
      write_fields(state, shell);
    if (checkpoint_steps_ > 0 && state.step % checkpoint_steps_ == 0)
      save(state, shell);
  }

  void
  PathMonitor::finish(const PathState &state, const SolvedShell &shell)
  {
    if (options_.write_vtu && written_.written_fields.count(state.step) == 0)
      write_fields(state, shell);
    if (checkpoint_steps_ > 0 && !has_saved_)
      save(state, shell);
  }

  void
  PathMonitor::observe_point(const PathPoint                     &point,
                             const SolvedShell                   &shell,
                             const TrilinosWrappers::MPI::Vector &mode)
  {
    write_point(point, shell);
    const unsigned int number = point.state.n_points;
    if (options_.write_vtu)
      {
        VtuOutput::Entry entry(number,
                               point.state.time,
                               "point" + std::to_string(number));
        entry.list = "_points";
        entry.mode = &mode;
        point_output_.write(shell, options_.folder, options_.name, entry);
      }
    if (checkpoint_steps_ == 0)
      return;
    CheckpointData data;
    data.problem = written_.problem;
    data.state   = point.state;
    completion_(data);
    Checkpoint(communicator_, point_file(options_, number))
      .save(shell.discretization, data);
  }

  void
  PathMonitor::write_point(const PathPoint &point, const SolvedShell &shell)
  {
    const PathState   &state = point.state;
    std::ostringstream header, row, line;
    header << "branch,point,step,kind,time,load_factor,pivots_before,"
              "pivots_after";
    row << std::setprecision(12) << state.branch << ',' << state.n_points << ','
        << state.step << ',' << point.kind << ',' << state.time << ','
        << state.load_factor << ',' << point.n_before << ',' << point.n_after;
    line << "point " << state.n_points << ", " << point.kind << ", before step "
         << state.step << ": t " << std::setprecision(8) << state.time
         << ", load factor " << state.load_factor << ", negative pivots "
         << point.n_before << " -> " << point.n_after << std::setprecision(6);
    for (const auto &quantity : quantities_.quantities())
      {
        const double value = quantity.evaluate(shell);
        header << ',' << quantity.name;
        row << ',' << value;
        line << ", " << quantity.name << " = " << value;
      }
    log_.progress() << line.str() << std::endl;
    run_on_root(communicator_, [&]() {
      if (!std::filesystem::exists(points_csv_))
        TableFile{header.str(), {}}.write(points_csv_);
      TableFile::append(row.str(), points_csv_);
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
  PathMonitor::save(const PathState &state, const SolvedShell &shell)
  {
    written_.state = state;
    written_.section_states =
      shell.section_states->records(shell.discretization);
    completion_(written_);
    checkpoint_.save(shell.discretization, written_);
    has_saved_ = true;
  }

  void
  PathMonitor::write_row(const PathState           &state,
                         const std::vector<double> &values)
  {
    run_on_root(communicator_, [&]() {
      const std::string  csv = options_.file("_path.csv");
      std::ostringstream text;
      text << std::setprecision(12) << state.step << ',' << state.time << ','
           << state.load_factor << ',' << state.iterations << ','
           << state.residual << ',' << state.n_negative_pivots;
      for (const double value : values)
        text << ',' << value;
      if (state.step == 0)
        TableFile{csv_header(), {text.str()}}.write(csv);
      else
        TableFile::append(text.str(), csv);
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
           << balance.dissipation;
      if (balance.released != 0.)
        line << ", released " << balance.released;
      line << ", gain " << std::setprecision(1) << balance.relative_gain();
    }
  } // namespace

  void
  PathMonitor::print_line(const PathState           &state,
                          const std::vector<double> &values)
  {
    std::ostringstream line;
    if (state.branch != 0)
      line << "branch " << state.branch << ", ";
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
    const auto         n_left = n_steps_left(state);
    if (options_.report_seconds && n_done > 0 && n_left)
      line << std::fixed << std::setprecision(0) << ", "
           << timer_.wall_time() / n_done * *n_left << " s left";
    log_.progress() << line.str() << std::endl;
  }

  std::optional<double>
  PathMonitor::n_steps_left(const PathState &state) const
  {
    if (!path_.follows_curve())
      return grid_.n_steps_left(state.time, state.next_step);
    const double n_most   = double(path_.maximum_steps) - double(state.step);
    double       distance = 0., size = state.next_step;
    if (path_.controls_displacement())
      {
        double value = state.controlled;
        for (unsigned int k = state.n_controls; k < path_.control_values.size();
             value          = path_.control_values[k++])
          distance += std::abs(path_.control_values[k] - value);
      }
    else
      {
        // As if t went on changing as in the last step.
        distance = path_.end_time - state.time;
        size     = state.time - last_time_;
        if (!(distance / size > 0. && distance / size < n_most))
          return {};
      }
    return std::ceil(distance / size);
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
    const unsigned int n_points = written_.state.n_points;
    if (n_points > 0)
      text << "; " << n_points << (n_points == 1 ? " point: " : " points: ")
           << points_csv_;
    if (has_saved_)
      text << "; " << options_.file(".checkpoint");
    return text.str();
  }
} // namespace Nacre
