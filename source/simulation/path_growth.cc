// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/field_projection.h>
#include <nacre/simulation/growth_monitor.h>
#include <nacre/simulation/lip_release.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/stepped_shell.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

namespace Nacre
{
  namespace
  {
    /** Let u, v, a be the projection of what they were @p before. */
    void
    project(const FieldProjection &before,
            const SectionLaw      &section,
            SteppedShell          &stepped,
            MotionState           &motion)
    {
      ShellSystem &system  = stepped.system;
      const auto   u       = system.with_ghosts(motion.u);
      const auto   v       = system.with_ghosts(motion.v);
      const auto   a       = system.with_ghosts(motion.a);
      const auto   changes = system.solve_mass(
        *stepped.path.dynamic_mass(),
        before.missing(system.discretization(), {&u, &v, &a}, section),
        false);
      motion.u += changes[0];
      motion.v += changes[1];
      motion.a += changes[2];
    }
  } // namespace

  bool
  PathRun::watches_tips(const PathState &state) const
  {
    if (!growth_.is_on())
      return false;
    // Motions go on after their last step of growth.
    return problem_.path.is_dynamic() ? !stepped_->system.is_held(state.time) :
                                        !growth_.has_ended();
  }

  void
  PathRun::look_at_tips(const PathState &state)
  {
    const SolvedState solved(state, *stepped_);
    growth_.observe(solved.shell());
  }

  void
  PathRun::record_growth(const PathState &state)
  {
    const SolvedState solved(state, *stepped_);
    growth_monitor_->observe(growth_, state.time, solved.shell());
  }

  std::string
  PathRun::find_critical_state(PathState &state)
  {
    if (growth_.largest_drive() <= 0.)
      return "no tip is left, or none is being opened.";
    const auto   missing = [&]() { return growth_.critical_factor() - 1.; };
    const auto  &v       = state.motion.v;
    const double largest = problem_.path.maximum_time_step;
    double       left    = missing();
    // In a linear structure displacements are multiplied by that factor.
    double size = left * std::abs(state.motion.u * v) / (v * v);
    for (unsigned int k = 0; k < 40; ++k)
      {
        if (std::abs(left) <= 1e-7)
          return "";
        size                      = std::clamp(size, -largest, largest);
        const std::string failure = stepped_->path.curve()->move(state, size);
        if (!failure.empty())
          return "no state nearby at which tips are just about to advance: " +
                 failure + ".";
        look_at_tips(state);
        if (growth_.largest_drive() <= 0.)
          return "no tip is being opened there.";
        const double before = std::exchange(left, missing());
        // G should rise forward.
        const double slope = (left - before) / size;
        size = slope < 0. ? -left / slope : std::copysign(size, left);
      }
    return "no state at which tips are just about to advance was found within "
           "40 steps along the path.";
  }

  std::string
  PathRun::grow(const QuantitiesOfInterest &quantities, PathState &state)
  {
    is_critical_ = false;
    while (growth_.is_due(state.time))
      {
        const std::string failure = grow_by_a_step(quantities, state);
        // A restart tries it again.
        is_critical_ = !failure.empty();
        // A tip that moves runs on after the next step in time.
        if (!failure.empty() || problem_.path.is_dynamic())
          return failure;
        look_at_tips(state);
        record_growth(state);
      }
    return "";
  }

  std::string
  PathRun::grow_along_curve(const QuantitiesOfInterest &quantities,
                            PathState                  &state)
  {
    if (is_critical_)
      {
        const std::string failure = grow_by_a_step(quantities, state);
        if (!failure.empty())
          return failure;
        ++state.step;
        look_at_tips(state);
      }
    PathState         critical(state);
    const bool        is_due  = growth_.largest_drive() >= 1.;
    const std::string failure = find_critical_state(critical);
    const double      end     = problem_.path.end_time;
    is_critical_ = failure.empty() && std::abs(critical.time) <= std::abs(end);
    if (is_critical_)
      state = critical;
    else if (is_due)
      return "growth step " + std::to_string(growth_.n_steps() + 1) + ": " +
             (failure.empty() ? "tips advance beyond the End time only." :
                                failure);
    else
      look_at_tips(state);
    record_growth(state);
    is_critical_ = is_critical_ && !growth_.has_ended();
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

    const auto &states     = stepped_->shell.assembly().section_states();
    const auto  remembered = states.records(stepped_->shell.discretization());
    const PartTransfer             transfer(stepped_->shell.discretization(),
                                {&u, &v, &a},
                                states.of_rules());
    std::optional<FieldProjection> projection;
    if (problem_.path.is_dynamic())
      projection.emplace(stepped_->shell.discretization(),
                         std::vector{&u, &v, &a});
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
        stepped_->shell.assembly().section_states().take(discretization,
                                                         transfer);
        state.motion.u = transfer.field_on(discretization, 0);
        state.motion.v = transfer.field_on(discretization, 1);
        state.motion.a = transfer.field_on(discretization, 2);
        if (projection)
          project(*projection,
                  *problem_.model.section,
                  *stepped_,
                  state.motion);
        failure = stepped_->path.resume(state, release);
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
    stepped_ = std::make_unique<SteppedShell>(communicator_,
                                              problem_,
                                              quantities,
                                              nullptr,
                                              log_);
    stepped_->shell.assembly().section_states().take(
      stepped_->shell.discretization(),
      remembered);
    state.motion = before;
    return text.str();
  }
} // namespace Nacre
