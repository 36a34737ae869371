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

std::string
prepare(ConvergenceStudy               &study,
        const std::string              &name,
        const std::vector<std::string> &settings)
{
  std::vector<std::string> overrides(settings);
  overrides.push_back("Study/Name=" + name);
  const std::string file = SOURCE_DIR "/memory_path.prm";
  read_parameters(file, overrides);
  study.prepare(file);
  return name + "_path.csv";
}

/** By their times (rounded to 1e-6): iterations, w, M and U. */
std::map<int, Row>
run(const std::string              &name,
    const std::vector<std::string> &settings,
    const bool                      restart = false)
{
  // Tables have seconds in them.
  std::streambuf *const out = std::cout.rdbuf(nullptr);
  ParameterAcceptor::clear();
  ConvergenceStudy  study(MPI_COMM_WORLD,
                         std::make_unique<MemorySectionParameters>());
  const std::string csv = prepare(study, name, settings);
  Log               log(MPI_COMM_WORLD, true);
  study.run(log, restart);
  std::cout.rdbuf(out);

  std::map<int, Row>       rows;
  std::ifstream            in(csv);
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
        else if (header[k] == "iterations" || header[k] == "w" ||
                 header[k] == "M" || header[k] == "U")
          row.push_back(std::stod(entries[k]));
      rows[std::lround(1e6 * time)] = row;
    }
  return rows;
}

/** The largest relative difference of two rows' quantities. */
double
difference(const Row &a, const Row &b)
{
  if (a.size() != 4 || b.size() != 4)
    return std::numeric_limits<double>::infinity();
  double largest = 0.;
  for (unsigned int k = 1; k < a.size(); ++k)
    largest = std::max(largest, std::abs(a[k] - b[k]) / std::abs(b[k]));
  return largest;
}

/** Whether @p settings are refused with a message that has the @p words. */
void
test_refusal(const std::vector<std::string> &settings, const std::string &words)
{
  ParameterAcceptor::clear();
  ConvergenceStudy study(MPI_COMM_WORLD,
                         std::make_unique<MemorySectionParameters>());
  bool             is_refused = false;
  try
    {
      prepare(study, "refused", settings);
    }
  catch (const ExceptionBase &error)
    {
      if (std::getenv("NACRE_TEST_VALUES") != nullptr)
        std::cout << error.what() << std::endl;
      is_refused = std::string(error.what()).find(words) != std::string::npos;
    }
  check_above("refused: " + settings.front(), is_refused, 0.5);
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
              whole[500000][1] / whole[1500000][1] - 1.,
              0.02);
  // Of the same load; the law at rest would answer several per cent less.
  check_below("moments are those of the state",
              std::abs(whole[1500000][2] / whole[500000][2] - 1.),
              0.02);
  check_below("at the end all is as at rest",
              std::abs(whole[2000000][1]) / whole[1000000][1],
              1e-8);

  // The linear law takes 9; rotations jump a lot on so coarse a mesh.
  check_below("iterations of the first step", whole[500000][0], 17.5);

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

  // Where the load is gone the energy is what the states have changed it by:
  // other points, but no other history.
  auto refined =
    run("refined",
        {"Adaptive refinement/Cycles=1", "Adaptive refinement/Every steps=3"});
  check_below("refined on the way",
              std::abs(refined[2000000][3] / whole[2000000][3] - 1.),
              0.2);

  test_refusal({"Discretization/Kinematics=linear", "Analysis/Type=linear"},
               "'linear' is for linear sections only");
  test_refusal({"Analysis/Type=dynamic",
                "Section/Density=1",
                "Analysis/Scheme=energy momentum"},
               "Scheme: 'energy momentum'");
  test_refusal({"Analysis/Type=vibration", "Analysis/Start from=other"},
               "choose static or another path");
  test_refusal({"Analysis/Start from=other"}, "go on with --restart");
  test_refusal({"Linear solver/Solver=multigrid"}, "choose auto or direct");
  return Utilities::MPI::max(n_failures, MPI_COMM_WORLD) > 0;
}
