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
                        const QuantitiesOfInterest &quantities)
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
        AssertThrow(control->goal.load,
                    ExcMessage("Analysis/Control: the quantity '" +
                               path.control +
                               "' is not linear in the displacement; choose "
                               "one like 'displacement z at (x, y, z)', or "
                               "'Type = arc length'."));
      }
    names.insert(names.end(), {load_factor_name, time_name});
    for (const auto &bound : path.bounds)
      AssertThrow(std::count(names.begin(), names.end(), bound.quantity) > 0,
                  ExcMessage(Text::unknown_name("Analysis/Stop where",
                                                "quantity",
                                                bound.quantity,
                                                names)));
  }

  const QuantitiesOfInterest::Quantity *
  controlled_quantity(const PathParameters       &path,
                      const QuantitiesOfInterest &quantities)
  {
    return find_quantity(quantities, path.control);
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
