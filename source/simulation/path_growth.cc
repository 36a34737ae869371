// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/part_transfer.h>
#include <nacre/simulation/growth_monitor.h>
#include <nacre/simulation/lip_release.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/stepped_shell.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  bool
  PathRun::looks_at_tips(const PathState &state) const
  {
    if (!growth_.is_on())
      return false;
    // Motions go on after their last step of growth.
    return problem_.path.is_dynamic() ? !stepped_->system.is_held(state.time) :
                                        !growth_.has_ended();
  }

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
        // A tip that moves runs on after the next step in time.
        if (!failure.empty() || problem_.path.is_dynamic())
          return failure;
        observe_growth(state);
      }
    return "";
  }

  double
  PathRun::advance_tips(PathState &state)
  {
    const auto &discretization = stepped_->shell.discretization();
    const bool  moves          = problem_.path.is_dynamic();
    const auto  before         = growth_.tips();
    if (moves)
      stepped_->path.balance_acceleration(state);
    growth_.advance(discretization, state.time, false);
    if (!moves)
      return 0.;
    const double wanted =
      release_time(problem_, discretization, before, growth_.tips());
    if (wanted == 0.)
      return 0.;
    const double time = std::max(wanted, state.next_step);
    log_.progress() << "the lips are released within " << time << std::endl;
    return time;
  }

  std::string
  PathRun::grow_by_a_step(const QuantitiesOfInterest &quantities,
                          PathState                  &state)
  {
    const double release = advance_tips(state);
    const auto   before  = state.motion;
    const auto   u       = stepped_->system.with_ghosts(before.u);
    const auto   v       = stepped_->system.with_ghosts(before.v);
    const auto   a       = stepped_->system.with_ghosts(before.a);

    const PartTransfer transfer(stepped_->shell.discretization(), {&u, &v, &a});
    assembly_seconds_ += stepped_->system.assembly_seconds();
    auto mesh = stepped_->shell.release_mesh();
    stepped_.reset();
    std::string failure;
    try
      {
        stepped_ = std::make_unique<SteppedShell>(communicator_,
                                                  problem_,
                                                  quantities,
                                                  std::move(mesh),
                                                  log_);
        const auto &discretization = stepped_->shell.discretization();
        state.motion.u             = transfer.field_on(discretization, 0);
        state.motion.v             = transfer.field_on(discretization, 1);
        state.motion.a             = transfer.field_on(discretization, 2);
        failure                    = stepped_->path.resume(state, release);
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
         << (problem_.path.is_dynamic() ? " can't be taken: " :
                                          " has no equilibrium: ")
         << failure.substr(0, failure.find_last_not_of('.') + 1)
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
