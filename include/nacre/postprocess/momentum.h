// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_momentum_h
#define nacre_postprocess_momentum_h

#include <nacre/postprocess/shell_state.h>

namespace Nacre
{
  /** 1/2 v . M v (force times length); 0 in statics. Collective. */
  double
  kinetic_energy(const SolvedShell &shell);

  /** The sum of M v over the nodes (force times time). Collective. */
  Tensor<1, spacedim>
  linear_momentum(const SolvedShell &shell);

  /**
   * The sum of (X + u) x M v over the nodes, about the origin (force times
   * length times time). Collective.
   */
  Tensor<1, spacedim>
  angular_momentum(const SolvedShell &shell);
} // namespace Nacre

#endif
