// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_loads_h
#define nacre_problem_loads_h

#include <nacre/base/expression.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <vector>

namespace Nacre
{
  class Midsurface;

  /** A force at one point of the mid-surface. */
  struct PointForce
  {
    Point<3>         position;
    VectorExpression force;
    std::string      source;
  };

  /**
   * Loads, given as expressions of x, y, z on the undeformed surface and of the
   * time t: dead loads, and a pressure that may follow the deformed surface.
   */
  class Loads : public ParameterAcceptor
  {
  public:
    Loads();

    /** Read the loads; throws for unknown edges and malformed expressions. */
    void
    prepare(const Midsurface &midsurface, const Constants &constants);

    /** The edges that have loads, as the parameters name them. */
    std::vector<std::string>
    named_edges() const;

    /** Evaluate all loads at @p time and multiply them by @p factor. */
    void
    set_time(const double time, const double factor);

    /** Whether no dead load acts on the cells. */
    bool
    no_surface_load() const;

    /**
     * Dead force per area of the mid-surface (force/length^2) at a point with
     * unit normal @p t0 and mass per area @p area_density:
     * force + area_density * gravity + pressure * t0, the latter unless it
     * follows.
     */
    Tensor<1, 3>
    force_per_area(const Point<3>     &point,
                   const Tensor<1, 3> &t0,
                   const double        area_density) const;

    /** Whether a pressure acts: then all cells must be oriented alike. */
    bool
    has_pressure() const;

    /** Whether the pressure acts along the deformed normal and area. */
    bool
    pressure_follows() const;

    /** Pressure (force/length^2) at a point of the undeformed surface. */
    double
    pressure(const Point<3> &point) const;

    /** Forces per length of edges (force/length). */
    const std::map<types::boundary_id, VectorExpression> &
    edge_forces() const;

    /**
     * Moments m_nn per length of edges (force), positive if it bends as a
     * positive bending strain does: l(v) = -int m theta(v) ds.
     */
    const std::map<types::boundary_id, Expression> &
    edge_moments() const;

    const std::vector<PointForce> &
    point_forces() const;

  private:
    std::string force_text_    = "0, 0, 0";
    std::string gravity_text_  = "0, 0, 0";
    std::string pressure_text_ = "0";
    bool        follows_       = false;
    std::string edge_forces_text_;
    std::string edge_moments_text_;
    std::string point_forces_text_;

    VectorExpression                               force_;
    VectorExpression                               gravity_;
    Expression                                     pressure_;
    std::map<types::boundary_id, VectorExpression> edge_forces_;
    std::map<types::boundary_id, Expression>       edge_moments_;
    std::vector<PointForce>                        point_forces_;
  };
} // namespace Nacre

#endif
