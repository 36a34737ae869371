// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/exact_solution.h>

namespace Nacre
{
  ExactSolutionParameters::ExactSolutionParameters()
    : ParameterAcceptor("/Exact solution")
  {
    add_parameter("Displacement",
                  displacement_text_,
                  "Components along x, y, z, expressions of x, y, z; empty if "
                  "none is known. Units: length.");
  }

  ExactSolution
  ExactSolutionParameters::make(const Constants &constants) const
  {
    if (displacement_text_.empty())
      return {};
    return ExactSolution(VectorExpression(displacement_text_,
                                          "Exact solution/Displacement",
                                          constants));
  }
} // namespace Nacre
