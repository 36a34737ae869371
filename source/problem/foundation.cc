// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/section_regions.h>
#include <nacre/problem/foundation.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  const Selection<TensionFree> &
  selection(TensionFree)
  {
    static const Selection<TensionFree> table = {{TensionFree::no, "no"},
                                                 {TensionFree::below, "below"},
                                                 {TensionFree::above, "above"}};
    return table;
  }

  namespace
  {
    double
    checked_spring(const Expression  &expression,
                   const Point<3>    &point,
                   const std::string &name)
    {
      const double value = expression(point);
      if (value < 0.)
        {
          std::ostringstream message;
          message << "Foundation/" << name << ": " << value << " at the point ("
                  << point << "); it must not be negative.";
          AssertThrow(false, ExcMessage(message.str()));
        }
      return value;
    }
  } // namespace

  bool
  Foundation::is_zero() const
  {
    return springs.is_zero() &&
           std::all_of(of_region.begin(), of_region.end(), [](const auto &own) {
             return !own || own->is_zero();
           });
  }

  std::array<double, 2>
  Foundation::stiffness(const SectionPoint &point) const
  {
    const bool has_own =
      point.region() < of_region.size() && of_region[point.region()];
    const Springs &here = has_own ? *of_region[point.region()] : springs;
    return {{checked_spring(here.normal, point, "Normal stiffness"),
             checked_spring(here.tangential, point, "Tangential stiffness")}};
  }

  double
  Foundation::normal_energy(const double k, const double w) const
  {
    const bool pulls = (tension_free == TensionFree::below && w > 0.) ||
                       (tension_free == TensionFree::above && w < 0.);
    return pulls ? 0. : 0.5 * k * w * w;
  }

  Foundation::Answer
  Foundation::normal_answer(const double k,
                            const double w_start,
                            const double w_end) const
  {
    if (tension_free == TensionFree::no)
      return {0.5 * k * (w_start + w_end), k};
    // As if the foundation lay below.
    const double side  = (tension_free == TensionFree::below ? 1. : -1.);
    const double start = side * w_start, end = side * w_end;
    if (start <= 0. && end <= 0.)
      return {0.5 * k * (w_start + w_end), k};
    if (start >= 0. && end >= 0.)
      return {};
    // It closes or opens within the step.
    const double low   = std::min(start, end);
    const double force = -0.5 * k * low * low / std::abs(end - start);
    const double slope = k * std::min(end, 0.) - force;
    return {side * force, 2. * slope / (end - start)};
  }

  FoundationParameters::FoundationParameters()
    : ParameterAcceptor("/Foundation")
  {
    add_parameter("Normal stiffness",
                  normal_text_,
                  "Of springs along the normal of the undeformed surface, per "
                  "area of it, an expression of x, y, z; 0: none. "
                  "Units: force/length^3.");
    add_parameter("Tangential stiffness",
                  tangential_text_,
                  "Of springs along the undeformed surface. "
                  "Units: force/length^3.");
    add_parameter("Regions",
                  regions_text_,
                  "Other stiffnesses in regions of the mesh, by the names of "
                  "its groups of cells (mesh files only): 'soil: normal = 100, "
                  "tangential = 5; air: normal = 0'. Units: as above.");
    add_parameter("Tension free",
                  tension_free_,
                  "no: the normal springs push and pull; below: they lie on "
                  "the side opposite to the normal and only push, where the "
                  "displacement along the normal is negative; above: on the "
                  "side of the normal, and only push.");
  }

  Foundation
  FoundationParameters::make(const Constants   &constants,
                             const MeshRegions &regions) const
  {
    const std::string                       section = "Foundation/";
    const std::string                       where   = section + "Regions";
    const std::vector<std::string>          keys    = {"normal", "tangential"};
    std::vector<std::string>                names;
    std::vector<std::array<std::string, 2>> texts;
    for (const auto &entry :
         Text::entries(regions_text_, where, "region", "soil: normal = 100"))
      for (const auto &name : entry.names)
        {
          names.push_back(Text::unquoted(name));
          texts.push_back({{normal_text_, tangential_text_}});
          for (const auto &item : Text::split(entry.value, ',', where))
            {
              const auto [key, text] = Text::key_and_value(item);
              const auto found       = std::find(keys.begin(), keys.end(), key);
              AssertThrow(found != keys.end(),
                          ExcMessage(
                            Text::unknown_name(where, "value", key, keys)));
              texts.back()[found - keys.begin()] = text;
            }
        }
    Foundation result{
      {Expression(normal_text_, section + "Normal stiffness", constants),
       Expression(tangential_text_,
                  section + "Tangential stiffness",
                  constants)},
      tension_free_};
    for (const unsigned int k : assign_regions(regions, names, where))
      if (k == numbers::invalid_unsigned_int)
        result.of_region.emplace_back();
      else
        result.of_region.emplace_back(
          Foundation::Springs{Expression(texts[k][0], where, constants),
                              Expression(texts[k][1], where, constants)});
    return result;
  }
} // namespace Nacre
