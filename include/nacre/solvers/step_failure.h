// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_step_failure_h
#define nacre_solvers_step_failure_h

#include <string>

namespace Nacre
{
  /** Why a step of a path fails. This is no error: a shorter step is tried. */
  enum class FailureKind
  {
    none,
    /** Newton's method diverges, or needs too many iterations. */
    no_convergence,
    /** Internal forces or their derivative are infinite or not a number. */
    not_finite,
    /** The tangent is singular to working precision. */
    singular_tangent,
    /** What displacement control prescribes isn't changed by the loads. */
    constant_quantity,
    /** The iteration has converged to an impossible deformation. */
    impossible_deformation,
    /** Dynamic relaxation finds no stable state. */
    no_stable_state
  };

  /** What went wrong, and where, in words for the user. */
  struct StepFailure
  {
    FailureKind kind = FailureKind::none;
    std::string text;
  };
} // namespace Nacre

#endif
