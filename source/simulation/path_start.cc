// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/simulation/path_start.h>

#include <algorithm>
#include <filesystem>

namespace Nacre
{
  CheckpointData
  load_restart(const PathParameters &parameters,
               const ProblemRecord  &problem,
               const Discretization &discretization,
               Checkpoint           &checkpoint,
               Log                  &log)
  {
    CheckpointData data =
      checkpoint.load(discretization, [&](const ProblemRecord &then) {
        return forbidden_changes(then, problem);
      });
    PathState &state = data.state;
    if (has_changed("Analysis/Time step", data.problem, problem) ||
        has_changed("Analysis/Control step", data.problem, problem))
      state.next_step = parameters.first_step();
    state.next_step =
      std::min(state.next_step,
               parameters.step_of(parameters.maximum_time_step));

    log.progress() << "restart from step " << state.step
                   << ", t = " << state.time << std::endl;
    const std::string changes = permitted_changes(data.problem, problem);
    if (!changes.empty())
      log.progress() << "changed: " << changes << std::endl;
    return data;
  }

  CheckpointData
  load_start(const PathParameters &parameters,
             const ProblemRecord  &problem,
             const Discretization &discretization,
             const std::string    &own_base,
             Log                  &log)
  {
    const std::string where = "Analysis/Start from";
    // NAME and NAME.checkpoint are the same.
    std::filesystem::path base = parameters.start_from;
    if (base.extension() == ".checkpoint")
      base.replace_extension();
    const auto full = [](const std::filesystem::path &path) {
      return std::filesystem::absolute(path).lexically_normal();
    };
    AssertThrow(full(base) != full(own_base),
                ExcMessage(where + ": '" + base.string() +
                           "' is what this run itself writes; give it another "
                           "name by Study/Name or Study/Output folder, or go "
                           "on with --restart."));
    CheckpointData data =
      Checkpoint(discretization.communicator(), base.string(), where)
        .load(discretization, [&](const ProblemRecord &then) {
          return has_changed("Cuts/Cuts", then, problem) ?
                   "its 'Cuts/Cuts' are others" :
                   std::string();
        });
    // Of an arc-length path v is no velocity but the path's tangent.
    const auto type = data.problem.parameters.find("Analysis/Type");
    if (type != data.problem.parameters.end() &&
        type->second == name_of(AnalysisType::arc_length))
      data.state.motion.v = 0.;

    log.progress() << "start from step " << data.state.step
                   << ", t = " << data.state.time << " of " << base.string()
                   << std::endl;
    for (const auto *const section : {"Section", "Discretization"})
      {
        const auto changes = changes_in(section, data.problem, problem);
        if (!changes.empty())
          log.progress() << "changed: " << changes << std::endl;
      }
    return data;
  }
} // namespace Nacre
