// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_instant_h
#define nacre_base_instant_h

namespace Nacre
{
  /**
   * A time t and the factor by which all loads and prescribed values are
   * multiplied there. A linear analysis takes them as they stand, at t = 0 with
   * the factor 1.
   */
  struct Instant
  {
    double time   = 0.;
    double factor = 1.;
  };
} // namespace Nacre

#endif
