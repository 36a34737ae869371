// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_path_start_h
#define nacre_simulation_path_start_h

#include <nacre/simulation/checkpoint.h>

#include <string>

namespace Nacre
{
  class Log;

  /**
   * The state that a run goes on from at a restart, with the sizes of steps
   * that it has now. Tells what has changed; throws if that makes it another
   * problem. Collective.
   */
  CheckpointData
  load_restart(const PathParameters &parameters,
               const ProblemRecord  &problem,
               const Discretization &discretization,
               Checkpoint           &checkpoint,
               Log                  &log);

  /**
   * The last state of the run that `Analysis/Start from` names, for a new path
   * whose files are called @p own_base. Throws if it is of another element or
   * mesh; tells what else has changed of the shell. Collective.
   */
  CheckpointData
  load_start(const PathParameters &parameters,
             const ProblemRecord  &problem,
             const Discretization &discretization,
             const std::string    &own_base,
             Log                  &log);
} // namespace Nacre

#endif
