// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_simple_quantities_h
#define nacre_postprocess_simple_quantities_h

#include <nacre/postprocess/shell_state.h>

#include <functional>
#include <string>
#include <vector>

namespace Nacre
{
  /** A kind of quantity of the whole shell, whose name says everything. */
  struct SimpleQuantity
  {
    std::string                                name;
    std::function<double(const SolvedShell &)> evaluate;
    /** As QuantitiesOfInterest::Quantity. */
    bool is_static = false;
    bool is_error  = false;
  };

  const std::vector<SimpleQuantity> &
  simple_quantities();
} // namespace Nacre

#endif
