// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/postprocess/cut_quantities.h>
#include <nacre/simulation/growth_monitor.h>
#include <nacre/simulation/table_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <set>
#include <sstream>

namespace Nacre
{
  namespace
  {
    const std::array<std::string, 4> intensity_names{
      {"K_I", "K_II", "K_M", "K_T"}};

    /** The numbers of the cuts that grow. */
    std::set<unsigned int>
    growing_cuts(const CrackGrowth &growth)
    {
      std::set<unsigned int> cuts;
      for (const GrowingTip &tip : growth.tips())
        cuts.insert(tip.end.cut);
      return cuts;
    }

    std::string
    in_one_word(std::string name)
    {
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }

    double
    length_of_cut(const ShellState &state, const unsigned int cut)
    {
      CutQuantity length{CutQuantity::Kind::length};
      length.cut = cut;
      return evaluate_cut_quantity(state, length);
    }
  } // namespace

  GrowthMonitor::GrowthMonitor(const MPI_Comm              communicator,
                               const OutputOptions        &options,
                               const ShellProblem         &problem,
                               const QuantitiesOfInterest &quantities,
                               Log                        &log)
    : communicator_(communicator)
    , csv_(options.file("_growth.csv"))
    , problem_(problem)
    , quantities_(quantities)
    , log_(log)
  {}

  void
  GrowthMonitor::add_tip(const GrowingTip &tip, const Growth &growth, Row &row)
  {
    const std::string name = '_' + in_one_word(tip.name);
    for (unsigned int c = 0; c < spacedim; ++c)
      row.emplace_back("xyz"[c] + name, tip.position[c]);
    if (!growth.is_prescribed())
      row.emplace_back("closed" + name, tip.closed);
    if (growth.is_by_energy())
      row.emplace_back("G" + name, tip.rate);
    if (growth.is_by_strength())
      row.emplace_back("stress_ratio" + name, tip.drive);
    if (tip.has_intensities)
      for (unsigned int k = 0; k < tip.intensities.size(); ++k)
        row.emplace_back(intensity_names[k] + name, tip.intensities[k]);
    row.emplace_back("angle" + name, tip.angle * 180. / numbers::PI);
  }

  GrowthMonitor::Row
  GrowthMonitor::make_row(const CrackGrowth &growth,
                          const double       time,
                          const SolvedShell &shell) const
  {
    Row row;
    row.emplace_back("step", growth.n_steps());
    row.emplace_back("time", time);
    row.emplace_back("load_factor", shell.instant.factor);
    for (const unsigned int cut : growing_cuts(growth))
      row.emplace_back("length_" +
                         in_one_word(problem_.model.cuts.curves[cut].name),
                       length_of_cut(shell, cut));
    for (const GrowingTip &tip : growth.tips())
      add_tip(tip, problem_.growth, row);
    if (problem_.growth.starting_cracks > 0)
      {
        // Without any tension there is no place.
        const auto      &starts = growth.starts();
        const CrackStart first  = starts.empty() ? CrackStart() : starts[0];
        row.emplace_back("stress_ratio_start", first.drive);
        for (unsigned int c = 0; c < spacedim; ++c)
          row.emplace_back("xyz"[c] + std::string("_start"), first.position[c]);
      }
    for (const auto &quantity : quantities_.quantities())
      {
        const double value = quantity.evaluate(shell);
        AssertThrow(std::isfinite(value),
                    ExcMessage("The quantity '" + quantity.name +
                               "' is not a finite number in growth step " +
                               std::to_string(growth.n_steps()) + "."));
        row.emplace_back(quantity.name, value);
      }
    return row;
  }

  void
  GrowthMonitor::write_row(const Row &row)
  {
    std::ostringstream header, text;
    text << std::setprecision(12);
    const char *separator = "";
    for (const auto &[name, value] : row)
      {
        header << separator << name;
        text << separator << value;
        separator = ",";
      }
    if (header.str() == header_)
      {
        TableFile::append(text.str(), csv_);
        return;
      }
    // Tips are never taken away: the last row has all columns, unless a step
    // is taken back.
    TableFile table;
    if (n_rows_ > 0)
      table = TableFile::read(csv_);
    table   = table.with_columns(header.str());
    header_ = table.header;
    table.rows.push_back(text.str());
    table.write(csv_);
  }

  void
  GrowthMonitor::resume(const CheckpointData &data,
                        const ProblemRecord  &problem)
  {
    const bool goes_on =
      !has_changed("Quantities/Quantities", data.problem, problem);
    const unsigned int n_kept = data.growth.n_rows;
    n_rows_                   = goes_on ? n_kept : 0;
    n_steps_                  = data.growth.state.n_steps;
    if (n_kept == 0)
      return;
    std::string earlier = csv_;
    earlier.insert(earlier.size() - std::string(".csv").size(),
                   "_until_" + std::to_string(data.state.step));
    run_on_root(communicator_, [&]() {
      unsigned int    n     = 0;
      const TableFile table = TableFile::read(csv_, [&](const std::string &) {
        return n++ < n_kept;
      });
      table.write(goes_on ? csv_ : earlier);
      if (goes_on)
        header_ = table.header;
      else
        std::filesystem::remove(csv_);
    });
    if (!goes_on)
      log_.progress() << "the states of growth up to step " << data.state.step
                      << " are now in " << earlier << std::endl;
  }

  void
  GrowthMonitor::observe(const CrackGrowth &growth,
                         const double       time,
                         const SolvedShell &shell)
  {
    const Row          row = make_row(growth, time, shell);
    std::ostringstream line;
    line << std::setprecision(6) << "growth step " << growth.n_steps()
         << ", load factor " << shell.instant.factor;
    for (const unsigned int cut : growing_cuts(growth))
      line << ", " << problem_.model.cuts.curves[cut].name << " has length "
           << length_of_cut(shell, cut);
    for (const GrowingTip &tip : growth.tips())
      if (tip.is_alive && problem_.growth.is_by_energy())
        line << ", G of " << tip.name << " = " << tip.rate;
      else if (tip.is_alive && problem_.growth.is_by_strength())
        line << ", stress over strength ahead of " << tip.name << " = "
             << tip.drive;
    if (!growth.starts().empty())
      line << ", away from tips = " << growth.starts()[0].drive << " at ("
           << growth.starts()[0].position << ')';
    const auto &quantities = quantities_.quantities();
    for (std::size_t k = 0; k < quantities.size(); ++k)
      line << ", " << quantities[k].name << " = "
           << row[row.size() - quantities.size() + k].second;
    log_.progress() << line.str() << std::endl;
    run_on_root(communicator_, [&]() { write_row(row); });
    ++n_rows_;
    n_steps_ = growth.n_steps();
  }

  std::string
  GrowthMonitor::summary() const
  {
    return "Growth: " + std::to_string(n_steps_) +
           (n_steps_ == 1 ? " step: " : " steps: ") + csv_;
  }
} // namespace Nacre
