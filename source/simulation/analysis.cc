// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/analysis.h>
#include <nacre/simulation/buckling_analysis.h>
#include <nacre/simulation/growth_analysis.h>
#include <nacre/simulation/linear_analysis.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/vibration_analysis.h>

namespace Nacre
{
  std::unique_ptr<Analysis>
  make_analysis(const MPI_Comm            communicator,
                ShellProblem             &problem,
                const AdaptiveRefinement &adaptive,
                Log                      &log)
  {
    if (problem.path.is_linear() && problem.growth.is_on())
      return std::make_unique<GrowthAnalysis>(communicator, problem, log);
    if (problem.path.is_linear())
      return std::make_unique<LinearAnalysis>(communicator,
                                              problem,
                                              adaptive,
                                              log);
    if (problem.path.type == AnalysisType::buckling)
      return std::make_unique<BucklingAnalysis>(communicator, problem, log);
    if (problem.path.type == AnalysisType::vibration)
      return std::make_unique<VibrationAnalysis>(communicator, problem, log);
    return std::make_unique<PathRun>(communicator, problem, adaptive, log);
  }
} // namespace Nacre
