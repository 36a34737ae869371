// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_exact_solution_h
#define nacre_problem_exact_solution_h

#include <nacre/base/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>

namespace Nacre
{
  /** A known displacement field (length), to measure errors against. */
  class ExactSolution : public ParameterAcceptor
  {
  public:
    ExactSolution();

    void
    prepare(const Constants &constants);

    /** Whether one is given. */
    bool
    is_known() const;

    /** The displacement (length) at a point of the mid-surface. */
    Tensor<1, 3>
    displacement(const Point<3> &point) const;

  private:
    std::string                     displacement_text_;
    std::optional<VectorExpression> displacement_;
  };
} // namespace Nacre

#endif
