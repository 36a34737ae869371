// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/exact_solution.h>

namespace Nacre
{
  ExactSolution::ExactSolution()
    : ParameterAcceptor("/Exact solution")
  {
    add_parameter("Displacement",
                  displacement_text_,
                  "Components along x, y, z, expressions of x, y, z; empty if "
                  "none is known. Units: length.");
  }

  void
  ExactSolution::prepare(const Constants &constants)
  {
    displacement_.reset();
    if (!displacement_text_.empty())
      displacement_.emplace(displacement_text_,
                            "Exact solution/Displacement",
                            constants);
  }

  bool
  ExactSolution::is_known() const
  {
    return displacement_.has_value();
  }

  Tensor<1, 3>
  ExactSolution::displacement(const Point<3> &point) const
  {
    Assert(is_known(), ExcInternalError());
    return (*displacement_)(point);
  }
} // namespace Nacre
