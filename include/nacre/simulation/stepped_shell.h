// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_stepped_shell_h
#define nacre_simulation_stepped_shell_h

#include <nacre/analysis/path_analysis.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/simulation/discrete_shell.h>

namespace Nacre
{
  /** A shell, its system of equations and the steps that solve it. */
  struct SteppedShell
  {
    /**
     * Everything that is wrong without a step is found here.
     * @param mesh null: that of the problem
     */
    SteppedShell(const MPI_Comm                       communicator,
                 const ShellProblem                  &problem,
                 const QuantitiesOfInterest          &quantities,
                 std::unique_ptr<DiscreteShell::Mesh> mesh,
                 Log                                 &log);

    DiscreteShell shell;
    ShellSystem   system;
    PathAnalysis  path;
  };

  /** A state of the path with its forces, as the quantities see it. */
  class SolvedState
  {
  public:
    /** Sets the time of the system. Collective. */
    SolvedState(const PathState &state, SteppedShell &stepped)
      : SolvedState(state, stepped.shell, stepped.path, stepped.system)
    {}

    const SolvedShell &
    shell() const
    {
      return shell_;
    }

  private:
    using Vector = TrilinosWrappers::MPI::Vector;

    SolvedState(const PathState     &state,
                const DiscreteShell &shell,
                const PathAnalysis  &path,
                ShellSystem         &system);

    /** Fills residual_: inertia is part of the reactions. */
    Energies
    forces(const DiscreteShell &shell,
           const PathAnalysis  &path,
           const ShellSystem   &system);

    const Vector      displacement_;
    const Vector      velocity_;
    const Vector      acceleration_;
    Vector            residual_;
    const SolvedShell shell_;
  };
} // namespace Nacre

#endif
