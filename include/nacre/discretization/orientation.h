// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_orientation_h
#define nacre_discretization_orientation_h

namespace Nacre
{
  class Discretization;

  /**
   * Whether all neighbouring cells are oriented alike, so that the surface has
   * a top and a bottom; collective.
   */
  bool
  is_consistently_oriented(const Discretization &discretization);
} // namespace Nacre

#endif
