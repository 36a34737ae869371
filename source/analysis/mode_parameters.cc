// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/mode_parameters.h>
#include <nacre/base/text.h>
#include <nacre/mechanics/surface_axes.h>

namespace Nacre
{
  const Selection<PrestressKind> &
  selection(PrestressKind)
  {
    static const Selection<PrestressKind> table = {
      {PrestressKind::none, "none"},
      {PrestressKind::membrane_force, "membrane force"},
      {PrestressKind::linear, "linear"},
      {PrestressKind::forces_and_moments, "forces and moments"},
      {PrestressKind::tangent, "tangent"}};
    return table;
  }

  const Selection<FactorSign> &
  selection(FactorSign)
  {
    static const Selection<FactorSign> table = {
      {FactorSign::positive, "positive"},
      {FactorSign::negative, "negative"},
      {FactorSign::both, "both"}};
    return table;
  }

  ModeParameters::ModeParameters()
    : ParameterAcceptor("/Analysis")
  {
    add_parameter("Number of modes",
                  values_.n_modes,
                  "Of buckling and vibration: the lowest ones, or at most so "
                  "many of the Range of modes. Units: none.",
                  prm,
                  Patterns::Integer(1, 1000));
    add_parameter("Range of modes",
                  range_text_,
                  "'lower, upper': the modes with frequencies, or load "
                  "factors, between the two; empty: from the lowest one on. "
                  "Units: 1/time; of load factors none.");
    add_parameter(
      "Prestress",
      prestress_,
      "What the stiffness takes from the state before buckling, or of the "
      "vibrating shell: none; membrane force: the geometric stiffness of "
      "'Membrane force'; linear: that of the membrane forces that the loads "
      "make in a linear analysis; forces and moments: with their moments; "
      "tangent: the derivative of the tangent of "
      "finite rotations along the linear solution, which adds moments and "
      "displacements; default: linear for buckling, none for vibration. "
      "Following pressures add their load stiffness in all of them but none. "
      "Buckling scales the change from the loads (and 'Load factor', and "
      "prescribed values) at t = 0 to those at t = 1; what they are at t = 0 "
      "stays. Vibration takes them at t = 1. With 'Start from' the tangent "
      "at that state is taken, and for buckling its derivative along the path; "
      "load factors are the t at which it becomes singular.");
    add_parameter("Membrane force",
                  membrane_force_text_,
                  "'N11, N22, N12', expressions of x, y, z, t, tension "
                  "positive, multiplied by 'Load factor', for Prestress = "
                  "membrane force. Units: force/length.");
    add_parameter("Membrane force axis",
                  force_axis_text_,
                  "Vector, expressions of x, y, z, whose projection on the "
                  "surface is the direction 1 of Membrane force; 2 is normal "
                  "to it and to the normal: 1, 2, t0 are right-handed. Units: "
                  "none.");
    add_parameter("Sign of load factors",
                  values_.sign,
                  "positive: the loads as they are; negative: reversed loads; "
                  "both.");
    add_parameter("Multiplicity tolerance",
                  values_.multiplicity_tolerance,
                  "Relative difference of neighbouring eigenvalues (load "
                  "factors, squares of frequencies) that are counted as a "
                  "multiple one. Units: none.",
                  prm,
                  Patterns::Double(1e-10, 0.1));
  }

  ModeOptions
  ModeParameters::make(const AnalysisType type,
                       const bool         has_start,
                       const Constants   &constants) const
  {
    ModeOptions options;
    options.n_modes                = values_.n_modes;
    options.sign                   = values_.sign;
    options.multiplicity_tolerance = values_.multiplicity_tolerance;
    if (!seeks_modes(type))
      return options;
    options.prestress = prestress_.value_or(type == AnalysisType::buckling ?
                                              PrestressKind::linear :
                                              PrestressKind::none);
    check_use(type);
    AssertThrow(!has_start || !prestress_,
                ExcMessage("Analysis/Prestress: the state of 'Analysis/Start "
                           "from' says what the stiffness takes; leave "
                           "'Prestress' out."));
    const std::string force_text = Text::trim(membrane_force_text_).empty() ?
                                     "0, 0, 0" :
                                     membrane_force_text_;
    options.membrane_force       = VectorExpression(force_text,
                                              "Analysis/Membrane force",
                                              constants,
                                              "x,y,z,t");
    options.force_axis           = read_direction(force_axis_text_,
                                        "Analysis/Membrane force axis",
                                        constants);
    const auto ends = Text::split(range_text_, ',', "Analysis/Range of modes");
    if (ends.empty())
      return options;
    AssertThrow(ends.size() == 2,
                ExcMessage("Analysis/Range of modes: '" + range_text_ +
                           "' is not of the form 'lower, upper'."));
    options.range.emplace(
      evaluate_number(ends[0], "Analysis/Range of modes", constants),
      evaluate_number(ends[1], "Analysis/Range of modes", constants));
    AssertThrow(options.range->first >= 0. &&
                  options.range->second > options.range->first,
                ExcMessage("Analysis/Range of modes: '" + range_text_ +
                           "' must rise, and begin at 0 or above; negative "
                           "load factors have 'Sign of load factors'."));
    return options;
  }

  void
  ModeParameters::check_use(const AnalysisType type) const
  {
    const bool is_buckling = (type == AnalysisType::buckling);
    const auto prestress   = prestress_.value_or(
      is_buckling ? PrestressKind::linear : PrestressKind::none);
    AssertThrow(!is_buckling || prestress != PrestressKind::none,
                ExcMessage("Analysis/Prestress: Type = buckling needs one; "
                           "choose linear, forces and moments, tangent or "
                           "membrane force."));
    AssertThrow(prestress == PrestressKind::membrane_force ||
                  Text::trim(membrane_force_text_).empty(),
                ExcMessage(
                  "Analysis/Membrane force: Prestress = " + name_of(prestress) +
                  " doesn't use it; choose 'Prestress = membrane "
                  "force', or leave it out."));
    AssertThrow(prestress != PrestressKind::membrane_force ||
                  !Text::trim(membrane_force_text_).empty(),
                ExcMessage("Analysis/Membrane force: Prestress = membrane "
                           "force needs 'N11, N22, N12'."));
    AssertThrow(is_buckling || values_.sign == FactorSign::positive,
                ExcMessage(
                  "Analysis/Sign of load factors: Type = " + name_of(type) +
                  " has no load factors; leave it out."));
  }
} // namespace Nacre
