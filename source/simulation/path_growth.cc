// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/part_transfer.h>
#include <nacre/simulation/growth_monitor.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/stepped_shell.h>

#include <sstream>

namespace Nacre
{
  void
  PathRun::observe_growth(const PathState &state)
  {
    const SolvedState solved(state, *stepped_);
    growth_.observe(solved.shell());
    growth_monitor_->observe(growth_, state.time, solved.shell());
  }

  std::string
  PathRun::grow(const QuantitiesOfInterest &quantities, PathState &state)
  {
    while (growth_.is_due(state.time))
      {
        const std::string failure = grow_by_a_step(quantities, state);
        if (!failure.empty())
          return failure;
        observe_growth(state);
      }
    return "";
  }

  std::string
  PathRun::grow_by_a_step(const QuantitiesOfInterest &quantities,
                          PathState                  &state)
  {
    const auto before = state.motion;
    growth_.advance(stepped_->shell.discretization(), state.time, false);
    const auto         u = stepped_->system.with_ghosts(before.u);
    const PartTransfer transfer(stepped_->shell.discretization(), {&u});
    assembly_seconds_ += stepped_->system.assembly_seconds();
    auto mesh = stepped_->shell.release_mesh();
    stepped_.reset();
    std::string failure;
    try
      {
        stepped_       = std::make_unique<SteppedShell>(communicator_,
                                                  problem_,
                                                  quantities,
                                                  std::move(mesh),
                                                  log_);
        state.motion.u = transfer.field_on(stepped_->shell.discretization(), 0);
        state.motion.v = state.motion.a = stepped_->system.owned_vector();
        failure                         = stepped_->path.settle(state);
      }
    // As of a piece that can move freely, on all ranks.
    catch (const ExcMessage &error)
      {
        failure = error_text(error);
      }
    if (failure.empty())
      return "";
    std::ostringstream text;
    text << "growth step " << growth_.n_steps() << " at t = " << state.time
         << " has no equilibrium: " << failure
         << ". The state before it is kept. Choose a smaller 'Growth/Step', or "
            "prescribe displacements instead of loads.";
    growth_.undo();
    stepped_.reset();
    stepped_     = std::make_unique<SteppedShell>(communicator_,
                                              problem_,
                                              quantities,
                                              nullptr,
                                              log_);
    state.motion = before;
    return text.str();
  }
} // namespace Nacre
