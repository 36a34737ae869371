// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_number_range_h
#define nacre_base_number_range_h

#include <nacre/base/types.h>

#include <string>

namespace Nacre
{
  /** evaluate_number() of a parameter @p where; throws if it isn't positive. */
  double
  positive_number(const std::string &text,
                  const std::string &where,
                  const Constants   &constants);

  /** The same; throws if it is negative. */
  double
  nonnegative_number(const std::string &text,
                     const std::string &where,
                     const Constants   &constants);
} // namespace Nacre

#endif
