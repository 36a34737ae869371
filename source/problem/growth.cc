// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/growth.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    const std::string tips_parameter      = "Growth/Tips";
    const std::string toughness_parameter = "Growth/Toughness";
    const std::string direction_parameter = "Growth/Direction";
    const std::string step_parameter      = "Growth/Step";
    const std::string length_parameter    = "Growth/Length";
    const std::string release_parameter   = "Growth/Release time";

    double
    positive_number(const std::string &text,
                    const std::string &where,
                    const Constants   &constants)
    {
      const double value = evaluate_number(text, where, constants);
      AssertThrow(value > 0.,
                  ExcMessage(where + ": '" + text + "' is not positive."));
      return value;
    }

    /** Take @p word from the end of @p text, if it stands there. */
    bool
    take_last_word(std::string &text, const std::string &word)
    {
      if (text.size() <= word.size() ||
          text.compare(text.size() - word.size(), word.size(), word) != 0 ||
          text[text.size() - word.size() - 1] != ' ')
        return false;
      text = Text::trim(text.substr(0, text.size() - word.size()));
      return true;
    }

    Growth::Tip
    read_tip(const std::string &text, const Cuts &cuts)
    {
      const std::string where  = tips_parameter + ", '" + text + "'";
      std::string       name   = text;
      const bool        at_end = take_last_word(name, "end");
      AssertThrow(at_end || take_last_word(name, "begin"),
                  ExcMessage(where + ": write 'CUT begin' or 'CUT end', the "
                                     "cut's first or last point."));
      name = Text::unquoted(name);
      std::vector<std::string> names;
      for (const CutCurve &curve : cuts.curves)
        names.push_back(curve.name);
      const auto found = std::find(names.begin(), names.end(), name);
      AssertThrow(found != names.end(),
                  ExcMessage(Text::unknown_name(where, "cut", name, names)));
      const unsigned int cut = found - names.begin();
      AssertThrow(!cuts.curves[cut].is_closed,
                  ExcMessage(where + ": the cut '" + name +
                             "' is closed and has no ends; only open cuts "
                             "grow."));
      return {cut, at_end};
    }
  } // namespace

  const Selection<GrowthCriterion> &
  selection(GrowthCriterion)
  {
    static const Selection<GrowthCriterion> table = {
      {GrowthCriterion::energy_release_rate, "energy release rate"},
      {GrowthCriterion::prescribed, "prescribed"}};
    return table;
  }

  std::string
  in_words(const Growth::Tip &tip, const Cuts &cuts)
  {
    return cuts.curves[tip.cut].name + (tip.at_end ? " end" : " begin");
  }

  GrowthParameters::GrowthParameters()
    : ParameterAcceptor("/Growth")
  {
    add_parameter("Tips",
                  tips_text_,
                  "Ends of cuts that grow: 'CUT end, CUT begin, ...', the last "
                  "and the first point of a cut of 'Cuts/Cuts' inside the "
                  "surface; or none.");
    add_parameter("Criterion",
                  criterion_,
                  "energy release rate: a tip advances when its G reaches the "
                  "toughness times the thickness; in a linear analysis the "
                  "loads take the factor at which the first one does. "
                  "prescribed: along a path as 'Length' says, in a linear "
                  "analysis by a step in each solve.");
    add_parameter("Toughness",
                  toughness_text_,
                  "G_c, energy per area of new crack, for the criterion energy "
                  "release rate. Units: force/length.");
    add_parameter("Tolerance",
                  tolerance_,
                  "Tips whose G is below the largest by no more than this part "
                  "of it advance together with that tip: a step is finite, and "
                  "meshes aren't symmetric. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Direction",
                  direction_text_,
                  "hoop stress: perpendicular to the largest tension around "
                  "the tip, over the faces and the middle of the shell, in "
                  "linear kinematics; straight: as the cut ends; or a vector "
                  "'dx, dy, dz', expressions of x, y, z and t, of which the "
                  "part along the surface counts. default: hoop stress for the "
                  "criterion energy release rate in linear kinematics, else "
                  "straight. Units of the vector: none.");
    add_parameter("Step",
                  step_text_,
                  "How far a tip advances at once: 'N cells', in edges of the "
                  "cells at the tip, or a length. G is that of a ring around "
                  "the tip of this size. Units: length.");
    add_parameter("Length",
                  length_text_,
                  "Along a path with the criterion prescribed: the length by "
                  "which each tip has advanced at the time t, an expression "
                  "of t, in whole steps. Units: length.");
    add_parameter("Release time",
                  release_text_,
                  "In dynamics: the time in which the forces between the lips "
                  "of a step's new cut fall to zero, whose work the fracture "
                  "takes; a time step at least. 0: they vanish at once, and "
                  "the energy goes into vibration. default: the time that a "
                  "Rayleigh wave takes for the step. No tip advances as long "
                  "as lips are being released. Units: time.");
    add_parameter("Maximum steps",
                  maximum_steps_,
                  "Steps of growth in all, after which the cuts stay as they "
                  "are. Units: none.",
                  prm,
                  Patterns::Integer(1, 10000));
  }

  Growth
  GrowthParameters::make(const Constants &constants,
                         const Cuts      &cuts,
                         const bool       is_path,
                         const bool       has_intensities) const
  {
    Growth growth;
    read_tips(cuts, growth);
    if (!growth.is_on())
      {
        AssertThrow(Text::trim(toughness_text_ + length_text_).empty(),
                    ExcMessage(tips_parameter +
                               ": none, but 'Toughness' or 'Length' is given; "
                               "name the tips that grow, 'CUT end', or leave "
                               "these out."));
        return growth;
      }
    growth.criterion     = criterion_;
    growth.tolerance     = tolerance_;
    growth.maximum_steps = maximum_steps_;
    read_criterion(constants, is_path, growth);
    read_direction(constants, has_intensities, growth);
    read_step(constants, growth);
    read_release(constants, growth);
    return growth;
  }

  void
  GrowthParameters::read_tips(const Cuts &cuts, Growth &growth) const
  {
    if (Text::trim(tips_text_) == "none")
      return;
    AssertThrow(!cuts.is_empty(),
                ExcMessage(tips_parameter + ": found '" + tips_text_ +
                           "', but 'Cuts/Cuts' is empty; only cuts grow."));
    for (const auto &text : Text::split(tips_text_, ',', tips_parameter))
      {
        const Growth::Tip tip = read_tip(text, cuts);
        AssertThrow(std::none_of(growth.tips.begin(),
                                 growth.tips.end(),
                                 [&](const Growth::Tip &other) {
                                   return other.cut == tip.cut &&
                                          other.at_end == tip.at_end;
                                 }),
                    ExcMessage(tips_parameter + ": '" + text +
                               "' is listed twice; leave one out."));
        growth.tips.push_back(tip);
      }
  }

  void
  GrowthParameters::read_criterion(const Constants &constants,
                                   const bool       is_path,
                                   Growth          &growth) const
  {
    const std::string criterion =
      "'Growth/Criterion = " + name_of(criterion_) + "'";
    const bool has_toughness = !Text::trim(toughness_text_).empty();
    const bool has_length    = !Text::trim(length_text_).empty();
    AssertThrow(growth.is_prescribed() || has_toughness,
                ExcMessage(toughness_parameter + ": " + criterion +
                           " needs it; give G_c, the energy per area of new "
                           "crack."));
    AssertThrow(!growth.is_prescribed() || !has_toughness,
                ExcMessage(toughness_parameter + ": " + criterion +
                           " doesn't use it; leave it out."));
    const bool needs_length = growth.is_prescribed() && is_path;
    AssertThrow(!needs_length || has_length,
                ExcMessage(length_parameter + ": " + criterion +
                           " needs it along a path; give the length by which "
                           "tips have advanced at t, such as '0.1*t'."));
    AssertThrow(needs_length || !has_length,
                ExcMessage(length_parameter + ": " + criterion +
                           (is_path ? "" : " in a linear analysis") +
                           " doesn't use it; leave it out."));
    if (has_toughness)
      growth.toughness =
        positive_number(toughness_text_, toughness_parameter, constants);
    if (has_length)
      growth.length =
        Expression(length_text_, length_parameter, constants, "x,y,z,t");
  }

  void
  GrowthParameters::read_direction(const Constants &constants,
                                   const bool       has_intensities,
                                   Growth          &growth) const
  {
    const std::string text = Text::trim(direction_text_);
    if (text == "default")
      growth.direction = has_intensities && !growth.is_prescribed() ?
                           GrowthDirection::hoop_stress :
                           GrowthDirection::straight;
    else if (text == "hoop stress")
      growth.direction = GrowthDirection::hoop_stress;
    else if (text == "straight")
      growth.direction = GrowthDirection::straight;
    else
      {
        AssertThrow(Text::split(text, ',', direction_parameter).size() == 3,
                    ExcMessage(direction_parameter + ": found '" + text +
                               "'; 'default', 'hoop stress', 'straight' or "
                               "three expressions, 'dx, dy, dz', are "
                               "allowed."));
        growth.direction = GrowthDirection::expression;
        growth.along =
          VectorExpression(text, direction_parameter, constants, "x,y,z,t");
      }
    AssertThrow(growth.direction != GrowthDirection::hoop_stress ||
                  has_intensities,
                ExcMessage(direction_parameter +
                           ": 'hoop stress' needs stress intensities, which "
                           "'Discretization/Kinematics = linear' has only; "
                           "choose 'straight' or a vector 'dx, dy, dz'."));
  }

  void
  GrowthParameters::read_step(const Constants &constants, Growth &growth) const
  {
    std::string text        = Text::trim(step_text_);
    growth.step_is_in_cells = take_last_word(text, "cells");
    growth.step             = positive_number(text, step_parameter, constants);
    AssertThrow(!growth.step_is_in_cells || growth.step >= 1.,
                ExcMessage(step_parameter + ": found '" + step_text_ +
                           "'; a tip advances by a cell at least, '1 cells'."));
  }

  void
  GrowthParameters::read_release(const Constants &constants,
                                 Growth          &growth) const
  {
    const std::string text = Text::trim(release_text_);
    if (text == "default")
      return;
    const double time = evaluate_number(text, release_parameter, constants);
    AssertThrow(time >= 0.,
                ExcMessage(release_parameter + ": '" + text +
                           "' is negative; give a time, 0 for lips that are "
                           "free at once, or 'default'."));
    growth.release_time = time;
  }
} // namespace Nacre
