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

  LoadParameters::LoadParameters()
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
  LoadParameters::named_edges() const
  {
    std::vector<std::string> names;
    const auto               add = [&](const auto &edge, const auto &...) {
      names.push_back(edge);
    };
    for_each_entry(edge_forces_text_, forces_parameter, add);
    for_each_entry(edge_moments_text_, moments_parameter, add);
    return names;
  }

  Loads
  LoadParameters::make(const Midsurface &midsurface,
                       const Constants  &constants) const
  {
    Loads loads;
    loads.force = VectorExpression(force_text_,
                                   "Loads/Force per area",
                                   constants,
                                   variables);
    loads.gravity =
      VectorExpression(gravity_text_, "Loads/Gravity", constants, variables);
    loads.normal_pressure =
      Expression(pressure_text_, "Loads/Pressure", constants, variables);
    loads.follows = follows_;
    for (auto &[id, force] : edge_loads<VectorExpression>(edge_forces_text_,
                                                          forces_parameter,
                                                          midsurface,
                                                          constants))
      loads.set_edge_force(id, std::move(force));
    for (auto &[id, moment] : edge_loads<Expression>(edge_moments_text_,
                                                     moments_parameter,
                                                     midsurface,
                                                     constants))
      loads.set_edge_moment(id, std::move(moment));
    for_each_entry(point_forces_text_,
                   "Loads/Point forces",
                   [&](const auto &point,
                       const auto &value,
                       const auto &where) {
                     loads.add_point_force(
                       {evaluate_point(point, where, constants),
                        VectorExpression(value, where, constants, variables),
                        where});
                   });
    return loads;
  }

  void
  Loads::set_edge_force(const types::boundary_id id, VectorExpression &&force)
  {
    edge_forces_[id] = std::move(force);
  }

  void
  Loads::set_edge_moment(const types::boundary_id id, Expression &&moment)
  {
    edge_moments_[id] = std::move(moment);
  }

  bool
  Loads::no_surface_load() const
  {
    return force.is_zero() && gravity.is_zero() &&
           (follows || normal_pressure.is_zero());
  }

  Tensor<1, 3>
  Loads::force_per_area(const Point<3>     &point,
                        const Tensor<1, 3> &t0,
                        const double        area_density,
                        const Instant      &instant) const
  {
    const double dead_pressure = follows ? 0. : pressure(point, instant);
    return force(point, instant) + area_density * gravity(point, instant) +
           dead_pressure * t0;
  }

  bool
  Loads::has_pressure() const
  {
    return !normal_pressure.is_zero();
  }

  bool
  Loads::pressure_follows() const
  {
    return follows && has_pressure();
  }
} // namespace Nacre
