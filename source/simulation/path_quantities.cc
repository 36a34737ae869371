// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/simulation/path_quantities.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    const std::string load_factor_name = "load factor";
    const std::string time_name        = "t";

    /** Null if there is none. */
    const QuantitiesOfInterest::Quantity *
    find_quantity(const QuantitiesOfInterest &quantities,
                  const std::string          &name)
    {
      for (const auto &quantity : quantities.quantities())
        if (quantity.name == name)
          return &quantity;
      return nullptr;
    }
  } // namespace

  void
  check_path_quantities(const PathParameters       &path,
                        const QuantitiesOfInterest &quantities,
                        const KinematicsModel       kinematics)
  {
    std::vector<std::string> names;
    for (const auto &quantity : quantities.quantities())
      names.push_back(quantity.name);
    if (!path.control.empty())
      {
        const auto *const control = find_quantity(quantities, path.control);
        AssertThrow(control != nullptr,
                    ExcMessage(Text::unknown_name("Analysis/Control",
                                                  "quantity",
                                                  path.control,
                                                  names)));
        AssertThrow(control->goal.load || control->goal.reaction ||
                      control->angle,
                    ExcMessage("Analysis/Control: the quantity '" +
                               path.control +
                               "' is neither a displacement nor a rotation at "
                               "a point, nor a reaction; choose one like "
                               "'displacement z at (x, y, z)' or 'reaction z "
                               "of EDGE', or 'Type = arc length'."));
        AssertThrow(!control->angle || kinematics != KinematicsModel::linear,
                    ExcMessage("Analysis/Control: rotations are controlled "
                               "with Discretization/Kinematics = finite or "
                               "corotational; '" +
                               path.control +
                               "' is one, and the kinematics are linear."));
      }
    names.insert(names.end(), {load_factor_name, time_name});
    for (const auto &bound : path.bounds)
      AssertThrow(std::count(names.begin(), names.end(), bound.quantity) > 0,
                  ExcMessage(Text::unknown_name("Analysis/Stop where",
                                                "quantity",
                                                bound.quantity,
                                                names)));
  }

  ControlledQuantity
  controlled_quantity(const PathParameters         &path,
                      const QuantitiesOfInterest   &quantities,
                      ShellSystem                  &system,
                      const Discretization         &discretization,
                      const DisplacementConditions &conditions)
  {
    using Vector         = ControlledQuantity::Vector;
    using Value          = ControlledQuantity::Value;
    const auto *quantity = find_quantity(quantities, path.control);
    Assert(quantity != nullptr, ExcInternalError());
    ControlledQuantity control;
    if (quantity->angle)
      {
        control.period   = 2. * numbers::PI;
        control.evaluate = [&system,
                            &discretization,
                            angle = quantity->angle](const Vector &u,
                                                     const double) -> Value {
          const Angle found = angle(discretization, system.with_ghosts(u));
          return {found.value, found.gradient};
        };
        control.evaluate(system.owned_vector(), 0.);
      }
    else if (quantity->goal.reaction)
      {
        // Forces know round-off of the membrane's.
        control.accuracy = 1e-6;
        control.evaluate =
          [&system,
           v  = quantity->goal.reaction(discretization, conditions),
           dt = path.rate_step()](const Vector &u, const double time) -> Value {
          const auto work = system.virtual_work(u, v, time, dt);
          return {work.value, work.gradient, work.rate};
        };
      }
    else
      control.evaluate = [gradient = quantity->goal.load(
                            discretization)](const Vector &u,
                                             const double) -> Value {
        return {gradient * u, gradient};
      };
    return control;
  }

  std::string
  reached_bound(const PathParameters       &path,
                const QuantitiesOfInterest &quantities,
                const PathState            &state,
                const SolvedShell          &shell)
  {
    for (const auto &bound : path.bounds)
      {
        const auto *const quantity = find_quantity(quantities, bound.quantity);
        const double value = quantity != nullptr ? quantity->evaluate(shell) :
                             bound.quantity == time_name ? state.time :
                                                           state.load_factor;
        if (bound.holds(value))
          return bound.text();
      }
    return "";
  }
} // namespace Nacre
