// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/surface_axes.h>

namespace Nacre
{
  double
  positive(const double value, const std::string &where, const Point<3> &point)
  {
    AssertThrow(value > 0.,
                ExcMessage(where + ": " + Text::number(value) +
                           " at the point " + point_text(point) +
                           "; it must be positive."));
    return value;
  }

  double
  positive(const Expression &value, const Point<3> &point)
  {
    return positive(value(point), value.where(), point);
  }

  void
  check_positive(const Expression &value)
  {
    if (value.is_constant())
      positive(value, Point<3>());
  }
} // namespace Nacre
