// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_loads_h
#define nacre_problem_loads_h

#include <nacre/base/expression.h>
#include <nacre/problem/cuts.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <set>
#include <string>
#include <utility>
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

  /** What acts along an edge or a lip of a cut; null: nothing. */
  struct LineLoad
  {
    /** Along x, y, z (force/length). */
    const VectorExpression *force = nullptr;
    /** m_nn (force): l(v) = -int m theta(v) ds. */
    const Expression *moment = nullptr;
    /** Against the outward conormal, which opens a cut (force/length). */
    const Expression *pressure = nullptr;

    bool
    is_zero() const
    {
      return force == nullptr && moment == nullptr && pressure == nullptr;
    }

    /** Force and pressure (force/length) at an edge of outward @p conormal. */
    Tensor<1, 3>
    force_at(const Point<3>     &point,
             const Tensor<1, 3> &conormal,
             const Instant      &instant) const;

    /** The moment (force). */
    double
    moment_at(const Point<3> &point, const Instant &instant) const;
  };

  /**
   * A lip of a cut: the cut's number, and whether the lip lies on its left, as
   * CutLip says.
   */
  using LipOfCut = std::pair<unsigned int, bool>;

  /**
   * Loads, functions of the points of the undeformed surface and of the time:
   * dead loads, and a pressure that may follow the deformed surface. Values
   * that LoadParameters reads from a parameter file, or that a program states.
   * All of them are multiplied by the factor of an Instant.
   */
  class Loads
  {
  public:
    /** @name Of the surface: zero at first */
    //@{
    /** Force per area along x, y, z (force/length^2). */
    VectorExpression force;
    /** Acceleration (length/time^2); the weight is density h gravity. */
    VectorExpression gravity;
    /** Along the unit normal t0 (force/length^2). */
    Expression normal_pressure;
    /** Whether the pressure acts along the deformed normal and area. */
    bool follows = false;
    //@}

    /** The loads of the edge @p id; a second call replaces the first. */
    void
    set_edge_force(const types::boundary_id id, VectorExpression &&force);

    void
    set_edge_moment(const types::boundary_id id, Expression &&moment);

    /** Those of a lip, as LineLoad; second calls replace the first. */
    void
    set_lip_force(const LipOfCut &lip, VectorExpression &&force);

    void
    set_lip_moment(const LipOfCut &lip, Expression &&moment);

    void
    set_lip_pressure(const LipOfCut &lip, Expression &&pressure);

    void
    add_point_force(PointForce &&force)
    {
      point_forces_.push_back(std::move(force));
    }

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
                   const double        area_density,
                   const Instant      &instant = Instant()) const;

    /** Whether a pressure acts: then all cells must be oriented alike. */
    bool
    has_pressure() const;

    /** Whether the pressure acts along the deformed normal and area. */
    bool
    pressure_follows() const;

    /** Pressure (force/length^2) at a point of the undeformed surface. */
    double
    pressure(const Point<3> &point, const Instant &instant) const
    {
      return normal_pressure(point, instant);
    }

    /** Forces per length of edges (force/length). */
    const std::map<types::boundary_id, VectorExpression> &
    edge_forces() const
    {
      return edge_forces_;
    }

    /**
     * Moments m_nn per length of edges (force), positive if it bends as a
     * positive bending strain does: l(v) = -int m theta(v) ds.
     */
    const std::map<types::boundary_id, Expression> &
    edge_moments() const
    {
      return edge_moments_;
    }

    LineLoad
    on_edge(const types::boundary_id id) const;

    LineLoad
    on_lip(const LipOfCut &lip) const;

    /** The lips that have loads. */
    std::set<LipOfCut>
    loaded_lips() const;

    bool
    has_lip_loads() const
    {
      return !(lip_forces_.empty() && lip_moments_.empty() &&
               lip_pressures_.empty());
    }

    const std::vector<PointForce> &
    point_forces() const
    {
      return point_forces_;
    }

  private:
    std::map<types::boundary_id, VectorExpression> edge_forces_;
    std::map<types::boundary_id, Expression>       edge_moments_;
    std::map<LipOfCut, VectorExpression>           lip_forces_;
    std::map<LipOfCut, Expression>                 lip_moments_;
    std::map<LipOfCut, Expression>                 lip_pressures_;
    std::vector<PointForce>                        point_forces_;
  };

  /** The section Loads of a parameter file. */
  class LoadParameters : public ParameterAcceptor
  {
  public:
    LoadParameters();

    /**
     * Read the loads; throws for unknown edges and cuts and malformed
     * expressions.
     */
    Loads
    make(const Midsurface &midsurface,
         const Constants  &constants,
         const Cuts       &cuts = Cuts()) const;

    /** The edges that have loads, as the parameters name them. */
    std::vector<std::string>
    named_edges() const;

  private:
    void
    make_lip_loads(const Cuts      &cuts,
                   const Constants &constants,
                   Loads           &loads) const;

    std::string force_text_    = "0, 0, 0";
    std::string gravity_text_  = "0, 0, 0";
    std::string pressure_text_ = "0";
    bool        follows_       = false;
    std::string edge_forces_text_;
    std::string edge_moments_text_;
    std::string lip_forces_text_;
    std::string lip_moments_text_;
    std::string lip_pressures_text_;
    std::string point_forces_text_;
  };
} // namespace Nacre

#endif
