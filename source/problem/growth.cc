// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/number_range.h>
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
    const std::string strength_parameter  = "Growth/Strength";
    const std::string distance_parameter  = "Growth/Averaging distance";
    const std::string starting_parameter  = "Growth/Starting cracks";

    CellLength
    read_cell_length(const std::string &original,
                     const std::string &where,
                     const Constants   &constants)
    {
      std::string text     = Text::trim(original);
      const bool  in_cells = Text::take_last_word(text, "cells");
      return {positive_number(text, where, constants), in_cells};
    }

    /** What a criterion says of a parameter of its own or of another one. */
    struct CriterionUse
    {
      std::string parameter;
      bool        is_given;
      bool        is_used;
      /** What to give; empty: it may be left out. */
      std::string advice;
    };

    Growth::Tip
    read_tip(const std::string &text, const Cuts &cuts)
    {
      const std::string where  = tips_parameter + ", '" + text + "'";
      std::string       name   = text;
      const bool        at_end = Text::take_last_word(name, "end");
      AssertThrow(at_end || Text::take_last_word(name, "begin"),
                  ExcMessage(where + ": write 'CUT begin' or 'CUT end', the "
                                     "cut's first or last point."));
      const unsigned int cut = find_cut(Text::unquoted(name), cuts, where);
      AssertThrow(!cuts.curves[cut].is_closed,
                  ExcMessage(where + ": the cut '" + cuts.curves[cut].name +
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
      {GrowthCriterion::strength, "strength"},
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
                  "strength: the same when the tension ahead, averaged over "
                  "'Averaging distance', at the faces or in the middle of the "
                  "shell, reaches 'Strength'. "
                  "prescribed: along a path as 'Length' says, in a linear "
                  "analysis by a step in each solve.");
    add_parameter("Toughness",
                  toughness_text_,
                  "G_c, energy per area of new crack, for the criterion energy "
                  "release rate. Units: force/length.");
    add_parameter("Strength",
                  strength_text_,
                  "The stress at which the material parts, for the criterion "
                  "strength. Units: force/length^2.");
    add_parameter("Averaging distance",
                  distance_text_,
                  "Over which the criterion strength takes the mean of the "
                  "stress: a length, or 'N cells', in edges of the cells "
                  "there. A long crack grows at the energy release rate G_c "
                  "if it is 2 E G_c/(pi Strength^2). Units: length.");
    add_parameter("Starting cracks",
                  starting_,
                  "How many cracks may start, at most, where the criterion "
                  "strength is met away from tips: perpendicular to the "
                  "largest tension, from an edge inwards or by a step to "
                  "both sides. Units: none.",
                  prm,
                  Patterns::Integer(0, 1000));
    add_parameter("Tolerance",
                  tolerance_,
                  "Tips whose G, or stress, is below the largest by no more "
                  "than this part of it advance together with that tip: a "
                  "step is finite, and meshes aren't symmetric. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Direction",
                  direction_text_,
                  "hoop stress: perpendicular to the largest tension around "
                  "the tip, over the faces and the middle of the shell; "
                  "straight: as the cut ends; or a vector "
                  "'dx, dy, dz', expressions of x, y, z and t, of which the "
                  "part along the surface counts. default: hoop stress for the "
                  "criteria strength and, in linear kinematics of linear "
                  "sections, energy release rate, else straight. Units of the "
                  "vector: none.");
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
                         const bool       is_linear) const
  {
    Growth growth;
    growth.starting_cracks = starting_;
    read_tips(cuts, growth);
    if (!growth.is_on())
      {
        for (const auto &[parameter, text] :
             {std::make_pair("Toughness", toughness_text_),
              std::make_pair("Length", length_text_),
              std::make_pair("Strength", strength_text_),
              std::make_pair("Averaging distance", distance_text_)})
          AssertThrow(Text::trim(text).empty(),
                      ExcMessage(tips_parameter + ": none, but '" + parameter +
                                 "' is given; name the tips that grow, 'CUT "
                                 "end', or leave it out."));
        return growth;
      }
    growth.criterion     = criterion_;
    growth.tolerance     = tolerance_;
    growth.maximum_steps = maximum_steps_;
    check_uses(is_path);
    read_criterion(constants, growth);
    read_direction(constants, is_linear, growth);
    growth.step = read_cell_length(step_text_, step_parameter, constants);
    AssertThrow(!growth.step.is_in_cells || growth.step.value >= 1.,
                ExcMessage(step_parameter + ": found '" + step_text_ +
                           "'; a tip advances by a cell at least, '1 cells'."));
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
  GrowthParameters::check_uses(const bool is_path) const
  {
    const std::string criterion =
      "'Growth/Criterion = " + name_of(criterion_) + "'";
    const auto is_given = [](const std::string &text) {
      return !Text::trim(text).empty();
    };
    const bool by_energy   = criterion_ == GrowthCriterion::energy_release_rate;
    const bool by_strength = criterion_ == GrowthCriterion::strength;
    const bool has_length =
      criterion_ == GrowthCriterion::prescribed && is_path;
    for (const CriterionUse &use :
         {CriterionUse{toughness_parameter,
                       is_given(toughness_text_),
                       by_energy,
                       "give G_c, the energy per area of new crack."},
          CriterionUse{strength_parameter,
                       is_given(strength_text_),
                       by_strength,
                       "give the stress at which the material parts."},
          CriterionUse{distance_parameter,
                       is_given(distance_text_),
                       by_strength,
                       "give the length over which the stress is averaged, "
                       "or '2 cells'."},
          CriterionUse{starting_parameter, starting_ > 0, by_strength, ""},
          CriterionUse{length_parameter,
                       is_given(length_text_),
                       has_length,
                       "along a path give the length by which tips have "
                       "advanced at t, such as '0.1*t'."}})
      {
        AssertThrow(!use.is_used || use.is_given || use.advice.empty(),
                    ExcMessage(use.parameter + ": " + criterion +
                               " needs it; " + use.advice));
        const bool by_analysis = use.parameter == length_parameter &&
                                 criterion_ == GrowthCriterion::prescribed;
        AssertThrow(use.is_used || !use.is_given,
                    ExcMessage(use.parameter + ": " + criterion +
                               (by_analysis ? " in a linear analysis" : "") +
                               " doesn't use it; leave it out."));
      }
  }

  void
  GrowthParameters::read_criterion(const Constants &constants,
                                   Growth          &growth) const
  {
    if (growth.is_by_energy())
      growth.toughness =
        positive_number(toughness_text_, toughness_parameter, constants);
    if (growth.is_by_strength())
      {
        growth.strength =
          positive_number(strength_text_, strength_parameter, constants);
        growth.averaging_distance =
          read_cell_length(distance_text_, distance_parameter, constants);
      }
    if (!Text::trim(length_text_).empty())
      growth.length =
        Expression(length_text_, length_parameter, constants, "x,y,z,t");
  }

  void
  GrowthParameters::read_direction(const Constants &constants,
                                   const bool       is_linear,
                                   Growth          &growth) const
  {
    const std::string text = Text::trim(direction_text_);
    if (text == "default")
      growth.direction =
        growth.is_by_strength() || (is_linear && growth.is_by_energy()) ?
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
