// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_ply_stack_h
#define nacre_mechanics_ply_stack_h

#include <string>
#include <vector>

namespace Nacre
{
  /** A ply as a stack's notation names it. */
  struct Ply
  {
    /** From the 1-axis towards the 2-axis (degrees). */
    double angle = 0.;
    /** Name of its material; empty: the only one. */
    std::string material = {};
  };

  /**
   * The plies of a stack, from bottom to top, in the notation of the field
   * (ASTM D6507; Jones, Mechanics of Composite Materials, section 1.4):
   *
   * | text | plies |
   * |---|---|
   * | `[0/45/90]` | as they stand |
   * | `[0/90]s` | with their mirror image: 0, 90, 90, 0 |
   * | `[0/90]2`, `[0/90]2s` | twice; twice and then mirrored |
   * | `[0/90]t` | the total laminate, as without the t |
   * | `[45_2/0]` | 45, 45, 0 |
   * | `[+-45/0]`, `[-+45]` | 45, -45, 0; -45, 45; the signs of Unicode, too |
   * | `[(0/90)_2/45]`, `[(+-45)2]` | groups repeated |
   * | `[0_carbon/0_2glass]` | plies of named materials |
   *
   * Angles are in degrees. Underscores before the suffix and braces around
   * subscripts are optional. Throws an ExcMessage with @p where, the
   * parameter that holds the text, for anything else, and for more than 1000
   * plies.
   */
  std::vector<Ply>
  parse_ply_stack(const std::string &text, const std::string &where);
} // namespace Nacre

#endif
