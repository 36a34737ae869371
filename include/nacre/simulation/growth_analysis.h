// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_growth_analysis_h
#define nacre_simulation_growth_analysis_h

#include <nacre/simulation/analysis.h>
#include <nacre/simulation/crack_growth.h>
#include <nacre/simulation/linear_analysis.h>

namespace Nacre
{
  class GrowthMonitor;

  /**
   * Linear solves between which cuts grow, a step each. By the energy release
   * rate G, proportional to the square of the loads, and by strength, each
   * state takes the factor of loads and prescribed values at which the first
   * tip advances,
   *
   *   factor = min over tips of (G_c h / G)^1/2, or of strength over stress,
   *
   * whether it rises or falls: the length of the cracks is the control. The
   * study's table holds the last state.
   */
  class GrowthAnalysis : public Analysis
  {
  public:
    /** @p problem, whose cuts grow, must live as long as the analysis. */
    GrowthAnalysis(const MPI_Comm communicator,
                   ShellProblem  &problem,
                   Log           &log);

    std::string
    name() const override
    {
      return "growth";
    }

    bool
    can_restart() const override
    {
      return false;
    }

    void
    check(const Recorder &recorder, const bool restart) override;

    void
    run(Recorder &recorder, const bool restart) override;

  private:
    class FactoredSolution;
    struct Output;

    /**
     * Solve, and lengthen the cuts, on @p mesh, null for that of the problem.
     * Returns the mesh of the next step, or null if this is the last one.
     */
    std::unique_ptr<DiscreteShell::Mesh>
    run_step(std::unique_ptr<DiscreteShell::Mesh> mesh,
             Recorder                            &recorder,
             Output                              &output);

    const MPI_Comm communicator_;
    ShellProblem  &problem_;
    Log           &log_;
    CrackGrowth    growth_;
  };
} // namespace Nacre

#endif
