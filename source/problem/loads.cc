// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/loads.h>
#include <nacre/problem/midsurface.h>

namespace Nacre
{
  namespace
  {
    /** Names that a load's expression may use. */
    const std::string variables = "x,y,z,t";

    const std::string forces_parameter  = "Loads/Edge forces";
    const std::string moments_parameter = "Loads/Edge moments";

    /** Call @p add(name, value, where) for each "name[, name]: value; ...". */
    template <typename Function>
    void
    for_each_entry(const std::string &text,
                   const std::string &parameter,
                   const Function    &add)
    {
      for (const auto &entry :
           Text::entries(text, parameter, "place", "place: load"))
        for (const auto &place : entry.names)
          add(place,
              entry.value,
              parameter + ", '" + Text::unquoted(place) + "'");
    }

    /**
     * Loads of one kind from "edge[, edge]: value; ...", on every boundary id
     * of the edges; @p Load is made of (value, where, constants, variables).
     */
    template <typename Load>
    std::map<types::boundary_id, Load>
    edge_loads(const std::string &text,
               const std::string &parameter,
               const Midsurface  &midsurface,
               const Constants   &constants)
    {
      std::map<types::boundary_id, Load>        loads;
      std::map<types::boundary_id, std::string> names;
      for_each_entry(
        text,
        parameter,
        [&](const auto &edge, const auto &value, const auto &where) {
          const std::string name = Text::unquoted(edge);
          for (const auto id : midsurface.edge_ids(edge, where))
            {
              const auto [other, is_new] = names.emplace(id, name);
              AssertThrow(is_new || other->second != name,
                          ExcMessage(where + " stands twice."));
              AssertThrow(is_new,
                          ExcMessage(where + ": " +
                                     midsurface.describe_side(id) +
                                     " has a load already, as a part of the "
                                     "edge '" +
                                     other->second + "'; one is possible."));
              loads.emplace(id, Load(value, where, constants, variables));
            }
        });
      return loads;
    }
  } // namespace

  Loads::Loads()
    : ParameterAcceptor("/Loads")
  {
    add_parameter(
      "Force per area",
      force_text_,
      "Components along x, y, z; as all loads, expressions of x, y, "
      "z and the time t. Units: force/length^2.");
    add_parameter("Gravity",
                  gravity_text_,
                  "Acceleration along x, y, z; the weight per area is Density "
                  "times Thickness times this. Units: length/time^2.");
    add_parameter("Pressure",
                  pressure_text_,
                  "Along the unit normal t0 of the mid-surface, an expression "
                  "of x, y, z. Units: force/length^2.");
    add_parameter("Pressure follows",
                  follows_,
                  "Whether the pressure acts along the normal and on the area "
                  "of the deformed surface, given at the undeformed points.");
    add_parameter("Edge forces",
                  edge_forces_text_,
                  "Forces per length of edges: 'edge[, edge]: fx, fy, fz; "
                  "...', expressions of x, y, z. Units: force/length.");
    add_parameter("Edge moments",
                  edge_moments_text_,
                  "Bending moments m_nn per length of edges: 'edge[, edge]: "
                  "m; ...'. Units: force.");
    add_parameter("Point forces",
                  point_forces_text_,
                  "'(x, y, z): Fx, Fy, Fz; ...'. Units: length; force.");
  }

  std::vector<std::string>
  Loads::named_edges() const
  {
    std::vector<std::string> names;
    const auto               add = [&](const auto &edge, const auto &...) {
      names.push_back(edge);
    };
    for_each_entry(edge_forces_text_, forces_parameter, add);
    for_each_entry(edge_moments_text_, moments_parameter, add);
    return names;
  }

  void
  Loads::prepare(const Midsurface &midsurface, const Constants &constants)
  {
    force_ = VectorExpression(force_text_,
                              "Loads/Force per area",
                              constants,
                              variables);
    gravity_ =
      VectorExpression(gravity_text_, "Loads/Gravity", constants, variables);
    pressure_ =
      Expression(pressure_text_, "Loads/Pressure", constants, variables);

    edge_forces_  = edge_loads<VectorExpression>(edge_forces_text_,
                                                forces_parameter,
                                                midsurface,
                                                constants);
    edge_moments_ = edge_loads<Expression>(edge_moments_text_,
                                           moments_parameter,
                                           midsurface,
                                           constants);
    point_forces_.clear();
    for_each_entry(point_forces_text_,
                   "Loads/Point forces",
                   [&](const auto &point,
                       const auto &value,
                       const auto &where) {
                     point_forces_.push_back(
                       {evaluate_point(point, where, constants),
                        VectorExpression(value, where, constants, variables),
                        where});
                   });
  }

  bool
  Loads::no_surface_load() const
  {
    return force_.is_zero() && gravity_.is_zero() &&
           (follows_ || pressure_.is_zero());
  }

  Tensor<1, 3>
  Loads::force_per_area(const Point<3>     &point,
                        const Tensor<1, 3> &t0,
                        const double        area_density) const
  {
    const double dead_pressure = follows_ ? 0. : pressure_(point);
    return force_(point) + area_density * gravity_(point) + dead_pressure * t0;
  }

  bool
  Loads::pressure_follows() const
  {
    return follows_ && has_pressure();
  }

  double
  Loads::pressure(const Point<3> &point) const
  {
    return pressure_(point);
  }

  void
  Loads::set_time(const double time, const double factor)
  {
    force_.set_time(time, factor);
    gravity_.set_time(time, factor);
    pressure_.set_time(time, factor);
    for (auto &[edge, force] : edge_forces_)
      force.set_time(time, factor);
    for (auto &[edge, moment] : edge_moments_)
      moment.set_time(time, factor);
    for (auto &point_force : point_forces_)
      point_force.force.set_time(time, factor);
  }

  bool
  Loads::has_pressure() const
  {
    return !pressure_.is_zero();
  }

  const std::map<types::boundary_id, VectorExpression> &
  Loads::edge_forces() const
  {
    return edge_forces_;
  }

  const std::map<types::boundary_id, Expression> &
  Loads::edge_moments() const
  {
    return edge_moments_;
  }

  const std::vector<PointForce> &
  Loads::point_forces() const
  {
    return point_forces_;
  }
} // namespace Nacre
