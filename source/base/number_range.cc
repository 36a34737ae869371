// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/expression.h>
#include <nacre/base/number_range.h>

namespace Nacre
{
  double
  positive_number(const std::string &text,
                  const std::string &where,
                  const Constants   &constants)
  {
    const double value = evaluate_number(text, where, constants);
    AssertThrow(value > 0.,
                ExcMessage(where + ": '" + text + "' is not positive."));
    return value;
  }

  double
  nonnegative_number(const std::string &text,
                     const std::string &where,
                     const Constants   &constants)
  {
    const double value = evaluate_number(text, where, constants);
    AssertThrow(value >= 0.,
                ExcMessage(where + ": '" + text +
                           "' is negative; 0 and above are allowed."));
    return value;
  }
} // namespace Nacre
