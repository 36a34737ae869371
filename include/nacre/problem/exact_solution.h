// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_exact_solution_h
#define nacre_problem_exact_solution_h

#include <nacre/base/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <utility>

namespace Nacre
{
  /** A known displacement field (length), to measure errors against. */
  class ExactSolution
  {
  public:
    /** None is known. */
    ExactSolution() = default;

    explicit ExactSolution(VectorExpression &&displacement)
      : displacement_(std::move(displacement))
    {}

    /** Whether one is given. */
    bool
    is_known() const
    {
      return displacement_.has_value();
    }

    /** The displacement (length) at a point of the mid-surface. */
    Tensor<1, 3>
    displacement(const Point<3> &point) const
    {
      Assert(is_known(), ExcInternalError());
      return (*displacement_)(point);
    }

  private:
    std::optional<VectorExpression> displacement_;
  };

  /** The section Exact solution of a parameter file. */
  class ExactSolutionParameters : public ParameterAcceptor
  {
  public:
    ExactSolutionParameters();

    /** Throws for malformed expressions. */
    ExactSolution
    make(const Constants &constants) const;

  private:
    std::string displacement_text_;
  };
} // namespace Nacre

#endif
