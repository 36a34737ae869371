// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/cpu_timer.h>
#include <nacre/base/log.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/part_transfer.h>
#include <nacre/simulation/adaptive_refinement.h>
#include <nacre/simulation/growth_monitor.h>
#include <nacre/simulation/path_monitor.h>
#include <nacre/simulation/path_quantities.h>
#include <nacre/simulation/path_run.h>
#include <nacre/simulation/path_start.h>
#include <nacre/simulation/run_warnings.h>
#include <nacre/simulation/stepped_shell.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    bool
    has_linear_kinematics(const ShellProblem &problem)
    {
      return problem.model.kinematics.model == KinematicsModel::linear;
    }

    /** Folder and name of a path's files, without their endings. */
    OutputOptions
    own_options(const Recorder &recorder, const int branch = 0)
    {
      OutputOptions options = recorder.options();
      options.name          = recorder.names().own_name;
      if (branch != 0)
        options.name += "_branch" + std::to_string(branch);
      return options;
    }

    /** Of paths whose t is unknown: the files of an earlier run's points. */
    void
    remove_points(const OutputOptions &options)
    {
      std::vector<std::filesystem::path> old = {options.file("_points.csv")};
      if (std::filesystem::exists(options.folder))
        for (const auto &entry :
             std::filesystem::directory_iterator(options.folder))
          {
            const std::string file = entry.path().filename().string();
            for (const auto *const kind : {"_point", "_branch"})
              if (const std::string start = options.name + kind;
                  file.compare(0, start.size(), start) == 0 &&
                  file.find_first_of("-0123456789", start.size()) ==
                    start.size() &&
                  file.find(".checkpoint") != std::string::npos)
                old.push_back(entry.path());
          }
      std::error_code not_there;
      for (const auto &file : old)
        std::filesystem::remove(file, not_there);
    }
  } // namespace

  PathRun::PathRun(const MPI_Comm            communicator,
                   ShellProblem             &problem,
                   const AdaptiveRefinement &adaptive,
                   Log                      &log)
    : communicator_(communicator)
    , problem_(problem)
    , adaptive_(adaptive)
    , log_(log)
    , growth_(problem, log)
  {
    if (has_linear_kinematics(problem))
      warn_of_linear_path(log);
  }

  PathRun::~PathRun() = default;

  std::unique_ptr<SteppedShell>
  PathRun::first_shell(const Recorder &recorder, const bool restart)
  {
    std::unique_ptr<MeshRecord::Mesh> mesh;
    if (restart && (growth_.is_on() || adaptive_.is_on()))
      mesh = take_cuts_and_mesh(own_options(recorder).file(""));
    return std::make_unique<SteppedShell>(communicator_,
                                          problem_,
                                          recorder.quantities(),
                                          std::move(mesh),
                                          log_);
  }

  std::unique_ptr<MeshRecord::Mesh>
  PathRun::take_cuts_and_mesh(const std::string &base)
  {
    const ProblemRecord now =
      current_problem(communicator_, problem_.model.midsurface);
    const CheckpointHead head =
      Checkpoint(communicator_, base).load_head([&](const auto &then) {
        return forbidden_changes(then, now);
      });
    if (growth_.is_on())
      growth_.resume(head.growth.state);
    is_critical_   = head.growth.is_critical;
    n_refinements_ = head.mesh.n_refinements;
    if (n_refinements_ == 0)
      return nullptr;
    auto mesh = create_mesh(communicator_, problem_);
    head.mesh.refine(*mesh);
    return mesh;
  }

  void
  PathRun::complete(CheckpointData &data) const
  {
    if (growth_.is_on())
      data.growth = {growth_.state(), is_critical_, growth_monitor_->n_rows()};
    data.mesh.n_refinements = n_refinements_;
    if (n_refinements_ > 0)
      data.mesh.take(stepped_->shell.discretization().triangulation());
    data.held = stepped_->system.held();
  }

  void
  PathRun::check(const Recorder &recorder, const bool restart)
  {
    const auto           stepped = first_shell(recorder, restart);
    const DiscreteShell &shell   = stepped->shell;
    growth_.check(shell.discretization());
    recorder.check_quantities(shell.discretization());
    shell.check_integrands();
    const std::string base = own_options(recorder).file("");
    Checkpoint        checkpoint(communicator_, base);
    load_state(shell,
               current_problem(communicator_, problem_.model.midsurface),
               base,
               restart,
               checkpoint);
  }

  void
  PathRun::run(Recorder &recorder, const bool restart)
  {
    CpuTimer timer(communicator_);
    stepped_ = first_shell(recorder, restart);
    SolveRecord record;
    record.setup = timer.lap();
    record.eta   = stepped_->shell.assembly().penalty().eta();
    growth_.check(stepped_->shell.discretization());
    recorder.check_quantities(stepped_->shell.discretization());

    timer.lap();
    PathEnd     end     = follow_path(0, restart, recorder);
    std::string failure = end.failure;
    for (const int branch : branches(end.state.n_bifurcations))
      {
        end = follow_path(branch, restart, recorder);
        if (!end.failure.empty())
          failure += (failure.empty() ? "" : " ") + std::string("Branch ") +
                     std::to_string(branch) + ": " + end.failure;
      }
    record.assembly = Utilities::MPI::sum(assembly_seconds_ +
                                            stepped_->system.assembly_seconds(),
                                          communicator_);
    record.solve    = timer.lap() - record.assembly;
    AssertThrow(failure.empty(), ExcMessage(failure));
    add_row(end.state, record, recorder);
  }

  PathRun::PathEnd
  PathRun::follow_path(const int branch, const bool restart, Recorder &recorder)
  {
    const OutputOptions primary = own_options(recorder);
    const OutputOptions options = own_options(recorder, branch);
    Checkpoint          checkpoint(communicator_, options.file(""));
    PathMonitor         monitor(
      communicator_,
      options,
      primary.file("_points.csv"),
      branch,
      problem_.path,
      recorder.quantities(),
      checkpoint,
      [&](CheckpointData &data) { complete(data); },
      log_);
    if (growth_.is_on())
      growth_monitor_ = std::make_unique<GrowthMonitor>(communicator_,
                                                        options,
                                                        problem_,
                                                        recorder.quantities(),
                                                        log_);
    // The same on all ranks.
    const bool exists = std::filesystem::exists(options.file(".checkpoint"));
    const bool goes_on =
      restart &&
      (branch == 0 || Utilities::MPI::max(exists ? 1u : 0u, communicator_) > 0);
    PathEnd end{begin(branch, goes_on, options, checkpoint, monitor, recorder),
                ""};
    if (!goes_on || !ends(end.state, recorder.quantities()))
      end.failure = follow(end.state, monitor, recorder);
    const SolvedState last(end.state, *stepped_);
    monitor.finish(end.state, last.shell());
    recorder.add_summary(monitor.summary());
    if (growth_.is_on())
      recorder.add_summary(growth_monitor_->summary());
    return end;
  }

  PathState
  PathRun::begin(const int            branch,
                 const bool           restart,
                 const OutputOptions &options,
                 Checkpoint          &checkpoint,
                 PathMonitor         &monitor,
                 const Recorder      &recorder)
  {
    const ProblemRecord problem =
      current_problem(communicator_, problem_.model.midsurface);
    if (branch != 0 && !restart)
      {
        const PathState state = branch_start(branch, own_options(recorder));
        run_on_root(communicator_, [&]() { checkpoint.remove(); });
        monitor.start(problem);
        return state;
      }
    const auto data = load_state(stepped_->shell,
                                 problem,
                                 options.file(""),
                                 restart,
                                 checkpoint);
    if (restart)
      {
        // A restart that is refused leaves all files as they were.
        recorder.start_files(true);
        monitor.resume(*data, problem);
        if (growth_monitor_)
          growth_monitor_->resume(*data, problem);
        stepped_->system.hold(data->held);
        stepped_->shell.assembly().section_states().take(
          stepped_->shell.discretization(),
          data->section_states);
        return data->state;
      }
    const PathState state =
      stepped_->path.initial_state(data ? &data->state.motion : nullptr);
    run_on_root(communicator_, [&]() {
      checkpoint.remove();
      remove_points(options);
    });
    monitor.start(problem);
    return state;
  }

  std::vector<int>
  PathRun::branches(const unsigned int n_found) const
  {
    const BranchChoice &choice = problem_.path.branches;
    if (choice.n_bifurcations() > n_found)
      log_.warning(
        "Analysis/Switch branch: the primary path has only " +
        std::to_string(n_found) +
        (n_found == 1 ? " bifurcation point; " : " bifurcation points; ") +
        "the branches of others are left out.");
    return choice.has_several() ? choice.branches(n_found) : std::vector<int>();
  }

  PathState
  PathRun::branch_start(const int number, const OutputOptions &primary)
  {
    const auto place = static_cast<unsigned int>(std::abs(number));
    // After a restart points from before are known by their checkpoints only.
    for (unsigned int k = 1; bifurcations_.count(place) == 0; ++k)
      {
        Checkpoint point(communicator_, PathMonitor::point_file(primary, k));
        const CheckpointData data =
          point.load(stepped_->shell.discretization(),
                     [](const ProblemRecord &) { return std::string(); });
        bifurcations_.emplace(data.state.n_bifurcations, data.state);
      }
    PathState state = bifurcations_.at(place);
    stepped_->path.curve()->begin_branch(number, state);
    state.step = state.n_points = state.n_bifurcations = 0;
    return state;
  }

  int
  PathRun::take_point(const PathPoint &point, PathMonitor &monitor)
  {
    const BranchChoice &choice = problem_.path.branches;
    const PathState    &state  = point.state;
    const SolvedState   solved(state, *stepped_);
    monitor.observe_point(point,
                          solved.shell(),
                          stepped_->system.with_ghosts(state.motion.a));
    if (state.branch != 0 || !point.is_bifurcation())
      return 0;
    if (choice.has_several())
      bifurcations_.emplace(state.n_bifurcations, state);
    const int changes_over = choice.change_over();
    if (std::abs(changes_over) != static_cast<int>(state.n_bifurcations))
      return 0;
    log_.progress() << "the path goes on along the branch that leaves this "
                       "point"
                    << std::endl;
    return changes_over > 0 ? 1 : -1;
  }

  bool
  PathRun::ends(const PathState &state, const QuantitiesOfInterest &quantities)
  {
    const PathParameters &path = problem_.path;
    std::string           why;
    if (!path.bounds.empty())
      {
        const SolvedState solved(state, *stepped_);
        why = reached_bound(path, quantities, state, solved.shell());
      }
    if (why.empty() && path.maximum_points > 0 &&
        state.n_points >= path.maximum_points)
      why = "the last of the 'Maximum points' has been found";
    if (why.empty() && state.branch == 0 && path.branches.has_several() &&
        !path.branches.has_primary() &&
        state.n_bifurcations >= path.branches.n_bifurcations())
      why = "the last bifurcation point asked for has been found";
    if (why.empty())
      return false;
    log_.progress() << "the path ends: " << why << std::endl;
    return true;
  }

  std::string
  PathRun::follow(PathState      &state,
                  PathMonitor    &monitor,
                  const Recorder &recorder)
  {
    const auto &quantities = recorder.quantities();
    bool        refines    = false;
    bool        grows      = false;

    PathCallbacks callbacks;
    callbacks.observe = [&](const PathState &step) {
      const SolvedState solved(step, *stepped_);
      warn_of_energy(step);
      monitor.observe(step, solved.shell());
    };
    callbacks.observe_point = [&](const PathPoint &point) {
      return take_point(point, monitor);
    };
    callbacks.tell = [&](const std::string &text) {
      log_.progress() << text << std::endl;
    };
    callbacks.pauses = [&](const PathState &step) {
      refines =
        n_refinements_ < adaptive_.n_cycles() && adaptive_.is_due(step.step);
      grows = false;
      if (watches_tips(step))
        {
          look_at_tips(step);
          grows = growth_.is_due(step.time);
          if (!grows || !seeks_critical_state())
            record_growth(step);
        }
      return refines || grows;
    };
    callbacks.ends = [&](const PathState &step) {
      return ends(step, quantities);
    };
    while (true)
      {
        std::string failure;
        refines = false;
        grows   = is_critical_;
        if (!is_critical_)
          failure = stepped_->path.run(state, callbacks);
        if (!refines && !grows)
          return failure;
        if (refines)
          refine(quantities, state);
        if (grows)
          failure = seeks_critical_state() ?
                      grow_along_curve(quantities, state) :
                      grow(quantities, state);
        // A restart tries the step of growth again, and adds the row then.
        if (failure.empty() || !is_critical_)
          callbacks.observe(state);
        if (!failure.empty() || callbacks.ends(state))
          return failure;
      }
  }

  void
  PathRun::refine(const QuantitiesOfInterest &quantities, PathState &state)
  {
    std::optional<PartTransfer>      transfer;
    std::optional<std::vector<bool>> marked;
    double                           estimated = 0.;
    {
      const SolvedState solved(state, *stepped_);
      const auto        estimate = adaptive_.estimate(solved.shell(), {});
      marked                     = adaptive_.mark(estimate, solved.shell());
      if (!marked)
        return;
      estimated = estimate.value;
      transfer.emplace(stepped_->shell.discretization(),
                       std::vector<const TrilinosWrappers::MPI::Vector *>{
                         &solved.shell().displacement,
                         solved.shell().velocity},
                       stepped_->shell.assembly().section_states().of_rules());
    }
    assembly_seconds_ += stepped_->system.assembly_seconds();
    auto mesh = stepped_->shell.release_mesh();
    stepped_.reset();
    transfer->refine(*mesh, *marked);
    stepped_ = std::make_unique<SteppedShell>(communicator_,
                                              problem_,
                                              quantities,
                                              std::move(mesh),
                                              log_);
    ++n_refinements_;
    const auto        &discretization = stepped_->shell.discretization();
    std::ostringstream text;
    text << std::setprecision(3) << "refined after step " << state.step
         << ": estimate " << estimated << " before, "
         << discretization.triangulation().n_global_active_cells() << " cells, "
         << discretization.n_dofs() << " dofs";
    log_.progress() << text.str() << std::endl;
    stepped_->shell.assembly().section_states().take(discretization, *transfer);
    state.motion.u              = transfer->field_on(discretization, 0);
    state.motion.v              = transfer->field_on(discretization, 1);
    state.motion.a              = stepped_->system.owned_vector();
    const unsigned int n_before = state.n_negative_pivots;
    const std::string  failure  = stepped_->path.settle(state);
    AssertThrow(failure.empty(),
                ExcMessage("Adaptive refinement/Cycles: the refined mesh has "
                           "no equilibrium close to that of the mesh before at "
                           "t = " +
                           std::to_string(state.time) + ": " + failure +
                           ". Begin with a finer mesh, 'Study/Refinements', or "
                           "refine less at a time, 'Adaptive "
                           "refinement/Fraction'."));
    if (state.n_negative_pivots != n_before)
      log_.progress() << "on the refined mesh the state has "
                      << state.n_negative_pivots
                      << " negative pivots instead of " << n_before
                      << ": it lies beyond a point there, which isn't listed"
                      << std::endl;
  }

  void
  PathRun::add_row(const PathState &state,
                   SolveRecord     &record,
                   Recorder        &recorder)
  {
    const SolvedState last(state, *stepped_);
    if (has_linear_kinematics(problem_))
      warn_of_large_displacements(stepped_->shell.discretization(),
                                  last.shell().displacement,
                                  log_);
    record.solver = stepped_->shell.solver().name();
    auto row      = recorder.make_row(last.shell(), record);
    if (adaptive_.is_on())
      adaptive_.add_to_row(last.shell(),
                           adaptive_.estimate(last.shell(), {}),
                           row);
    recorder.add(row, last.shell(), record);
  }

  std::optional<CheckpointData>
  PathRun::load_state(const DiscreteShell &shell,
                      const ProblemRecord &record,
                      const std::string   &base,
                      const bool           restart,
                      Checkpoint          &checkpoint) const
  {
    const PathParameters &path = problem_.path;
    warn_of_load_factor(*problem_.model.load_factor, record, log_);
    if (restart)
      return load_restart(path,
                          record,
                          shell.discretization(),
                          checkpoint,
                          log_);
    if (!path.start_from.empty())
      return load_start(path, record, shell.discretization(), base, log_);
    return {};
  }

  void
  PathRun::warn_of_energy(const PathState &state)
  {
    const double gain = state.balance.relative_gain();
    if (gain <= 0.01 || has_warned_of_energy_)
      return;
    has_warned_of_energy_ = true;
    std::ostringstream text;
    text << std::setprecision(2) << "Analysis/Scheme: at t = " << state.time
         << " the motion has gained " << 100. * gain
         << " % of its largest energy that nothing has put in; 10 % end the "
            "run. 'energy momentum' conserves energy, a smaller 'Time step' "
            "helps the other schemes.";
    log_.warning(text.str());
  }
} // namespace Nacre
