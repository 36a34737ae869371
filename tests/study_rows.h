// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_study_rows_h
#define nacre_tests_study_rows_h

#include "tests_common.h"
#include <nacre/base/log.h>
#include <nacre/base/parameter_input.h>
#include <nacre/simulation/convergence_study.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>

/** Rows of reference tables, one after the other in a single program. */
namespace Tests
{
  using Settings = std::vector<std::string>;

  inline Settings
  operator+(Settings a, const Settings &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  inline Settings
  with_edges(const std::string &edges)
  {
    return {"Boundary conditions/Edges=" + edges};
  }

  inline Settings
  with_cells(const std::string &cells)
  {
    return {"Mid-surface/Subdivisions=" + cells};
  }

  /** A file of prm/ with some settings, and the modes it must give. */
  struct StudyRow
  {
    std::string name;
    /** In prm/, without the ending. */
    std::string file;
    double      tolerance = 0.;
    /** Load factors or angular frequencies. */
    std::vector<double> expected;
    Settings            settings;
    /** Of all modes that are found, the first one of these, from 1 on. */
    unsigned int first = 1;
    /** A quantity with a reference: their ratio multiplies the modes. */
    std::string scale = "";
  };

  /** A table of comma-separated values, by column. */
  inline std::map<std::string, std::vector<double>>
  read_csv(const std::string &file)
  {
    std::ifstream                              in(file);
    std::vector<std::string>                   names;
    std::map<std::string, std::vector<double>> columns;
    for (std::string line; std::getline(in, line);)
      {
        std::istringstream words(line);
        unsigned int       k      = 0;
        const bool         header = names.empty();
        for (std::string word; std::getline(words, word, ','); ++k)
          if (header)
            names.push_back(word);
          else
            columns[names.at(k)].push_back(std::atof(word.c_str()));
      }
    return columns;
  }

  /**
   * Run a file with the settings, by p = 4 and without refinement where they
   * don't say otherwise; the tables have the name "row".
   */
  inline void
  run_study(const std::string &file, const Settings &settings)
  {
    const std::string path = SOURCE_DIR "/../../prm/" + file + ".prm";
    const Settings    all  = Settings{"Study/Name=row",
                                  "Study/Output folder=tables",
                                  "Study/Write VTU=false",
                                  "Study/Degrees=4",
                                  "Study/Refinements=0"} +
                         settings;
    ParameterAcceptor::clear();
    ConvergenceStudy study(MPI_COMM_WORLD);
    read_parameters(path, all);
    study.prepare(path);
    Log log(MPI_COMM_WORLD, true);
    study.run(log);
  }

  /**
   * Let @p run print nothing, and check the deviations from 1 of the ratios
   * that it returns; an error has none.
   */
  inline void
  check_ratios(const std::string                          &name,
               const double                                tolerance,
               const std::function<std::vector<double>()> &run)
  {
    // Tables have seconds in them.
    std::streambuf *const out     = std::cout.rdbuf(nullptr);
    double                largest = std::numeric_limits<double>::infinity();
    try
      {
        const auto ratios = run();
        if (!ratios.empty())
          largest = 0.;
        // The negated comparison keeps NaN.
        for (const double ratio : ratios)
          if (!(std::abs(ratio - 1.) <= largest))
            largest = std::abs(ratio - 1.);
      }
    catch (const std::exception &error)
      {
        std::cerr << name << ": " << error.what() << std::endl;
      }
    std::cout.rdbuf(out);
    check_below(name, largest, tolerance);
  }

  /** Compare the modes of a row with its references. */
  inline void
  check_row(const StudyRow &row)
  {
    check_ratios(row.name, row.tolerance, [&]() {
      const auto n = row.first + row.expected.size() - 1;
      run_study(row.file,
                Settings{"Analysis/Number of modes=" + std::to_string(n),
                         "Quantities/Quantities=" + (row.scale.empty() ?
                                                       "U = energy" :
                                                       "N = " + row.scale)} +
                  row.settings);
      const double scale =
        row.scale.empty() ? 1. : read_csv("tables/row.csv").at("ratio")[0];
      auto       columns = read_csv("tables/row_modes.csv");
      const auto found =
        columns[columns.count("omega") > 0 ? "omega" : "load_factor"];
      std::vector<double> ratios;
      for (unsigned int k = 0; k < row.expected.size(); ++k)
        ratios.push_back(scale * found.at(row.first - 1 + k) / row.expected[k]);
      return ratios;
    });
  }

  /** Compare all quantities with their references. */
  inline void
  check_quantities(const std::string &name,
                   const std::string &file,
                   const double       tolerance,
                   const std::string &quantities,
                   const Settings    &settings)
  {
    check_ratios(name, tolerance, [&]() {
      run_study(file,
                settings + Settings{"Quantities/Quantities=" + quantities});
      std::vector<double> ratios;
      for (const auto &[column, values] : read_csv("tables/row.csv"))
        if (column.rfind("ratio", 0) == 0)
          ratios.push_back(values.at(0));
      return ratios;
    });
  }
} // namespace Tests

#endif
