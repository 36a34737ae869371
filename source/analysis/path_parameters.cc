// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/path_parameters.h>
#include <nacre/base/number_range.h>
#include <nacre/base/text.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    double
    positive(const std::string &text,
             const std::string &name,
             const Constants   &constants)
    {
      return positive_number(text, "Analysis/" + name, constants);
    }

    /** Of a path along which t rises and falls. */
    double
    nonzero(const std::string &text,
            const std::string &name,
            const Constants   &constants)
    {
      const double value = evaluate_number(text, "Analysis/" + name, constants);
      AssertThrow(value != 0.,
                  ExcMessage("Analysis/" + name + ": '" + text +
                             "' is zero; give a number other than that."));
      return value;
    }
  } // namespace

  namespace
  {
    void
    check_arc_length(const PathParameters &path)
    {
      const std::string type = "Type = " + name_of(path.type);
      AssertThrow(path.output_times.empty(),
                  ExcMessage("Analysis/Output times: with " + type +
                             " t isn't prescribed; leave them out."));
      AssertThrow(!path.keeps_tangent(),
                  ExcMessage("Analysis/Tangent updates: 'every step' doesn't "
                             "follow a path with " +
                             type + "; choose 'every iteration'."));
      AssertThrow(path.line_search != LineSearch::always,
                  ExcMessage("Analysis/Line search: 'always' has no meaning "
                             "with " +
                             type +
                             ", whose load changes with the iterations; "
                             "choose 'automatic' or 'never'."));
      AssertThrow(path.newton.damping == 1.,
                  ExcMessage("Analysis/Damping of iterations: " + type +
                             " takes whole increments; choose 1."));
    }

    const std::string branch_form =
      "write 'none', 'all', or numbers such as '0, 1, -1'";

    BranchChoice
    read_branches(const std::string &text)
    {
      const std::string where = "Analysis/Switch branch";
      BranchChoice      choice;
      choice.all = Text::trim(text) == "all";
      if (choice.all || Text::trim(text) == "none")
        return choice;
      for (const auto &item : Text::split(text, ',', where))
        {
          std::size_t n_read = 0;
          int         number = 0;
          try
            {
              number = std::stoi(item, &n_read);
            }
          catch (const std::exception &)
            {
              n_read = 0;
            }
          AssertThrow(n_read > 0 && n_read == item.size(),
                      ExcMessage(where + ": '" + item + "' is no number; " +
                                 branch_form + "."));
          AssertThrow(std::count(choice.numbers.begin(),
                                 choice.numbers.end(),
                                 number) == 0,
                      ExcMessage(where + ": '" + item +
                                 "' is listed twice; leave one out."));
          choice.numbers.push_back(number);
        }
      // The primary path is followed first.
      std::stable_partition(choice.numbers.begin(),
                            choice.numbers.end(),
                            [](const int number) { return number == 0; });
      return choice;
    }

    std::vector<PathBound>
    read_bounds(const std::string &text, const Constants &constants)
    {
      const std::string      where = "Analysis/Stop where";
      std::vector<PathBound> bounds;
      for (const auto &item : Text::split(text, ',', where))
        {
          const auto sign = item.find_first_of("<>");
          AssertThrow(sign != std::string::npos && sign > 0 &&
                        sign + 1 < item.size() && item[sign + 1] != '=',
                      ExcMessage(where + ": '" + item +
                                 "' is not of the form 'QUANTITY < NUMBER' or "
                                 "'QUANTITY > NUMBER'."));
          bounds.push_back(
            {Text::unquoted(item.substr(0, sign)),
             item[sign] == '<',
             evaluate_number(item.substr(sign + 1), where, constants)});
        }
      return bounds;
    }
  } // namespace

  bool
  BranchChoice::has_primary() const
  {
    return all || numbers.empty() ||
           std::count(numbers.begin(), numbers.end(), 0) > 0;
  }

  unsigned int
  BranchChoice::n_bifurcations() const
  {
    int largest = 0;
    for (const int number : numbers)
      largest = std::max(largest, std::abs(number));
    return largest;
  }

  std::vector<int>
  BranchChoice::branches(const unsigned int n_found) const
  {
    const int        n = static_cast<int>(n_found);
    std::vector<int> result;
    if (all)
      for (int number = 1; number <= n; ++number)
        result.insert(result.end(), {number, -number});
    for (const int number : numbers)
      if (number != 0 && std::abs(number) <= n)
        result.push_back(number);
    return result;
  }

  std::string
  PathBound::text() const
  {
    std::ostringstream text;
    text << quantity << (is_below ? " < " : " > ") << value;
    return text.str();
  }

  const Selection<AnalysisType> &
  selection(AnalysisType)
  {
    static const Selection<AnalysisType> table = {
      {AnalysisType::linear, "linear"},
      {AnalysisType::quasi_static, "static"},
      {AnalysisType::relaxation, "relaxation"},
      {AnalysisType::arc_length, "arc length"},
      {AnalysisType::displacement_control, "displacement control"},
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
                  "the path, with a time that rises and falls; displacement "
                  "control: the same, by steps of 'Control'; dynamic: motion "
                  "in time; buckling: load factors at which the linear state "
                  "loses its stability, with their modes; vibration: natural "
                  "frequencies and modes. static, relaxation, arc length, "
                  "displacement control and dynamic take the kinematics of "
                  "'Discretization/Kinematics'.");
    add_parameter("Start from",
                  steps_.start_from,
                  "Another run's last checkpoint, 'output/NAME', whose "
                  "displacements, and in dynamics velocities, are the start of "
                  "this path at t = 0: on the same mesh, under any loads, "
                  "supports, section and Type. Buckling and vibration are "
                  "those of that state, under the loads at its t. A relative "
                  "name starts from the "
                  "current folder. Empty: the undeformed shell at rest.");
    add_parameter("Load factor",
                  load_factor_text_,
                  "Factor of all loads and prescribed values, an expression of "
                  "t; default: t, in dynamics 1. Units: none.");
    add_parameter("End time",
                  end_time_text_,
                  "The path is followed from t = 0 to here; with arc length it "
                  "may be negative, and displacement control doesn't use it. "
                  "Units: time (in statics: none).");
    add_parameter(
      "Time step",
      time_step_text_,
      "Steps end at its multiples. A step that fails is halved; after two "
      "good ones it grows again, and the path is back on the multiples. With "
      "arc length the first step's change of t; a negative one begins "
      "downward. Units: as End time.");
    add_parameter("Minimum time step",
                  minimum_time_step_text_,
                  "A step that would become smaller ends the run; default: "
                  "Time step/1000. Units: as End time.");
    add_parameter("Maximum time step",
                  maximum_time_step_text_,
                  "Steps that converge easily grow up to here, and leave "
                  "multiples of Time step out; default: Time step. Units: as "
                  "End time.");
    declare_curve();
    add_parameter("Output times",
                  output_times_text_,
                  "'t1, t2, ...': steps end at these times, too, exactly, and "
                  "the fields are written, if the study writes VTU; in statics "
                  "with the default Load factor these are load levels. Units: "
                  "as End time.");
    declare_iterations();
    declare_motion();
    add_parameter("VTU steps",
                  steps_.vtu_steps,
                  "Write the fields every so many steps, if the study writes "
                  "VTU; 0: of the last one and of the Output times only.");
    add_parameter("Checkpoint steps",
                  steps_.checkpoint_steps,
                  "Save the state every so many steps, for 'nacre FILE "
                  "--restart'; 0: never.");
  }

  void
  AnalysisParameters::declare_iterations()
  {
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
  }

  void
  AnalysisParameters::declare_motion()
  {
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
                  mass_damping_text_,
                  "Force per mass and velocity. Units: 1/time.");
    add_parameter("Initial displacement",
                  initial_displacement_text_,
                  "In dynamics, along x, y, z, expressions of x, y, z; added "
                  "to the displacement of Start from. Units: length.");
    add_parameter("Initial velocity",
                  initial_velocity_text_,
                  "In dynamics, along x, y, z, expressions of x, y, z; added "
                  "to the velocity of Start from. Units: length/time.");
  }

  void
  AnalysisParameters::declare_curve()
  {
    add_parameter("Maximum steps",
                  steps_.maximum_steps,
                  "A path with arc length or displacement control ends after "
                  "so many steps if it hasn't reached its end.",
                  prm,
                  Patterns::Integer(1));
    add_parameter("Maximum points",
                  steps_.maximum_points,
                  "It ends after so many limit and bifurcation points, each "
                  "branch after so many of its own; 0: any number.",
                  prm,
                  Patterns::Integer(0));
    add_parameter(
      "Stop where",
      stop_where_text_,
      "'NAME < NUMBER, NAME > NUMBER, ...': a path of any Type ends "
      "after the first step in which one of these holds of the "
      "quantity NAME of 'Quantities', the 'load factor' or 't'. "
      "Units: those of the quantity.");
    add_parameter(
      "Switch branch",
      switch_branch_text_,
      "Branches of a path with arc length or displacement control. "
      "none: it stays on the primary path. k: at the k-th "
      "bifurcation point it goes on along the branch that leaves "
      "there, in the direction of the mode whose largest "
      "displacement is along +x, +y or +z; -k: the other way. all, "
      "or several numbers, 'k, -k, ...': each branch is a path with "
      "files of its own, NAME_branchK; 0: the primary path is "
      "followed to its end, too.");
    add_parameter(
      "Control",
      control_text_,
      "With displacement control: the name of the quantity that is "
      "prescribed in steps: whatever a displacement makes, as all results at "
      "a point, a reaction or the opening of a cut.");
    add_parameter(
      "Control values",
      control_values_text_,
      "'q1, q2, ...': the quantity goes from its value at the start "
      "to q1, then to q2, ..., where the path ends. Units: those of "
      "Control.");
    add_parameter("Control step",
                  control_step_text_,
                  "Size of its steps; they are halved and grow between the "
                  "same multiples of it as 'Minimum' and 'Maximum time step' "
                  "are of 'Time step'; default: a tenth of the largest of the "
                  "Control values. Units: those of Control.");
  }

  PathParameters
  AnalysisParameters::make(const Constants &constants) const
  {
    PathParameters path;
    static_cast<StepParameters &>(path) = steps_;
    path.mass_damping                   = nonnegative_number(mass_damping_text_,
                                           "Analysis/Mass damping",
                                           constants);
    read_times(constants, path);
    read_start(constants, path);
    read_curve(constants, path);
    if (path.follows_curve())
      check_arc_length(path);
    return path;
  }

  void
  AnalysisParameters::read_curve(const Constants &constants,
                                 PathParameters  &path) const
  {
    path.bounds   = read_bounds(stop_where_text_, constants);
    path.branches = read_branches(switch_branch_text_);
    path.control  = Text::unquoted(control_text_);
    for (const auto &text :
         Text::split(control_values_text_, ',', "Analysis/Control values"))
      path.control_values.push_back(
        evaluate_number(text, "Analysis/Control values", constants));
    check_use(path);
    if (!path.controls_displacement())
      return;
    double largest = 0.;
    for (const double value : path.control_values)
      largest = std::max(largest, std::abs(value));
    path.control_step =
      control_step_text_ != "default" ?
        positive(control_step_text_, "Control step", constants) :
        0.1 * largest;
    AssertThrow(path.control_step > 0.,
                ExcMessage("Analysis/Control step: the Control values are all "
                           "0; give the size of the steps."));
  }

  void
  AnalysisParameters::check_use(const PathParameters &path) const
  {
    const std::string type = "Type = " + name_of(path.type);
    AssertThrow(path.follows_curve() ||
                  (path.branches.numbers.empty() && !path.branches.all),
                ExcMessage("Analysis/Switch branch: " + type +
                           " finds no branches; choose 'arc length' or "
                           "'displacement control', or none."));
    AssertThrow(path.follows_curve() || path.maximum_points == 0,
                ExcMessage("Analysis/Maximum points: " + type +
                           " finds no points; choose 'arc length' or "
                           "'displacement control', or 0."));
    AssertThrow(path.bounds.empty() ||
                  (!path.is_linear() && !seeks_modes(path.type)),
                ExcMessage("Analysis/Stop where: " + type +
                           " follows no path; leave it out."));
    const bool has_control = !path.control.empty() ||
                             !path.control_values.empty() ||
                             control_step_text_ != "default";
    AssertThrow(path.controls_displacement() || !has_control,
                ExcMessage(
                  "Analysis/Control, Control values, Control step: " + type +
                  " controls no quantity; choose 'displacement "
                  "control', or leave them out."));
    AssertThrow(!path.controls_displacement() ||
                  (!path.control.empty() && !path.control_values.empty()),
                ExcMessage("Analysis/Control: " + type +
                           " needs the name of a quantity, and 'Control "
                           "values' to go to, such as '-30'."));
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
    const bool is_curve = path.follows_curve();
    path.end_time  = is_curve ? nonzero(end_time_text_, "End time", constants) :
                                positive(end_time_text_, "End time", constants);
    path.time_step = is_curve ?
                       nonzero(time_step_text_, "Time step", constants) :
                       positive(time_step_text_, "Time step", constants);
    path.begins_downward = path.time_step < 0.;
    path.time_step       = std::abs(path.time_step);
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
    AssertThrow(!path.is_linear() || path.start_from.empty(),
                ExcMessage("Analysis/Start from: Type = " + name_of(path.type) +
                           " solves from the undeformed shell; choose another "
                           "Type."));
  }
} // namespace Nacre
