// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/discretization/edge_plane.h>
#include <nacre/discretization/rigid_motions.h>
#include <nacre/discretization/shell_components.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/problem/foundation.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    Vector3
    unit(const Vector3 &v)
    {
      return v / v.norm();
    }

    Vector3
    axis(const unsigned int c)
    {
      Vector3 e;
      e[c] = 1.;
      return e;
    }

    /**
     * The dofs whose constraints a rank must know: its relevant ones, and
     * those on which their hanging nodes depend.
     */
    IndexSet
    lines_of_rank(const Discretization &discretization)
    {
      IndexSet lines = discretization.locally_relevant_dofs();
      std::vector<types::global_dof_index> masters;
      for (const auto &line : discretization.node_constraints().get_lines())
        for (const auto &entry : line.entries)
          masters.push_back(entry.first);
      std::sort(masters.begin(), masters.end());
      lines.add_indices(masters.begin(), masters.end());
      lines.compress();
      return lines;
    }
  } // namespace

  DisplacementConditions::DisplacementConditions(
    const Discretization         &discretization,
    const BoundaryConditions     &boundary_conditions,
    const Instant                &instant,
    const DisplacementConditions *finest,
    const Foundation             *foundation)
    : discretization_(discretization)
    , boundary_conditions_(boundary_conditions)
    , instant_(instant)
    , foundation_(foundation)
    , local_lines_(lines_of_rank(discretization))
  {
    if (finest != nullptr)
      planes_ = finest->planes_;
    add_edge_conditions(
      collect_edge_nodes(discretization, boundary_conditions));
    const auto between = add_point_supports();
    constraints_.reinit(local_lines_);
    for (const auto &node : nodes_)
      constrain(node.second);
    // What is prescribed goes before what follows from other nodes.
    for (const auto &line : discretization.node_constraints().get_lines())
      if (!constraints_.is_constrained(line.index))
        {
          constraints_.add_line(line.index);
          constraints_.add_entries(line.index, line.entries);
        }
    constraints_.close();
    constrain_points(between);

    relevant_dofs_ = local_lines_;
    std::vector<types::global_dof_index> masters;
    for (const auto &line : constraints_.get_lines())
      for (const auto &entry : line.entries)
        masters.push_back(entry.first);
    std::sort(masters.begin(), masters.end());
    relevant_dofs_.add_indices(masters.begin(), masters.end());
  }

  Tensor<1, spacedim>
  DisplacementConditions::plane_normal(const std::vector<EdgeNode> &nodes,
                                       const types::boundary_id     id,
                                       const std::string &source) const
  {
    std::vector<PlaneNode> of_edge;
    for (const auto &node : nodes)
      if (node.id == id)
        of_edge.push_back({node.position, node.conormal, node.turn});
    return plane_of_edge(of_edge, discretization_.extent().second, source);
  }

  std::vector<Tensor<1, spacedim>>
  DisplacementConditions::directions_of(const Direction direction,
                                        const EdgeNode &node,
                                        const Vector3  &plane)
  {
    switch (direction)
      {
        case Direction::normal:
          return {node.normal};
        case Direction::conormal:
          return {node.conormal};
        case Direction::tangent:
          return {cross_product_3d(node.normal, node.conormal)};
        case Direction::plane_normal:
          return {plane};
        case Direction::within_plane:
          {
            unsigned int c = 0;
            for (unsigned int d = 1; d < spacedim; ++d)
              if (std::abs(plane[d]) < std::abs(plane[c]))
                c = d;
            const auto first = unit(axis(c) - plane[c] * plane);
            return {first, cross_product_3d(plane, first)};
          }
        default: // x, y, z
          return {axis(static_cast<unsigned int>(direction))};
      }
  }

  void
  DisplacementConditions::add_edge_conditions(
    const std::vector<EdgeNode> &nodes)
  {
    for (const auto &[id, conditions] : boundary_conditions_.edges())
      {
        // An edge may have several boundary ids, but it has one plane.
        if (id != conditions.edge)
          continue;
        Vector3 plane;
        for (const auto &condition : conditions.displacements)
          if (condition.direction == Direction::plane_normal ||
              condition.direction == Direction::within_plane)
            {
              if (planes_.count(id) == 0)
                planes_[id] = plane_normal(nodes, id, condition.source);
              plane = planes_[id];
            }

        for (const auto &edge_node : nodes)
          {
            if (edge_node.id != id)
              continue;
            if (conditions.rotation != nullptr)
              // theta = t0 . (omega x n) = omega . (n x t0)
              rotation_axes_.emplace_back(edge_node.dofs[0],
                                          cross_product_3d(edge_node.conormal,
                                                           edge_node.normal));
            Node &node    = nodes_[edge_node.dofs[0]];
            node.position = edge_node.position;
            node.dofs     = edge_node.dofs;
            for (const auto &condition : conditions.displacements)
              {
                for (const auto &direction :
                     directions_of(condition.direction, edge_node, plane))
                  node.components.push_back(
                    {direction,
                     edge_node.value(condition.value, instant_),
                     &condition.source});
              }
          }
      }
  }

  Tensor<1, spacedim>
  DisplacementConditions::free_part(const types::boundary_id id,
                                    const Vector3           &normal,
                                    const Vector3           &conormal,
                                    const Vector3           &force) const
  {
    const auto edge = boundary_conditions_.edges().find(id);
    if (edge == boundary_conditions_.edges().end())
      return force;
    const auto plane = planes_.find(edge->second.edge);
    EdgeNode   node{};
    node.normal   = normal;
    node.conormal = conormal;
    std::vector<Vector3> basis;
    Vector3              part = force;
    for (const auto &condition : edge->second.displacements)
      for (Vector3 direction :
           directions_of(condition.direction,
                         node,
                         plane == planes_.end() ? Vector3() : plane->second))
        {
          for (const auto &known : basis)
            direction -= (known * direction) * known;
          if (direction.norm() < 1e-6)
            continue;
          basis.push_back(direction / direction.norm());
          part -= (basis.back() * part) * basis.back();
        }
    return part;
  }

  std::vector<PointCondition>
  DisplacementConditions::add_point_supports()
  {
    std::vector<PointCondition> between;
    const auto                 &supports = boundary_conditions_.points();
    for (std::size_t k = 0; k < supports.size(); ++k)
      {
        const auto &support = supports[k];
        const auto  place =
          place_point(discretization_, support.position, support.source);
        if (!place.is_node)
          {
            for (const auto &condition : support.displacements)
              between.push_back({k,
                                 static_cast<unsigned int>(condition.direction),
                                 place,
                                 condition.value(place.position, instant_),
                                 &condition.source});
            continue;
          }
        Node &node    = nodes_[place.dofs[0][0]];
        node.dofs     = place.dofs[0];
        node.position = place.position;
        for (const auto &condition : support.displacements)
          node.components.push_back(
            {axis(static_cast<unsigned int>(condition.direction)),
             condition.value(node.position, instant_),
             &condition.source});
      }
    return between;
  }

  std::vector<DisplacementConditions::Component>
  DisplacementConditions::independent_components(const Node &node)
  {
    // Each direction is made orthogonal to those that came before.
    std::vector<Component> basis;
    for (const auto &component : node.components)
      {
        Vector3            rest      = component.direction;
        double             value     = component.value;
        double             magnitude = std::abs(value);
        double             largest   = 0.;
        const std::string *nearest   = nullptr;
        for (const auto &known : basis)
          {
            const double part = component.direction * known.direction;
            // Of a condition of several directions others are named rather
            // than its own.
            const double weight =
              std::abs(part) * (*known.source == *component.source ? 1e-3 : 1.);
            if (weight > largest)
              {
                largest = weight;
                nearest = known.source;
              }
            rest -= part * known.direction;
            value -= part * known.value;
            magnitude += std::abs(part * known.value);
          }
        // Mean conormals are no more precise than the geometry's derivatives.
        if (rest.norm() > 1e-3)
          basis.push_back(
            {rest / rest.norm(), value / rest.norm(), component.source});
        else
          {
            std::ostringstream message;
            message << "Contradicting conditions at the point ("
                    << node.position[0] << ", " << node.position[1] << ", "
                    << node.position[2] << "): '" << *component.source
                    << "' against '" << *nearest << "'.";
            AssertThrow(std::abs(value) <= (rest.norm() + 1e-8) * magnitude,
                        ExcMessage(message.str()));
          }
      }
    return basis;
  }

  std::vector<unsigned int>
  DisplacementConditions::solve_for_pivots(std::vector<Component> &basis)
  {
    std::vector<unsigned int>  pivots;
    std::array<bool, spacedim> solved{{false, false, false}};
    for (unsigned int k = 0; k < basis.size(); ++k)
      {
        unsigned int pivot = numbers::invalid_unsigned_int;
        for (unsigned int c = 0; c < spacedim; ++c)
          if (!solved[c] && (pivot == numbers::invalid_unsigned_int ||
                             std::abs(basis[k].direction[c]) >
                               std::abs(basis[k].direction[pivot]) + 1e-12))
            pivot = c;
        solved[pivot] = true;
        pivots.push_back(pivot);
        basis[k].value /= basis[k].direction[pivot];
        basis[k].direction /= basis[k].direction[pivot];
        for (unsigned int m = 0; m < basis.size(); ++m)
          if (m != k)
            {
              const double factor = basis[m].direction[pivot];
              basis[m].direction -= factor * basis[k].direction;
              basis[m].value -= factor * basis[k].value;
            }
      }
    return pivots;
  }

  void
  DisplacementConditions::constrain(const Node &node)
  {
    auto       basis  = independent_components(node);
    const auto pivots = solve_for_pivots(basis);
    for (unsigned int k = 0; k < basis.size(); ++k)
      {
        const auto        &line  = basis[k];
        const unsigned int pivot = pivots[k];
        const auto         dof   = node.dofs[pivot];
        if (!local_lines_.is_element(dof) || constraints_.is_constrained(dof))
          continue;
        constraints_.add_line(dof);
        for (unsigned int c = 0; c < spacedim; ++c)
          if (c != pivot && std::abs(line.direction[c]) > 1e-14)
            constraints_.add_entry(dof, node.dofs[c], -line.direction[c]);
        constraints_.set_inhomogeneity(dof, line.value);
      }
  }

  void
  DisplacementConditions::constrain_points(
    const std::vector<PointCondition> &conditions)
  {
    if (conditions.empty())
      return;
    points_ = PointConstraints(discretization_, conditions, constraints_);
    // All ranks must know these lines, or some would take eliminated dofs for
    // free ones.
    local_lines_.add_indices(points_.dofs().begin(), points_.dofs().end());
    AffineConstraints<double> all(local_lines_);
    all.merge(constraints_,
              AffineConstraints<double>::no_conflicts_allowed,
              true);
    points_.add_to(all);
    all.close();
    constraints_.copy_from(all);
  }

  std::vector<DisplacementConditions::HeldNode>
  DisplacementConditions::held_nodes() const
  {
    std::vector<HeldNode> result;
    for (const auto &[dof, node] : nodes_)
      if (!node.components.empty())
        result.push_back({node.position, node.dofs});
    return result;
  }

  std::set<types::boundary_id>
  DisplacementConditions::edges() const
  {
    std::set<types::boundary_id> ids;
    for (const auto &entry : boundary_conditions_.edges())
      ids.insert(entry.first);
    return ids;
  }

  std::vector<std::string>
  DisplacementConditions::free_rigid_motions() const
  {
    const ShellComponents                components(discretization_);
    const auto                           extent = discretization_.extent();
    const RigidMotions                   none(extent.first, extent.second);
    std::vector<RigidMotions>            motions(components.size(), none);
    std::vector<types::global_dof_index> dofs;
    for (const auto &entry : nodes_)
      dofs.push_back(entry.first);
    for (const auto &condition : points_.conditions())
      dofs.push_back(condition.place.dofs[0][0]);
    for (const auto &[dof, axis] : rotation_axes_)
      dofs.push_back(dof);
    const auto of_node = components.of_nodes(dofs);

    unsigned int k = 0;
    for (const auto &entry : nodes_)
      {
        for (const auto &component : entry.second.components)
          motions[of_node[k]].hold_displacement(entry.second.position,
                                                component.direction);
        ++k;
      }
    for (const auto &condition : points_.conditions())
      motions[of_node[k++]].hold_displacement(condition.place.position,
                                              axis(condition.component));
    for (const auto &[dof, axis] : rotation_axes_)
      motions[of_node[k++]].hold_rotation(axis);
    if (foundation_ != nullptr && !foundation_->is_zero())
      {
        std::vector<RigidMotions> held(components.size(), none);
        run_on_all_ranks(discretization_.communicator(),
                         [&]() { hold_by_foundation(components, held); });
        for (unsigned int c = 0; c < components.size(); ++c)
          motions[c].add_of_all_ranks(held[c], discretization_.communicator());
      }
    std::vector<std::string> words;
    for (unsigned int c = 0; c < components.size(); ++c)
      for (const auto &motion : motions[c].free_motions())
        {
          std::ostringstream text;
          text << motion;
          if (components.size() > 1)
            text << " of the piece around (" << components.point(c) << ')';
          words.push_back(text.str());
        }
    return words;
  }

  void
  DisplacementConditions::hold_by_foundation(
    const ShellComponents     &components,
    std::vector<RigidMotions> &motions) const
  {
    ShellCellValues values(discretization_,
                           discretization_.element().reduced_quadrature(),
                           false);
    for (const CellPart &part : discretization_.owned_parts())
      {
        values.reinit_frames(part);
        RigidMotions &of_part = motions[components.of(part)];
        for (unsigned int q = 0; q < values.n_points(); ++q)
          {
            const auto x          = values.point(q);
            const auto [k_n, k_t] = foundation_->stiffness(x);
            const auto &frame     = values.frame(q);
            const auto  e_1       = unit(frame.a_cov[0]);
            if (k_n > 0.)
              of_part.hold_displacement(x, frame.t0);
            if (k_t > 0.)
              {
                of_part.hold_displacement(x, e_1);
                of_part.hold_displacement(x, cross_product_3d(frame.t0, e_1));
              }
          }
      }
  }
} // namespace Nacre
