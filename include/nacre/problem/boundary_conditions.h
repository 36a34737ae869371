// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_boundary_conditions_h
#define nacre_problem_boundary_conditions_h

#include <nacre/base/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  class Midsurface;

  /** The direction in which a displacement component is prescribed. */
  enum class Direction
  {
    /** Global axes. */
    x,
    y,
    z,
    /** The surface's normal t0. */
    normal,
    /** Outward unit conormal n of the edge, tangent to the surface. */
    conormal,
    /** Unit tangent of the edge, t0 x n. */
    tangent,
    /** Normal of the plane that holds the edge: a symmetry plane's. */
    plane_normal,
    /** Both directions within the plane that holds the edge: a diaphragm. */
    within_plane
  };

  /** One prescribed displacement component (length). */
  struct DisplacementCondition
  {
    Direction  direction;
    Expression value;
    /** The text it comes from, for messages. */
    std::string source;
  };

  /** Everything prescribed on one edge. */
  struct EdgeConditions
  {
    std::vector<DisplacementCondition> displacements;
    /**
     * Rotation theta = t0 . du/dn (rad) about the edge, n the outward
     * conormal; null where the moment is prescribed (natural).
     */
    std::unique_ptr<Expression> rotation;
    /** One of the edge's boundary ids, the same here for all of them. */
    types::boundary_id edge = numbers::invalid_boundary_id;
    /** The edge's name and the conditions as texts, for messages. */
    std::string              name;
    std::vector<std::string> items;

    /** Whether a displacement that is prescribed along an axis varies. */
    bool
    may_turn() const;

    /**
     * The displacement (length) that is prescribed along the axes at @p point;
     * components that are free are zero. Throws where an expression isn't
     * finite.
     */
    Tensor<1, 3>
    displacement(const Point<3> &point, const Instant &instant) const;
  };

  /** Components prescribed at a point, a node or not. */
  struct PointSupport
  {
    Point<3>                           position;
    std::vector<DisplacementCondition> displacements;
    std::string                        source;
  };

  /**
   * Displacements and rotations prescribed on edges and at points: values that
   * BoundaryConditionParameters reads from a parameter file, or that a program
   * states. All of them are multiplied by the factor of an Instant.
   */
  class BoundaryConditions
  {
  public:
    using EdgeIds = std::set<types::boundary_id>;

    /** The conditions of the edge @p id, to be added to. */
    EdgeConditions &
    edge(const types::boundary_id id)
    {
      return edges_[id];
    }

    /**
     * Prescribe a displacement (length) on the edge with the boundary ids
     * @p edge, of which Midsurface::edge_ids() knows those of a name.
     */
    void
    prescribe(const EdgeIds  &edge,
              const Direction direction,
              const double    value = 0.);

    /** Prescribe the rotation (rad) about the edge. */
    void
    prescribe_rotation(const EdgeIds &edge, const double value = 0.);

    /** No displacement and no rotation of the edge. */
    void
    clamp(const EdgeIds &edge);

    /** Add the support of a point. */
    void
    add_point(PointSupport &&support)
    {
      points_.push_back(std::move(support));
    }

    /** By boundary id. */
    const std::map<types::boundary_id, EdgeConditions> &
    edges() const
    {
      return edges_;
    }

    const std::vector<PointSupport> &
    points() const
    {
      return points_;
    }

  private:
    std::map<types::boundary_id, EdgeConditions> edges_;
    std::vector<PointSupport>                    points_;
  };

  /** The section Boundary conditions of a parameter file. */
  class BoundaryConditionParameters : public ParameterAcceptor
  {
  public:
    BoundaryConditionParameters();

    /**
     * Read the conditions. Throws for unknown edges and conditions and for a
     * component that one edge prescribes twice.
     */
    BoundaryConditions
    make(const Midsurface &midsurface, const Constants &constants) const;

    /** The edges that have conditions, as the parameter names them. */
    std::vector<std::string>
    named_edges() const;

    /** The condition words that an edge may carry, for messages and --list. */
    static std::vector<std::string>
    condition_names();

  private:
    std::string edges_text_;
    std::string points_text_;
  };
} // namespace Nacre

#endif
