// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_removed_parts_h
#define nacre_discretization_removed_parts_h

#include <nacre/discretization/discretization.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/loads.h>

#include <vector>

namespace Nacre
{
  /**
   * Which parts belong to the components of the cut shell that hold one of @p
   * points (length): by CellPart::index(), of this rank's parts and its ghosts.
   * Throws for a point off the surface, one on a lip, one in a shell that the
   * cuts leave in one component, and if no component is left. Collective.
   */
  std::vector<bool>
  find_removed_parts(const Discretization               &discretization,
                     const std::vector<Point<spacedim>> &points);

  /**
   * Throws if all of an edge, one boundary id of @p midsurface, that @p
   * supports or @p loads name has been taken away with the parts. Collective.
   */
  void
  check_removed_edges(const Discretization     &discretization,
                      const Midsurface         &midsurface,
                      const BoundaryConditions &supports,
                      const Loads              &loads);

  /**
   * Throws if a lip that has loads has no place in the mesh: the cut opens
   * nothing, or that side of it has been taken away. Collective.
   */
  void
  check_loaded_lips(const Discretization &discretization,
                    const Cuts           &cuts,
                    const Loads          &loads);
} // namespace Nacre

#endif
