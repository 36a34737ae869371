// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_reactions_h
#define nacre_postprocess_reactions_h

#include <nacre/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <deal.II/lac/trilinos_vector.h>

#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  class Discretization;
  class DisplacementConditions;
  struct SolvedShell;

  /** The nodes and points whose support forces a reaction adds up. */
  struct Supports
  {
    /** All nodes and points with a prescribed displacement. */
    bool all = false;
    /** All nodes of these edges, held or not. */
    std::set<types::boundary_id> edges;
    /** Nodes, or supported points between them. */
    std::vector<Point<spacedim>> points;
    /** Begins the messages. */
    std::string where;
  };

  /**
   * The virtual displacement v of the supports along @p direction, for which
   * the reaction is v . (K u - f): each node once, hanging nodes follow,
   * supported points between the nodes that aren't meant stay. Collective;
   * throws for a point that is neither a node nor supported.
   */
  TrilinosWrappers::MPI::Vector
  support_displacement(const Discretization         &discretization,
                       const DisplacementConditions &conditions,
                       const Supports               &supports,
                       const Tensor<1, spacedim>    &direction);

  /** A force and its moment about a point. */
  struct Resultant
  {
    Tensor<1, spacedim> force;
    Tensor<1, spacedim> moment;

    Resultant &
    operator+=(const Resultant &other);
  };

  /** The force along @p direction with which the supports act on the shell. */
  double
  reaction(const SolvedShell         &shell,
           const Supports            &supports,
           const Tensor<1, spacedim> &direction);

  /**
   * The moment of the supports along @p direction about @p origin (force times
   * length), prescribed rotations included. The lever arms are those of the
   * deformed positions unless the kinematics is linear. Collective.
   */
  double
  reaction_moment(const SolvedShell         &shell,
                  const Supports            &supports,
                  const Tensor<1, spacedim> &direction,
                  const Point<spacedim>     &origin);

  /** All forces on a shell, and their moments about a point. */
  struct Balance
  {
    Resultant loads;
    Resultant reactions;
    /** -M a and damping, in dynamics. */
    std::optional<Resultant> inertia;
    /**
     * In statics, unless linear: the net moment that the co-rotational form
     * leaves in cells and edges that bend and stretch.
     */
    std::optional<Resultant> internal;

    /** Collective. */
    Balance(const SolvedShell &shell, const Point<spacedim> &origin);
  };

  /** A row for each kind of forces, and their sum. */
  void
  write_balance(const Balance         &balance,
                const Point<spacedim> &origin,
                std::ostream          &out);
} // namespace Nacre

#endif
