// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/simulation/path_monitor.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  PathMonitor::PathMonitor(const MPI_Comm              communicator,
                           const Options              &options,
                           const QuantitiesOfInterest &quantities,
                           Checkpoint                 &checkpoint,
                           Log                        &log)
    : communicator_(communicator)
    , options_(options)
    , quantities_(quantities)
    , checkpoint_(checkpoint)
    , log_(log)
    , vtu_output_(options.fields)
  {}

  std::string
  PathMonitor::csv_file() const
  {
    return (std::filesystem::path(options_.folder) /
            (options_.name + "_path.csv"))
      .string();
  }

  void
  PathMonitor::resume(const CheckpointData &data)
  {
    written_    = data;
    start_time_ = data.state.time;
    vtu_output_.resume(options_.folder, options_.name, data.written_fields);
    // Rows after the checkpoint will be written again.
    run_on_root(communicator_, [&]() {
      std::ifstream      in(csv_file());
      std::ostringstream kept;
      std::string        line;
      while (std::getline(in, line))
        {
          const auto step = std::strtoul(line.c_str(), nullptr, 10);
          if (kept.str().empty() || step <= data.state.step)
            kept << line << '\n';
        }
      in.close();
      write_file(csv_file(), [&](std::ostream &out) { out << kept.str(); });
    });
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
    if (options_.write_vtu && options_.vtu_steps > 0 &&
        state.step % options_.vtu_steps == 0)
      write_fields(state, shell);
    if (options_.checkpoint_steps > 0 &&
        state.step % options_.checkpoint_steps == 0)
      save(state);
  }

  void
  PathMonitor::finish(const PathState &state, const SolvedShell &shell)
  {
    if (options_.write_vtu && written_.written_fields.count(state.step) == 0)
      write_fields(state, shell);
    if (options_.checkpoint_steps > 0 && !has_saved_)
      save(state);
  }

  void
  PathMonitor::write_fields(const PathState &state, const SolvedShell &shell)
  {
    vtu_output_.write(shell.discretization,
                      shell.section,
                      shell.kinematics,
                      shell.displacement,
                      options_.folder,
                      options_.name,
                      state.step,
                      state.time);
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
      std::ostringstream text;
      if (state.step == 0)
        {
          text << "step,time,load_factor,iterations,residual,negative_pivots";
          for (const auto &quantity : quantities_.quantities())
            text << ',' << quantity.name;
          text << '\n';
        }
      text << std::setprecision(12) << state.step << ',' << state.time << ','
           << state.load_factor << ',' << state.iterations << ','
           << state.residual << ',' << state.n_negative_pivots;
      for (const double value : values)
        text << ',' << value;
      text << '\n';
      if (state.step == 0)
        {
          write_file(csv_file(), [&](std::ostream &out) { out << text.str(); });
          return;
        }
      std::ofstream out(csv_file(), std::ios::app);
      out << text.str() << std::flush;
      AssertThrow(out, ExcMessage("Can't write '" + csv_file() + "'."));
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
    const double done = state.time - start_time_;
    if (options_.report_seconds && done > 0.)
      line << std::fixed << std::setprecision(0) << ", "
           << timer_.wall_time() * (options_.end_time - state.time) / done
           << " s left";
    log_.progress() << line.str() << std::endl;
  }
} // namespace Nacre
