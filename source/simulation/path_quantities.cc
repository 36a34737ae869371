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

    using Quantity = QuantitiesOfInterest::Quantity;
    using Vector   = ControlledQuantity::Vector;
    using Value    = ControlledQuantity::Value;
    using Evaluate = std::function<Value(const Vector &, const double)>;

    Evaluate
    displacement(const Quantity &quantity, const DiscreteShell &shell)
    {
      return
        [gradient = quantity.goal.load(
           shell.discretization())](const Vector &u, const double /*time*/) {
          return ControlledQuantity::with_gradient(gradient * u, gradient);
        };
    }

    Evaluate
    rotation(const Quantity      &quantity,
             const DiscreteShell &shell,
             const ShellSystem   &system)
    {
      return [angle = quantity.angle, &shell, &system](const Vector &u,
                                                       const double /*time*/) {
        const Angle found =
          angle(shell.discretization(), system.with_ghosts(u));
        return ControlledQuantity::with_gradient(found.value, found.gradient);
      };
    }

    Evaluate
    reaction(const Quantity      &quantity,
             const DiscreteShell &shell,
             ShellSystem         &system)
    {
      const double dt = shell.problem().path.rate_step();
      return
        [v = quantity.goal.reaction(shell.discretization(), shell.conditions()),
         dt,
         &system](const Vector &u, const double time) {
          const auto work = system.virtual_work(u, v, time, dt);
          return ControlledQuantity::with_gradient(work.value,
                                                   work.gradient,
                                                   work.rate);
        };
    }

    /** States of a section as a step leaves them; then as they were. */
    class StatesAtEnd
    {
    public:
      StatesAtEnd(const Assembly     &assembly,
                  const Vector       &u,
                  const ShellActions &actions)
        : states_(assembly.section_states())
        , start_(states_)
      {
        assembly.update_section_states(u, actions);
      }

      ~StatesAtEnd()
      {
        states_ = start_;
      }

    private:
      SectionStates      &states_;
      const SectionStates start_;
    };

    /** At the ghosted displacement @p u. */
    double
    value_at_end(const Quantity      &quantity,
                 const DiscreteShell &shell,
                 const Vector        &u,
                 const double         time)
    {
      const auto        &model    = shell.problem().model;
      const auto        &assembly = shell.assembly();
      const ShellActions actions  = assembly.actions(model.at(time));
      const StatesAtEnd  states(assembly, u, actions);
      const ShellState   state{shell.discretization(),
                             model,
                             u,
                             actions.loads,
                             &assembly.section_states()};
      if (quantity.of_displacement)
        return quantity.of_displacement(state);
      Vector     residual = shell.owned_vector();
      const auto energies = assembly.residual(u, actions, residual);
      return quantity.evaluate(
        {state, assembly, actions, shell.conditions(), residual, energies});
    }

    Evaluate
    other_quantity(const Quantity      &quantity,
                   const DiscreteShell &shell,
                   const ShellSystem   &system)
    {
      const auto value = [quantity, &shell, &system](const Vector &u,
                                                     const double  time) {
        return value_at_end(quantity, shell, system.with_ghosts(u), time);
      };
      return [value,
              reach = 1e-3 * system.thickness(),
              dt    = shell.problem().path.rate_step()](const Vector &u,
                                                     const double  time) {
        return ControlledQuantity::by_differences(value, u, time, reach, dt);
      };
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
        AssertThrow(control->is_static,
                    ExcMessage("Analysis/Control: the quantity '" +
                               path.control +
                               "' is none that a displacement makes, as "
                               "'displacement z at (x, y, z)', 'moment 11 at "
                               "(x, y, z)', 'reaction z of EDGE' or "
                               "'opening of CUT at (x, y, z)' are; choose "
                               "one of these, or 'Type = arc length'."));
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
  controlled_quantity(const QuantitiesOfInterest &quantities,
                      const DiscreteShell        &shell,
                      ShellSystem                &system)
  {
    const auto &path     = shell.problem().path;
    const auto *quantity = find_quantity(quantities, path.control);
    Assert(quantity != nullptr, ExcInternalError());
    ControlledQuantity control;
    if (quantity->goal.load)
      control.evaluate = displacement(*quantity, shell);
    else if (quantity->angle)
      {
        control.evaluate = rotation(*quantity, shell, system);
        control.period   = 2. * numbers::PI;
      }
    else
      {
        control.evaluate = quantity->goal.reaction ?
                             reaction(*quantity, shell, system) :
                             other_quantity(*quantity, shell, system);
        // Forces know round-off of the membrane's.
        control.accuracy = 1e-6;
      }
    control.evaluate(system.owned_vector(), 0.);
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
