// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_edge_nodes_h
#define nacre_discretization_edge_nodes_h

#include <nacre/discretization/discretization.h>
#include <nacre/problem/boundary_conditions.h>

#include <array>
#include <utility>
#include <vector>

namespace Nacre
{
  /** A node on a boundary edge. */
  struct EdgeNode
  {
    /** EdgeConditions::edge */
    types::boundary_id                            id;
    std::array<types::global_dof_index, spacedim> dofs;
    Point<spacedim>                               position;
    Tensor<1, spacedim>                           normal;
    Tensor<1, spacedim>                           conormal;
    /** Largest angle (rad) between normals there and in the cell. */
    double turn = 0.;
    /**
     * Of a node that stands across a cut: points on the side of its part, and
     * the weights with which the polynomial through values there continues to
     * the node. What is prescribed may jump at the cut.
     */
    std::vector<std::pair<Point<spacedim>, double>> samples;

    /** What @p prescribed says of the node. */
    template <typename Value>
    double
    value(const Value &prescribed, const Instant &instant) const
    {
      if (samples.empty())
        return prescribed(position, instant);
      double sum = 0.;
      for (const auto &[x, weight] : samples)
        sum += weight * prescribed(x, instant);
      return sum;
    }
  };

  /**
   * All nodes of the edges that have conditions, on all ranks, those of one
   * edge and one dof as one node with the mean directions. Collective.
   */
  std::vector<EdgeNode>
  collect_edge_nodes(const Discretization     &discretization,
                     const BoundaryConditions &boundary_conditions);
} // namespace Nacre

#endif
