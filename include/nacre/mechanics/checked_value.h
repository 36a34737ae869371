// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_checked_value_h
#define nacre_mechanics_checked_value_h

#include <nacre/base/expression.h>

#include <string>

namespace Nacre
{
  /**
   * The @p value of the parameter @p where at @p point (length); throws with
   * all three unless it is positive.
   */
  double
  positive(const double value, const std::string &where, const Point<3> &point);

  /** The same of its value at @p point. */
  double
  positive(const Expression &value, const Point<3> &point);

  /** Throws unless the @p value is positive, if it is the same everywhere. */
  void
  check_positive(const Expression &value);
} // namespace Nacre

#endif
