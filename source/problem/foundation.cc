// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
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

  std::array<double, 2>
  Foundation::stiffness(const Point<3> &point) const
  {
    return {{checked_spring(normal, point, "Normal stiffness"),
             checked_spring(tangential, point, "Tangential stiffness")}};
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
    add_parameter("Tension free",
                  tension_free_,
                  "no: the normal springs push and pull; below: they lie on "
                  "the side opposite to the normal and only push, where the "
                  "displacement along the normal is negative; above: on the "
                  "side of the normal, and only push.");
  }

  Foundation
  FoundationParameters::make(const Constants &constants) const
  {
    return {Expression(normal_text_, "Foundation/Normal stiffness", constants),
            Expression(tangential_text_,
                       "Foundation/Tangential stiffness",
                       constants),
            tension_free_};
  }
} // namespace Nacre
