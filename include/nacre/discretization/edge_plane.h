// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_edge_plane_h
#define nacre_discretization_edge_plane_h

#include <nacre/base/types.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Nacre
{
  /** A node of an edge, as the search for the edge's plane sees it. */
  struct PlaneNode
  {
    Point<spacedim> position;
    /** Unit vector. */
    Tensor<1, spacedim> conormal;
    /** Largest angle (rad) between the normals there and in the cell. */
    double turn;
  };

  /**
   * Unit normal of the plane that holds an edge: that of a symmetry or a
   * diaphragm. The plane lies across the surface. A curved edge determines its
   * plane. Many planes hold a nearly straight edge; the normal of the one that
   * is taken is the mean conormal. If nodes and conormals can't tell the plane
   * from a coordinate plane, or from a plane parallel to an axis, that plane is
   * taken exactly.
   *
   * Nodes may be off the plane by 2e-5 of the extent of the surface and 1e-7
   * of their coordinates, as those of files with 5 digits or in single
   * precision are, and by 1 % of the edge's size at most.
   *
   * @param extent of the mid-surface (length)
   * @param source begins the messages. Throws for an edge in no plane, and
   *   for one that is curved within the surface.
   */
  Tensor<1, spacedim>
  plane_of_edge(const std::vector<PlaneNode> &nodes,
                const double                  extent,
                const std::string            &source);
} // namespace Nacre

#endif
