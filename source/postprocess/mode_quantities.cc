// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/postprocess/mode_quantities.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <utility>

namespace Nacre
{
  namespace
  {
    using ModeKind = ModeQuantity::Kind;

    const std::vector<std::pair<std::string, ModeKind>> &
    mode_kinds()
    {
      static const std::vector<std::pair<std::string, ModeKind>> kinds = {
        {"omega", ModeKind::omega},
        {"frequency", ModeKind::frequency},
        {"load factor", ModeKind::load_factor},
        {"multiplicity", ModeKind::multiplicity}};
      return kinds;
    }
  } // namespace

  std::vector<std::string>
  mode_quantity_names()
  {
    std::vector<std::string> names;
    for (const auto &kind : mode_kinds())
      names.push_back(kind.first);
    return names;
  }

  std::optional<ModeQuantity>
  parse_mode_quantity(const std::string &text, const std::string &where)
  {
    for (const auto &[name, kind] : mode_kinds())
      if (text.compare(0, name.size(), name) == 0)
        {
          const std::string number = Text::trim(text.substr(name.size()));
          const bool        is_number =
            !number.empty() && number.size() < 6 &&
            number.find_first_not_of("0123456789") == std::string::npos &&
            std::stoul(number) > 0;
          AssertThrow(is_number,
                      dealii::ExcMessage(where + ": '" + text +
                                         "' is not of the form '" + name +
                                         " NUMBER', modes counted from 1."));
          return ModeQuantity{kind, unsigned(std::stoul(number)), where};
        }
    return {};
  }

  double
  evaluate_mode_quantity(const ModeValues *modes, const ModeQuantity &quantity)
  {
    using dealii::ExcMessage;
    AssertThrow(modes != nullptr,
                ExcMessage(quantity.where +
                           ": only 'Analysis/Type = buckling' and 'vibration' "
                           "have modes."));
    const bool wants_factor = (quantity.kind == ModeKind::load_factor);
    AssertThrow(quantity.kind == ModeKind::multiplicity ||
                  wants_factor != modes->are_frequencies,
                ExcMessage(quantity.where +
                           (wants_factor ?
                              ": 'load factor' belongs to Type = buckling; "
                              "vibration has 'omega' and 'frequency'." :
                              ": 'omega' and 'frequency' belong to Type = "
                              "vibration; buckling has 'load factor'.")));
    const unsigned int last = modes->n_below + modes->values.size();
    AssertThrow(quantity.mode > modes->n_below && quantity.mode <= last,
                ExcMessage(
                  quantity.where + ": the mode " +
                  std::to_string(quantity.mode) + " is not among those found" +
                  (last == modes->n_below ?
                     ": none is in the range, below which there are " +
                       std::to_string(last) :
                     ", " + std::to_string(modes->n_below + 1) + " to " +
                       std::to_string(last)) +
                  "; 'Analysis/Number of modes' and 'Analysis/Range of modes' "
                  "tell which are sought."));
    const unsigned int k = quantity.mode - modes->n_below - 1;
    if (quantity.kind == ModeKind::multiplicity)
      return modes->multiplicities[k];
    if (quantity.kind == ModeKind::frequency)
      return modes->values[k] / (2. * dealii::numbers::PI);
    return modes->values[k];
  }
} // namespace Nacre
