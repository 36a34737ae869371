// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Paths of sections with memory: unloading is another way than loading, a step
// that fails leaves no trace, and a restart goes on with the states.

#include "../tests_common.h"
#include "power_section.h"
#include <nacre/base/log.h>
#include <nacre/base/parameter_input.h>
#include <nacre/simulation/convergence_study.h>

#include <fstream>
#include <map>
#include <sstream>

using namespace Tests;

using Row = std::vector<double>;

/** The rows of a path by their times (rounded to 1e-6): w, M and U. */
std::map<int, Row>
run(const std::string              &name,
    const std::vector<std::string> &settings,
    const bool                      restart = false)
{
  // Tables have seconds in them.
  std::streambuf *const out = std::cout.rdbuf(nullptr);
  ParameterAcceptor::clear();
  ConvergenceStudy study(MPI_COMM_WORLD, std::make_unique<MemorySection>());
  std::vector<std::string> overrides(settings);
  overrides.push_back("Study/Name=" + name);
  const std::string file = SOURCE_DIR "/memory_path.prm";
  read_parameters(file, overrides);
  study.prepare(file);
  Log log(MPI_COMM_WORLD, true);
  study.run(log, restart);
  std::cout.rdbuf(out);

  std::map<int, Row>       rows;
  std::ifstream            in(name + "_path.csv");
  std::vector<std::string> header;
  for (std::string line; std::getline(in, line);)
    {
      std::istringstream       words(line);
      std::vector<std::string> entries;
      for (std::string word; std::getline(words, word, ',');)
        entries.push_back(word);
      if (header.empty())
        {
          header = entries;
          continue;
        }
      Row    row;
      double time = 0.;
      for (unsigned int k = 0; k < header.size(); ++k)
        if (header[k] == "time")
          time = std::stod(entries[k]);
        else if (header[k] == "w" || header[k] == "M" || header[k] == "U")
          row.push_back(std::stod(entries[k]));
      rows[std::lround(1e6 * time)] = row;
    }
  return rows;
}

/** The largest relative difference of two rows, of three values. */
double
difference(const Row &a, const Row &b)
{
  if (a.size() != 3 || b.size() != 3)
    return std::numeric_limits<double>::infinity();
  double largest = 0.;
  for (unsigned int k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]) / std::abs(b[k]));
  return largest;
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // One rank speaks for all: values are global.
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.rdbuf(nullptr);
  auto whole = run("whole", {});
  // Stiffer by what the largest load has done.
  check_above("unloading is another way",
              whole[500000][0] / whole[1500000][0] - 1.,
              0.02);
  // Of the same load; the law at rest would answer half of it.
  check_below("moments are those of the state",
              std::abs(whole[1500000][1] / whole[500000][1] - 1.),
              0.1);
  check_below("at the end all is as at rest",
              std::abs(whole[2000000][0]) / whole[1000000][0],
              1e-8);

  run("stopped", {"Analysis/End time=1", "Analysis/Checkpoint steps=1"});
  auto resumed = run("stopped", {"Analysis/Checkpoint steps=1"}, true);
  check_below("a restart goes on with the states",
              difference(resumed[1500000], whole[1500000]),
              1e-7);

  // The law is elastic while strains grow: steps make no difference.
  auto failing = run("failing",
                     {"Analysis/Time step=1",
                      "Analysis/Maximum iterations=9",
                      "Analysis/End time=1"});
  check_above("steps fail", failing.size(), 2.5);
  check_below("steps that fail leave no trace",
              difference(failing[1000000], whole[1000000]),
              1e-7);
  return Utilities::MPI::max(n_failures, MPI_COMM_WORLD) > 0;
}
