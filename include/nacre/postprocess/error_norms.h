// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_error_norms_h
#define nacre_postprocess_error_norms_h

#include <nacre/postprocess/quantities_of_interest.h>

namespace Nacre
{
  /** Norms of the error u - u_h over the discrete mid-surface. */
  struct ErrorNorms
  {
    /** (int |e|^2 dA)^(1/2) (length^2). */
    double L2 = 0.;
    /** (int grad_s e : grad_s e dA)^(1/2) (length). */
    double H1 = 0.;
    /**
     * (int eps(e):H_n:eps(e) + rho(e):H_m:rho(e) dA)^(1/2) over the cells,
     * with the tied strain of u_h, see recovers_tied_strain(),
     * ((force length)^(1/2)).
     */
    double energy = 0.;
  };

  /**
   * The exact solution enters as its interpolant of degree p + 2 on each cell,
   * so that its derivatives need no expressions of their own; the error of
   * that is two orders smaller than u_h's. On parts of divided cells the
   * polynomial of that degree comes from points of the part alone. Collective.
   */
  ErrorNorms
  compute_error_norms(const SolvedShell &shell);
} // namespace Nacre

#endif
