// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/cut_quantities.h>
#include <nacre/simulation/growth_monitor.h>

#include <algorithm>
#include <cmath>
#include <fstream>
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
    growing_cuts(const ShellProblem &problem)
    {
      std::set<unsigned int> cuts;
      for (const Growth::Tip &tip : problem.growth.tips)
        cuts.insert(tip.cut);
      return cuts;
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

  std::string
  GrowthMonitor::header(const CrackGrowth &growth) const
  {
    const bool         has_rates = !problem_.growth.is_prescribed();
    std::ostringstream text;
    text << "step,time,load_factor";
    for (const unsigned int cut : growing_cuts(problem_))
      text << ",length_" << problem_.model.cuts.curves[cut].name;
    for (const GrowingTip &tip : growth.tips())
      {
        std::string name = tip.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        for (const auto *const what : {"x", "y", "z"})
          text << ',' << what << '_' << name;
        if (has_rates)
          text << ",closed_" << name << ",G_" << name;
        if (tip.has_intensities)
          for (const auto &what : intensity_names)
            text << ',' << what << '_' << name;
        text << ",angle_" << name;
      }
    for (const auto &quantity : quantities_.quantities())
      text << ',' << quantity.name;
    text << '\n';
    return text.str();
  }

  void
  GrowthMonitor::observe(const CrackGrowth &growth,
                         const double       time,
                         const SolvedShell &shell)
  {
    const bool         has_rates = !problem_.growth.is_prescribed();
    std::ostringstream row, line;
    row << std::setprecision(12) << growth.n_steps() << ',' << time << ','
        << shell.instant.factor;
    line << std::setprecision(6) << "growth step " << growth.n_steps()
         << ", load factor " << shell.instant.factor;
    for (const unsigned int cut : growing_cuts(problem_))
      {
        const double length = length_of_cut(shell, cut);
        row << ',' << length;
        line << ", " << problem_.model.cuts.curves[cut].name << " has length "
             << length;
      }
    for (const GrowingTip &tip : growth.tips())
      {
        for (unsigned int c = 0; c < spacedim; ++c)
          row << ',' << tip.position[c];
        if (has_rates)
          row << ',' << tip.closed << ',' << tip.rate;
        if (has_rates && tip.is_alive)
          line << ", G of " << tip.name << " = " << tip.rate;
        if (tip.has_intensities)
          for (const double intensity : tip.intensities)
            row << ',' << intensity;
        row << ',' << tip.angle * 180. / numbers::PI;
      }
    for (const auto &quantity : quantities_.quantities())
      {
        const double value = quantity.evaluate(shell);
        AssertThrow(std::isfinite(value),
                    ExcMessage("The quantity '" + quantity.name +
                               "' is not a finite number in growth step " +
                               std::to_string(growth.n_steps()) + "."));
        row << ',' << value;
        line << ", " << quantity.name << " = " << value;
      }
    row << '\n';
    log_.progress() << line.str() << std::endl;
    const std::string head = n_rows_ == 0 ? header(growth) : "";
    run_on_root(communicator_, [&]() {
      if (n_rows_ == 0)
        write_file(csv_, [&](std::ostream &out) { out << head; });
      std::ofstream out(csv_, std::ios::app);
      out << row.str() << std::flush;
      AssertThrow(out,
                  ExcMessage("Writing '" + csv_ +
                             "' failed: is the disk full?"));
    });
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
