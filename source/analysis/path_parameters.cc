// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/path_parameters.h>
#include <nacre/base/text.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    double
    positive(const std::string &text,
             const std::string &name,
             const Constants   &constants)
    {
      const double value = evaluate_number(text, "Analysis/" + name, constants);
      AssertThrow(value > 0.,
                  ExcMessage("Analysis/" + name + ": '" + text +
                             "' is not positive."));
      return value;
    }
  } // namespace

  namespace
  {
    void
    check_arc_length(const PathParameters &path)
    {
      AssertThrow(path.output_times.empty(),
                  ExcMessage("Analysis/Output times: with Type = arc length "
                             "t isn't prescribed; leave them out."));
      AssertThrow(!path.keeps_tangent(),
                  ExcMessage("Analysis/Tangent updates: 'every step' doesn't "
                             "follow a path with arc length; choose 'every "
                             "iteration'."));
      AssertThrow(path.line_search != LineSearch::always,
                  ExcMessage("Analysis/Line search: 'always' has no meaning "
                             "with Type = arc length, whose load changes with "
                             "the iterations; choose 'automatic' or 'never'."));
      AssertThrow(path.newton.damping == 1.,
                  ExcMessage("Analysis/Damping of iterations: Type = arc "
                             "length takes whole increments; choose 1."));
    }
  } // namespace

  const Selection<AnalysisType> &
  selection(AnalysisType)
  {
    static const Selection<AnalysisType> table = {
      {AnalysisType::linear, "linear"},
      {AnalysisType::quasi_static, "static"},
      {AnalysisType::relaxation, "relaxation"},
      {AnalysisType::arc_length, "arc length"},
      {AnalysisType::dynamic, "dynamic"},
      {AnalysisType::buckling, "buckling"},
      {AnalysisType::vibration, "vibration"}};
    return table;
  }

  const Selection<LineSearch> &
  selection(LineSearch)
  {
    static const Selection<LineSearch> table = {{LineSearch::automatic,
                                                 "automatic"},
                                                {LineSearch::always, "always"},
                                                {LineSearch::never, "never"}};
    return table;
  }

  const Selection<TangentUpdates> &
  selection(TangentUpdates)
  {
    static const Selection<TangentUpdates> table = {
      {TangentUpdates::every_iteration, "every iteration"},
      {TangentUpdates::every_step, "every step"}};
    return table;
  }

  AnalysisParameters::AnalysisParameters()
    : ParameterAcceptor("/Analysis")
  {
    add_parameter("Type",
                  steps_.type,
                  "linear: one solve; static: equilibria along a load path, by "
                  "Newton's method; relaxation: the same, and by dynamic "
                  "relaxation where the path is unstable; arc length: along "
                  "the path, with a time that rises and falls; dynamic: motion "
                  "in time; buckling: load factors at which the linear state "
                  "loses its stability, with their modes; vibration: natural "
                  "frequencies and modes. static, relaxation, arc length and "
                  "dynamic take the kinematics of "
                  "'Discretization/Kinematics'.");
    add_parameter("Start from",
                  steps_.start_from,
                  "Another run's last checkpoint, 'output/NAME', whose "
                  "displacements, and in dynamics velocities, are the start of "
                  "this path at t = 0: on the same mesh, under any loads, "
                  "supports, section and Type. A relative name starts from the "
                  "current folder. Empty: the undeformed shell at rest.");
    add_parameter("Load factor",
                  load_factor_text_,
                  "Factor of all loads and prescribed values, an expression of "
                  "t; default: t, in dynamics 1. Units: none.");
    add_parameter("End time",
                  end_time_text_,
                  "The path is followed from t = 0 to here. Units: time (in "
                  "statics: none).");
    add_parameter(
      "Time step",
      time_step_text_,
      "Steps end at its multiples. A step that fails is halved; after two "
      "good ones it grows again, and the path is back on the multiples. "
      "Units: as End time.");
    add_parameter("Minimum time step",
                  minimum_time_step_text_,
                  "A step that would become smaller ends the run; default: "
                  "Time step/1000. Units: as End time.");
    add_parameter("Maximum time step",
                  maximum_time_step_text_,
                  "Steps that converge easily grow up to here, and leave "
                  "multiples of Time step out; default: Time step. Units: as "
                  "End time.");
    add_parameter("Maximum steps",
                  steps_.maximum_steps,
                  "An arc-length path ends after so many steps if it hasn't "
                  "reached the End time.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Switch branch",
                  steps_.switch_branch,
                  "k: at the k-th bifurcation point since its start or restart "
                  "an arc-length path goes on along the branch that leaves "
                  "there, in the direction of the mode whose largest "
                  "displacement is along +x, +y or +z; -k: the other way; 0: "
                  "it stays on its branch.");
    add_parameter("Output times",
                  output_times_text_,
                  "'t1, t2, ...': steps end at these times, too, exactly, and "
                  "the fields are written, if the study writes VTU; in statics "
                  "with the default Load factor these are load levels. Units: "
                  "as End time.");
    add_parameter("Maximum iterations",
                  steps_.newton.max_iterations,
                  "Newton iterations of a step.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Increment tolerance",
                  steps_.newton.increment_tolerance,
                  "An iteration that changes no displacement by more than this "
                  "times the largest change of the step ends the step. A "
                  "residual would be no measure: round-off drowns it.",
                  prm,
                  Patterns::Double(1e-14, 1e-2));
    add_parameter("Energy tolerance",
                  steps_.newton.energy_tolerance,
                  "So does one with less work of the residual than this times "
                  "the step's largest.",
                  prm,
                  Patterns::Double(0., 1e-4));
    add_parameter("Damping of iterations",
                  steps_.newton.damping,
                  "Factor of the increments, for Tangent = frozen.",
                  prm,
                  Patterns::Double(0.01, 1.));
    add_parameter("Tangent updates",
                  steps_.tangent_updates,
                  "every iteration: Newton's method; every step: the factors "
                  "of the first iteration serve the whole step, which takes "
                  "more, but cheaper iterations, and tells the stability at "
                  "its start only. Dynamic relaxation updates always.");
    add_parameter("Line search",
                  steps_.line_search,
                  "automatic: when a step failed without it.");
    add_parameter("Scheme",
                  steps_.scheme,
                  "energy momentum: conserves energy, momentum and angular "
                  "momentum with any step; newmark: the trapezoidal rule; "
                  "generalised alpha, with the spectral radius below; implicit "
                  "midpoint; implicit euler, of first order, as graphics codes "
                  "use. All but the first may gain energy in large rotations.");
    add_parameter("Spectral radius",
                  steps_.spectral_radius,
                  "Of generalised alpha at high frequencies: 1 keeps them, 0 "
                  "damps them out in a step.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Mass damping",
                  steps_.mass_damping,
                  "Force per mass and velocity. Units: 1/time.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Initial displacement",
                  initial_displacement_text_,
                  "In dynamics, along x, y, z, expressions of x, y, z; added "
                  "to the displacement of Start from. Units: length.");
    add_parameter("Initial velocity",
                  initial_velocity_text_,
                  "In dynamics, along x, y, z, expressions of x, y, z; added "
                  "to the velocity of Start from. Units: length/time.");
    add_parameter("VTU steps",
                  steps_.vtu_steps,
                  "Write the fields every so many steps, if the study writes "
                  "VTU; 0: of the last one and of the Output times only.");
    add_parameter("Checkpoint steps",
                  steps_.checkpoint_steps,
                  "Save the state every so many steps, for 'nacre FILE "
                  "--restart'; 0: never.");
  }

  PathParameters
  AnalysisParameters::make(const Constants &constants) const
  {
    PathParameters path;
    static_cast<StepParameters &>(path) = steps_;
    read_times(constants, path);
    read_start(constants, path);
    if (path.type == AnalysisType::arc_length)
      check_arc_length(path);
    else
      AssertThrow(path.switch_branch == 0,
                  ExcMessage(
                    "Analysis/Switch branch: Type = " + name_of(path.type) +
                    " finds no branches; choose 'arc length', or 0."));
    return path;
  }

  Expression
  AnalysisParameters::load_factor(const Constants &constants) const
  {
    const bool is_default = (load_factor_text_ == "default");
    return Expression(!is_default ? load_factor_text_ :
                      steps_.is_linear() || steps_.is_dynamic() ? "1" :
                                                                  "t",
                      "Analysis/Load factor",
                      constants,
                      "x,y,z,t");
  }

  void
  AnalysisParameters::read_times(const Constants &constants,
                                 PathParameters  &path) const
  {
    path.end_time  = positive(end_time_text_, "End time", constants);
    path.time_step = positive(time_step_text_, "Time step", constants);
    path.minimum_time_step =
      minimum_time_step_text_ == "default" ?
        1e-3 * path.time_step :
        positive(minimum_time_step_text_, "Minimum time step", constants);
    path.maximum_time_step =
      maximum_time_step_text_ == "default" ?
        path.time_step :
        positive(maximum_time_step_text_, "Maximum time step", constants);
    AssertThrow(path.minimum_time_step <= path.time_step,
                ExcMessage("Analysis/Minimum time step: '" +
                           minimum_time_step_text_ +
                           "' is larger than the time step."));
    AssertThrow(path.maximum_time_step >= path.time_step,
                ExcMessage("Analysis/Maximum time step: '" +
                           maximum_time_step_text_ +
                           "' is smaller than the time step."));
    for (const auto &text :
         Text::split(output_times_text_, ',', "Analysis/Output times"))
      {
        path.output_times.push_back(positive(text, "Output times", constants));
        AssertThrow(path.output_times.back() <= path.end_time,
                    ExcMessage("Analysis/Output times: '" + text +
                               "' is later than the End time '" +
                               end_time_text_ + "'."));
      }
  }

  void
  AnalysisParameters::read_start(const Constants &constants,
                                 PathParameters  &path) const
  {
    path.initial_displacement =
      VectorExpression(initial_displacement_text_,
                       "Analysis/Initial displacement",
                       constants);
    path.initial_velocity = VectorExpression(initial_velocity_text_,
                                             "Analysis/Initial velocity",
                                             constants);
    const std::pair<const char *, const VectorExpression *> motions[] = {
      {"Initial displacement", &path.initial_displacement},
      {"Initial velocity", &path.initial_velocity}};
    for (const auto &[name, motion] : motions)
      AssertThrow(path.is_dynamic() || motion->is_zero(),
                  ExcMessage(std::string("Analysis/") + name +
                             ": Type = " + name_of(path.type) +
                             " doesn't use it; choose 'Type = dynamic', or "
                             "leave it out."));
    path.start_from = Text::trim(path.start_from);
    AssertThrow((!path.is_linear() && !seeks_modes(path.type)) ||
                  path.start_from.empty(),
                ExcMessage("Analysis/Start from: Type = " + name_of(path.type) +
                           " solves from the undeformed shell; choose another "
                           "Type."));
  }
} // namespace Nacre
