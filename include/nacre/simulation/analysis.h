// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_analysis_h
#define nacre_simulation_analysis_h

#include <nacre/simulation/recorder.h>
#include <nacre/simulation/shell_problem.h>

#include <memory>
#include <string>

namespace Nacre
{
  class AdaptiveRefinement;
  class Log;

  /**
   * How a ShellProblem is solved. A study asks make_analysis() for the one that
   * the problem names, and doesn't know which it runs.
   */
  class Analysis
  {
  public:
    virtual ~Analysis() = default;

    /** What is solved, in the singular: "path". */
    virtual std::string
    name() const = 0;

    /** Whether run() can go on from a checkpoint. */
    virtual bool
    can_restart() const = 0;

    /**
     * Check as far as that goes without solving: what run() would complain of
     * before its first solve; throws ExcMessage. Collective.
     */
    virtual void
    check(const Recorder &recorder, const bool restart) = 0;

    /** Solve, and hand all solutions to the @p recorder. Collective. */
    virtual void
    run(Recorder &recorder, const bool restart) = 0;
  };

  /**
   * @p problem and @p adaptive must live as long as the analysis, which may
   * lengthen the cuts of the problem.
   */
  std::unique_ptr<Analysis>
  make_analysis(const MPI_Comm            communicator,
                ShellProblem             &problem,
                const AdaptiveRefinement &adaptive,
                Log                      &log);
} // namespace Nacre

#endif
