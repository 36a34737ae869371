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
     * Loads of one kind from "place[, place]: value; ...".
     * @param keys_of(name, where) what a place stands for: boundary ids, lips
     * @param describe(key) for messages
     * @tparam Load is made of (value, where, constants, variables)
     */
    template <typename Load, typename Key, typename Keys, typename Describe>
    std::map<Key, Load>
    line_loads(const std::string &text,
               const std::string &parameter,
               const Constants   &constants,
               const Keys        &keys_of,
               const Describe    &describe)
    {
      std::map<Key, Load>        loads;
      std::map<Key, std::string> names;
      for_each_entry(
        text,
        parameter,
        [&](const auto &place, const auto &value, const auto &where) {
          const std::string name = Text::unquoted(place);
          for (const Key &key : keys_of(place, where))
            {
              const auto [other, is_new] = names.emplace(key, name);
              AssertThrow(is_new || other->second != name,
                          ExcMessage(where + " stands twice."));
              AssertThrow(is_new,
                          ExcMessage(where + ": " + describe(key) +
                                     " has a load already, as a part of '" +
                                     other->second + "'; one is possible."));
              loads.emplace(key, Load(value, where, constants, variables));
            }
        });
      return loads;
    }

    /** On every boundary id of the edges. */
    template <typename Load>
    std::map<types::boundary_id, Load>
    edge_loads(const std::string &text,
               const std::string &parameter,
               const Midsurface  &midsurface,
               const Constants   &constants)
    {
      return line_loads<Load, types::boundary_id>(
        text,
        parameter,
        constants,
        [&](const auto &name, const auto &where) {
          return midsurface.edge_ids(name, where);
        },
        [&](const auto id) { return midsurface.describe_side(id); });
    }

    /** The load of @p key, or null. */
    template <typename Key, typename Load>
    const Load *
    find_load(const std::map<Key, Load> &loads, const Key &key)
    {
      const auto found = loads.find(key);
      return found != loads.end() ? &found->second : nullptr;
    }

    std::string
    lip_in_words(const LipOfCut &lip, const Cuts &cuts)
    {
      return std::string("the ") + (lip.second ? "left" : "right") +
             " lip of the cut '" + cuts.curves[lip.first].name + "'";
    }

    /** On the lips that "CUT", "CUT left" and "CUT right" stand for. */
    template <typename Load>
    std::map<LipOfCut, Load>
    lip_loads(const std::string &text,
              const std::string &parameter,
              const Cuts        &cuts,
              const Constants   &constants)
    {
      return line_loads<Load, LipOfCut>(
        text,
        parameter,
        constants,
        [&](std::string name, const std::string &where) {
          const bool left  = Text::take_last_word(name, "left");
          const bool right = !left && Text::take_last_word(name, "right");
          const auto cut   = find_cut(Text::unquoted(name), cuts, where);
          std::vector<LipOfCut> lips;
          if (!right)
            lips.emplace_back(cut, true);
          if (!left)
            lips.emplace_back(cut, false);
          return lips;
        },
        [&](const LipOfCut &lip) { return lip_in_words(lip, cuts); });
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
    add_parameter("Lip forces",
                  lip_forces_text_,
                  "Forces per length of the lips of cuts: 'CUT[ left| right][, "
                  "CUT ...]: fx, fy, fz; ...', expressions of x, y, z; without "
                  "a side each lip has them. The left is that of who walks "
                  "along the cut on the side of the normal t0. Units: "
                  "force/length.");
    add_parameter("Lip moments",
                  lip_moments_text_,
                  "Bending moments m_nn per length of lips: 'CUT[ left| "
                  "right]: m; ...'. Units: force.");
    add_parameter("Lip pressures",
                  lip_pressures_text_,
                  "Forces per length that push lips apart, in the undeformed "
                  "surface and at right angles to the cut: 'CUT[ left| "
                  "right]: p; ...'; a pressure times the thickness. Units: "
                  "force/length.");
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
                       const Constants  &constants,
                       const Cuts       &cuts) const
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
    make_lip_loads(cuts, constants, loads);
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
  LoadParameters::make_lip_loads(const Cuts      &cuts,
                                 const Constants &constants,
                                 Loads           &loads) const
  {
    for (auto &[lip, force] : lip_loads<VectorExpression>(lip_forces_text_,
                                                          "Loads/Lip forces",
                                                          cuts,
                                                          constants))
      loads.set_lip_force(lip, std::move(force));
    for (auto &[lip, moment] : lip_loads<Expression>(lip_moments_text_,
                                                     "Loads/Lip moments",
                                                     cuts,
                                                     constants))
      loads.set_lip_moment(lip, std::move(moment));
    for (auto &[lip, pressure] : lip_loads<Expression>(lip_pressures_text_,
                                                       "Loads/Lip pressures",
                                                       cuts,
                                                       constants))
      loads.set_lip_pressure(lip, std::move(pressure));
  }

  Tensor<1, 3>
  LineLoad::force_at(const Point<3>     &point,
                     const Tensor<1, 3> &conormal,
                     const Instant      &instant) const
  {
    Tensor<1, 3> result;
    if (force != nullptr)
      result += (*force)(point, instant);
    if (pressure != nullptr)
      result -= (*pressure)(point, instant) * conormal;
    return result;
  }

  double
  LineLoad::moment_at(const Point<3> &point, const Instant &instant) const
  {
    return moment != nullptr ? (*moment)(point, instant) : 0.;
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

  void
  Loads::set_lip_force(const LipOfCut &lip, VectorExpression &&force)
  {
    lip_forces_[lip] = std::move(force);
  }

  void
  Loads::set_lip_moment(const LipOfCut &lip, Expression &&moment)
  {
    lip_moments_[lip] = std::move(moment);
  }

  void
  Loads::set_lip_pressure(const LipOfCut &lip, Expression &&pressure)
  {
    lip_pressures_[lip] = std::move(pressure);
  }

  LineLoad
  Loads::on_edge(const types::boundary_id id) const
  {
    return {find_load(edge_forces_, id), find_load(edge_moments_, id)};
  }

  LineLoad
  Loads::on_lip(const LipOfCut &lip) const
  {
    return {find_load(lip_forces_, lip),
            find_load(lip_moments_, lip),
            find_load(lip_pressures_, lip)};
  }

  std::set<LipOfCut>
  Loads::loaded_lips() const
  {
    std::set<LipOfCut> lips;
    const auto         add = [&](const auto &loads) {
      for (const auto &entry : loads)
        lips.insert(entry.first);
    };
    add(lip_forces_);
    add(lip_moments_);
    add(lip_pressures_);
    return lips;
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
