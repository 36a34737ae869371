// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_edge_turns_h
#define nacre_forms_edge_turns_h

#include <nacre/discretization/shell_values.h>

#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace Nacre
{
  class BoundaryConditions;
  struct EdgeConditions;

  /**
   * How prescribed displacements have turned the edges whose rotation is
   * prescribed as well: at each point of an edge the rotation Q that follows
   * its direction d(s) from s = 0 to the time t without spinning about it,
   * dQ/ds Q^T = (d x dd/ds) x. The displacement itself tells where an edge
   * points, not how it got there: opposite directions are joined by rotations
   * about any axis, and only the motion knows which.
   *
   * It depends on the prescribed expressions alone, not on the steps of a path.
   * Where the edge stays within a plane Q is the rotation about the plane's
   * normal, by any number of turns.
   */
  class EdgeTurns
  {
  public:
    using Turns         = std::vector<Tensor<2, spacedim>>;
    using cell_iterator = DoFHandler<dim, spacedim>::active_cell_iterator;

    EdgeTurns(const Discretization     &discretization,
              const BoundaryConditions &boundary_conditions);

    /**
     * Follow the edges of this rank to the time of the conditions. Throws where
     * an expression isn't finite, maybe on some ranks only; does not
     * communicate.
     */
    void
    update();

    /** Of the points of an edge; null where nothing turns it. */
    const Turns *
    find(const cell_iterator &cell, const unsigned int face) const;

  private:
    Turns
    follow(const cell_iterator  &cell,
           const unsigned int    face,
           const EdgeConditions &conditions);

    /** Unit directions of the edge's points at @p time. */
    std::vector<Tensor<1, spacedim>>
    directions(const cell_iterator  &cell,
               const unsigned int    face,
               const EdgeConditions &conditions,
               const double          time) const;

    const Discretization     &discretization_;
    const BoundaryConditions &boundary_conditions_;
    ShellEdgeValues           edge_;
    double                    time_ = std::numeric_limits<double>::quiet_NaN();
    std::map<std::pair<unsigned int, unsigned int>, Turns> turns_;
  };
} // namespace Nacre

#endif
