// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_tip_h
#define nacre_postprocess_crack_tip_h

#include <nacre/discretization/discretization.h>
#include <nacre/postprocess/crack_extension.h>

#include <string>

namespace Nacre
{
  /**
   * The tip of a slit of the mesh: the vertex at @p point, where two edges of
   * the boundary, the lips, leave side by side. Throws on all ranks if there
   * is none. Collective.
   * @param where begins the messages
   */
  CrackTip
  find_crack_tip(const Discretization &discretization,
                 const Point<3>       &point,
                 const std::string    &where);
} // namespace Nacre

#endif
