// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_boundary_conditions_h
#define nacre_problem_boundary_conditions_h

#include <nacre/base/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <memory>
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

  /** Everything prescribed on one named edge. */
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
  };

  /** Components prescribed at a point, a node or not. */
  struct PointSupport
  {
    Point<3>                           position;
    std::vector<DisplacementCondition> displacements;
    std::string                        source;
  };

  /** Displacements and rotations prescribed on named edges and at points. */
  class BoundaryConditions : public ParameterAcceptor
  {
  public:
    BoundaryConditions();

    /**
     * Read the conditions. Throws for unknown edges and conditions and for a
     * component that one edge prescribes twice.
     */
    void
    prepare(const Midsurface &midsurface, const Constants &constants);

    /** The edges that have conditions, as the parameter names them. */
    std::vector<std::string>
    named_edges() const;

    /** Evaluate all values at @p time and multiply them by @p factor. */
    void
    set_time(const double time, const double factor);

    /**
     * The factor over t that set_time() will be called with, which must live as
     * long: with it past displacements are known.
     */
    void
    set_load_factor(const Expression &load_factor);

    /** Of the last set_time(). */
    double
    time() const
    {
      return time_;
    }

    /**
     * Whether the displacements of an edge may turn it: some along the axes are
     * no constants, and the load factor is known.
     */
    bool
    may_turn(const EdgeConditions &conditions) const;

    /**
     * The displacement (length) that is prescribed along the axes at @p point
     * of an edge at any @p time; components that are free are zero. Throws
     * where an expression isn't finite.
     */
    Tensor<1, 3>
    displacement(const EdgeConditions &conditions,
                 const Point<3>       &point,
                 const double          time) const;

    const std::map<types::boundary_id, EdgeConditions> &
    edges() const;

    const std::vector<PointSupport> &
    points() const;

    /** The condition words that an edge may carry, for messages and --list. */
    static std::vector<std::string>
    condition_names();

  private:
    /** Conditions of the edge @p name on all of its boundary ids. */
    void
    add_edge(const Midsurface               &midsurface,
             const std::string              &name,
             const std::vector<std::string> &items,
             const Constants                &constants);

    void
    add_edge_item(EdgeConditions    &conditions,
                  const std::string &item,
                  const std::string &where,
                  const Constants   &constants) const;

    std::string edges_text_;
    std::string points_text_;

    std::map<types::boundary_id, EdgeConditions> edges_;
    std::vector<PointSupport>                    points_;
    const Expression                            *load_factor_ = nullptr;
    double                                       time_        = 0.;
  };
} // namespace Nacre

#endif
