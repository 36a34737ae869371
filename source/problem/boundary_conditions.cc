// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/midsurface.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    const std::string edges_parameter = "Boundary conditions/Edges";

    const std::vector<std::pair<std::string, Direction>> component_names = {
      {"x", Direction::x},
      {"y", Direction::y},
      {"z", Direction::z},
      {"normal", Direction::normal},
      {"conormal", Direction::conormal},
      {"tangent", Direction::tangent}};

    /** Split "key: value" at the first colon outside parentheses. */
    std::pair<std::string, std::string>
    name_and_items(const std::string &text,
                   const std::string &where,
                   const std::string &form)
    {
      const auto colon = Text::find(text, ":");
      AssertThrow(colon != std::string::npos,
                  ExcMessage(where + ": '" + text + "' has no ':'; write '" +
                             form + "'."));
      return {Text::trim(text.substr(0, colon)),
              Text::trim(text.substr(colon + 1))};
    }

    std::vector<Text::Entry>
    entries_of_edges(const std::string &text)
    {
      return Text::entries(text, edges_parameter, "edge", "u=0: clamped");
    }

    bool
    is_along_axis(const DisplacementCondition &condition)
    {
      return condition.direction == Direction::x ||
             condition.direction == Direction::y ||
             condition.direction == Direction::z;
    }

    DisplacementCondition
    component(const std::string &key,
              const std::string &value,
              const std::string &where,
              const Constants   &constants)
    {
      for (const auto &[name, direction] : component_names)
        if (name == key)
          return {
            direction,
            Expression(value, where + " (" + key + ")", constants, "x,y,z,t"),
            where + ": " + key + " = " + value};
      auto names = BoundaryConditionParameters::condition_names();
      AssertThrow(false,
                  ExcMessage(
                    Text::unknown_name(where, "condition", key, names)));
      return {Direction::x, Expression(), ""};
    }

    void
    add_edge_item(EdgeConditions    &conditions,
                  const std::string &item,
                  const std::string &where,
                  const Constants   &constants)
    {
      const auto add = [&](const Direction direction) {
        conditions.displacements.push_back(
          {direction, Expression(), where + ": " + item});
      };
      const auto add_rotation = [&](const std::string &text) {
        AssertThrow(conditions.rotation == nullptr,
                    ExcMessage(where + ": '" + item +
                               "' prescribes the rotation a second time."));
        conditions.rotation =
          std::make_unique<Expression>(text,
                                       where + " (rotation)",
                                       constants,
                                       "x,y,z,t");
      };

      const auto [key, value] = Text::key_and_value(item);
      if (value.empty())
        {
          if (item == "free")
            return;
          if (item == "fixed" || item == "clamped")
            for (const auto direction :
                 {Direction::x, Direction::y, Direction::z})
              add(direction);
          else if (item == "symmetry")
            add(Direction::plane_normal);
          else if (item == "diaphragm")
            add(Direction::within_plane);
          else
            {
              const auto names = BoundaryConditionParameters::condition_names();
              AssertThrow(std::find(names.begin(), names.end(), key) ==
                            names.end(),
                          ExcMessage(where + ": '" + item +
                                     "' needs a value: write '" + key +
                                     " = 0'."));
              AssertThrow(
                false,
                ExcMessage(
                  Text::unknown_name(where, "condition", item, names)));
            }
          if (item == "clamped" || item == "symmetry")
            add_rotation("0");
        }
      else if (key == "rotation")
        add_rotation(value);
      else
        {
          auto condition = component(key, value, where, constants);
          for (const auto &other : conditions.displacements)
            AssertThrow(other.direction != condition.direction,
                        ExcMessage(where + ": '" + item + "' prescribes '" +
                                   key + "' a second time."));
          conditions.displacements.push_back(std::move(condition));
        }
    }

    void
    add_edge(BoundaryConditions             &result,
             const Midsurface               &midsurface,
             const std::string              &name,
             const std::vector<std::string> &items,
             const Constants                &constants)
    {
      const auto ids   = midsurface.edge_ids(name, edges_parameter);
      const auto plain = Text::unquoted(name);
      const auto where = edges_parameter + ", edge '" + plain + "'";
      AssertThrow(!items.empty(),
                  ExcMessage(where +
                             " has no condition; write 'free' if that is "
                             "meant."));
      auto first = numbers::invalid_boundary_id;
      for (const auto id : ids)
        {
          auto &conditions = result.edge(id);
          AssertThrow(conditions.name != plain,
                      ExcMessage(where + " has conditions twice; write all of "
                                         "them in one entry."));
          AssertThrow(conditions.name.empty() || conditions.items == items,
                      ExcMessage(where + ": " + midsurface.describe_side(id) +
                                 " has other conditions by the name '" +
                                 conditions.name +
                                 "'; one side can't have both."));
          if (!conditions.name.empty())
            continue;
          first            = std::min(first, id);
          conditions.edge  = first;
          conditions.name  = plain;
          conditions.items = items;
          for (const auto &item : items)
            add_edge_item(conditions, item, where, constants);
        }
    }
  } // namespace

  BoundaryConditionParameters::BoundaryConditionParameters()
    : ParameterAcceptor("/Boundary conditions")
  {
    add_parameter(
      "Edges",
      edges_text_,
      "Conditions on named edges: 'edge[, edge]: item, item; ...'; names with "
      "commas, colons or semicolons in double quotes. Items: "
      "free; fixed (x = y = z = 0); clamped (fixed, rotation 0); symmetry (no "
      "displacement across the plane that holds the edge, rotation 0); "
      "diaphragm (no displacement within the plane that holds the edge), for "
      "straight edges the plane across the surface; "
      "x, y, z, normal, conormal, tangent = displacement component, an "
      "expression of x, y, z, units: length; rotation = t0 . du/dn with the "
      "outward conormal n, units: rad. Edges not named are free.");
    add_parameter(
      "Points",
      points_text_,
      "Supports of points of the mid-surface, nodes or not: '(x, y, "
      "z): x = 0, y = 0; ...'. Units: length.");
  }

  std::vector<std::string>
  BoundaryConditionParameters::condition_names()
  {
    std::vector<std::string> names =
      {"free", "fixed", "clamped", "symmetry", "diaphragm", "rotation"};
    for (const auto &component : component_names)
      names.push_back(component.first);
    return names;
  }

  std::vector<std::string>
  BoundaryConditionParameters::named_edges() const
  {
    std::vector<std::string> names;
    for (const auto &entry : entries_of_edges(edges_text_))
      names.insert(names.end(), entry.names.begin(), entry.names.end());
    return names;
  }

  BoundaryConditions
  BoundaryConditionParameters::make(const Midsurface &midsurface,
                                    const Constants  &constants) const
  {
    BoundaryConditions result;
    for (const auto &entry : entries_of_edges(edges_text_))
      for (const auto &name : entry.names)
        add_edge(result,
                 midsurface,
                 name,
                 Text::split(entry.value,
                             ',',
                             edges_parameter + ", edge '" +
                               Text::unquoted(name) + "'"),
                 constants);

    const std::string points_parameter = "Boundary conditions/Points";
    for (const auto &entry : Text::split(points_text_, ';', points_parameter))
      {
        const auto [position, items] =
          name_and_items(entry, points_parameter, "(0, 0, 0): z = 0");
        PointSupport support;
        support.source   = points_parameter + ", point " + position;
        support.position = evaluate_point(position, support.source, constants);
        AssertThrow(!items.empty(),
                    ExcMessage(support.source +
                               " has no condition; write 'fixed' or "
                               "'x = value'."));
        for (const auto &item : Text::split(items, ',', support.source))
          {
            const auto [key, value] = Text::key_and_value(item);
            AssertThrow(key == "x" || key == "y" || key == "z" ||
                          item == "fixed",
                        ExcMessage(support.source + ": '" + item +
                                   "' is not 'x = value', 'y = value', "
                                   "'z = value' or 'fixed'."));
            if (item == "fixed")
              for (const auto *name : {"x", "y", "z"})
                support.displacements.push_back(
                  component(name, "0", support.source, constants));
            else
              support.displacements.push_back(
                component(key, value, support.source, constants));
          }
        result.add_point(std::move(support));
      }
    return result;
  }

  bool
  EdgeConditions::may_turn() const
  {
    return std::any_of(displacements.begin(),
                       displacements.end(),
                       [](const DisplacementCondition &condition) {
                         return is_along_axis(condition) &&
                                !condition.value.is_constant();
                       });
  }

  Tensor<1, 3>
  EdgeConditions::displacement(const Point<3> &point,
                               const Instant  &instant) const
  {
    Tensor<1, 3> u;
    for (const auto &condition : displacements)
      if (is_along_axis(condition))
        u[static_cast<unsigned int>(condition.direction)] =
          condition.value(point, instant);
    return u;
  }

  void
  BoundaryConditions::prescribe(const EdgeIds  &edge,
                                const Direction direction,
                                const double    value)
  {
    for (const auto id : edge)
      {
        edges_[id].edge = *edge.begin();
        edges_[id].displacements.push_back(
          {direction,
           Expression(value),
           "the displacement of the edge " + std::to_string(*edge.begin())});
      }
  }

  void
  BoundaryConditions::prescribe_rotation(const EdgeIds &edge,
                                         const double   value)
  {
    for (const auto id : edge)
      {
        edges_[id].edge     = *edge.begin();
        edges_[id].rotation = std::make_unique<Expression>(value);
      }
  }

  void
  BoundaryConditions::clamp(const EdgeIds &edge)
  {
    for (const auto direction : {Direction::x, Direction::y, Direction::z})
      prescribe(edge, direction);
    prescribe_rotation(edge);
  }
} // namespace Nacre
