// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/assembly.h>
#include <nacre/postprocess/quantities_of_interest.h>
#include <nacre/postprocess/reactions.h>

#include <array>
#include <functional>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using Vector  = TrilinosWrappers::MPI::Vector;
    using Vector3 = Tensor<1, spacedim>;
    using Dofs    = std::array<types::global_dof_index, spacedim>;
    /** A displacement by the position X and the displacement u. */
    using Motion = std::function<Vector3(const Vector3 &, const Vector3 &)>;

    /** Call @p use(position, dofs) for the nodes of @p edges on own cells. */
    template <typename Function>
    void
    for_each_edge_node(const Discretization               &discretization,
                       const std::set<types::boundary_id> &edges,
                       const Function                     &use)
    {
      const auto &node_dofs = discretization.node_dofs();
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      for (const CellPart &part : discretization.owned_parts())
        if (part.cell->at_boundary())
          for (const auto face : part.cell->face_indices())
            if (part.cell->at_boundary(face) &&
                edges.count(part.cell->face(face)->boundary_id()) > 0 &&
                !discretization.cell_parts().pieces_of(part, face).empty())
              {
                const auto nodes = discretization.node_positions(part);
                discretization.get_dof_indices(part, dofs);
                for (const unsigned int a : discretization.face_nodes(face))
                  {
                    Dofs of_node;
                    for (unsigned int c = 0; c < spacedim; ++c)
                      of_node[c] = dofs[node_dofs[spacedim * a + c]];
                    use(nodes[a], of_node);
                  }
              }
    }

    /** The conditions of points between the nodes that @p supports mean. */
    std::vector<bool>
    chosen_conditions(const DisplacementConditions  &conditions,
                      const Supports                &supports,
                      const std::vector<PointPlace> &places,
                      const double                   extent)
    {
      const auto       &all = conditions.points_between_nodes().conditions();
      std::vector<bool> chosen(all.size(), supports.all);
      for (const auto &place : places)
        {
          bool found = place.is_node;
          for (unsigned int k = 0; k < all.size(); ++k)
            if (!place.is_node &&
                all[k].place.position.distance(place.position) <= 1e-6 * extent)
              chosen[k] = found = true;
          std::ostringstream message;
          const auto        &x = place.position;
          message << supports.where << ": at the point (" << x[0] << ", "
                  << x[1] << ", " << x[2]
                  << ") there is neither a node nor a support of "
                     "'Boundary conditions/Points'.";
          AssertThrow(found, ExcMessage(message.str()));
        }
      return chosen;
    }

    /**
     * The nodal displacements @p field of the supports.
     * @param u ghosted displacement, or null for zero
     */
    Vector
    support_field(const Discretization         &discretization,
                  const DisplacementConditions &conditions,
                  const Supports               &supports,
                  const Vector                 *u,
                  const Motion                 &field)
    {
      const auto      communicator = discretization.communicator();
      const IndexSet &owned        = discretization.locally_owned_dofs();
      Vector          v(owned, communicator);
      const auto set = [&](const Point<spacedim> &position, const Dofs &dofs) {
        Vector3 u_a;
        for (unsigned int c = 0; u != nullptr && c < spacedim; ++c)
          u_a[c] = (*u)(dofs[c]);
        const Vector3 v_a = field(position, u_a);
        for (unsigned int c = 0; c < spacedim; ++c)
          v(dofs[c]) = v_a[c];
      };
      std::vector<PointPlace> places;
      for (const auto &point : supports.points)
        places.push_back(place_point(discretization, point, supports.where));

      for_each_edge_node(discretization, supports.edges, set);
      for (const auto &place : places)
        if (place.is_node && owned.is_element(place.dofs[0][0]))
          set(place.position, place.dofs[0]);
      if (supports.all)
        for (const auto &node : conditions.held_nodes())
          if (owned.is_element(node.dofs[0]))
            set(node.position, node.dofs);
      v.compress(VectorOperation::insert);
      discretization.node_constraints().distribute(v);

      const auto         &between = conditions.points_between_nodes();
      const auto          chosen  = chosen_conditions(conditions,
                                            supports,
                                            places,
                                            discretization.extent().second);
      std::vector<double> targets(chosen.size());
      for (unsigned int k = 0; k < targets.size(); ++k)
        if (chosen[k])
          {
            const auto &condition = between.conditions()[k];
            Vector3     u_k;
            if (u != nullptr)
              u_k =
                Utilities::MPI::sum(displacement_of(condition.place, *u, owned),
                                    communicator);
            targets[k] =
              field(condition.place.position, u_k)[condition.component];
          }
      between.set_values(targets, v);
      return v;
    }

    /** Whether moments take the deformed positions. */
    bool
    has_deformed_levers(const SolvedShell &shell)
    {
      return shell.model.kinematics.model != KinematicsModel::linear;
    }

    Vector3
    lever(const SolvedShell     &shell,
          const Point<spacedim> &origin,
          const Vector3         &X,
          const Vector3         &u)
    {
      return X + (has_deformed_levers(shell) ? u : Vector3()) - Vector3(origin);
    }

    /** Sum of the nodal forces @p f, and of their moments. */
    Resultant
    resultant(const SolvedShell     &shell,
              const Vector          &f,
              const Point<spacedim> &origin)
    {
      const auto     &discretization = shell.discretization;
      const auto     &node_dofs      = discretization.node_dofs();
      const IndexSet &owned          = discretization.locally_owned_dofs();
      Resultant       sum;
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      std::vector<bool>                    visited(owned.n_elements());
      for (const CellPart &part : discretization.owned_parts())
        {
          discretization.get_dof_indices(part, dofs);
          const auto nodes = discretization.node_positions(part);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            {
              const auto first = dofs[node_dofs[spacedim * a]];
              if (!owned.is_element(first) ||
                  visited[owned.index_within_set(first)])
                continue;
              visited[owned.index_within_set(first)] = true;
              Vector3 u, force;
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const auto i = dofs[node_dofs[spacedim * a + c]];
                  u[c]         = shell.displacement(i);
                  force[c]     = f(i);
                }
              sum.force += force;
              sum.moment +=
                cross_product_3d(lever(shell, origin, nodes[a], u), force);
            }
        }
      const auto communicator = discretization.communicator();
      sum.force               = Utilities::MPI::sum(sum.force, communicator);
      sum.moment              = Utilities::MPI::sum(sum.moment, communicator);
      return sum;
    }

    /** Moment of the rotation conditions of the supports. */
    Vector3
    rotation_moment(const SolvedShell &shell, const Supports &supports)
    {
      const auto edges =
        supports.all ? shell.conditions.edges() : supports.edges;
      Vector3 moment;
      for (const auto id : edges)
        moment -=
          shell.assembly.rotation_conditions().reaction(id,
                                                        shell.displacement,
                                                        shell.actions,
                                                        has_deformed_levers(
                                                          shell));
      return moment;
    }
  } // namespace

  TrilinosWrappers::MPI::Vector
  support_displacement(const Discretization         &discretization,
                       const DisplacementConditions &conditions,
                       const Supports               &supports,
                       const Tensor<1, spacedim>    &direction)
  {
    return support_field(discretization,
                         conditions,
                         supports,
                         nullptr,
                         [&](const auto &, const auto &) { return direction; });
  }

  Resultant &
  Resultant::operator+=(const Resultant &other)
  {
    force += other.force;
    moment += other.moment;
    return *this;
  }

  double
  reaction(const SolvedShell         &shell,
           const Supports            &supports,
           const Tensor<1, spacedim> &direction)
  {
    return shell.residual * support_displacement(shell.discretization,
                                                 shell.conditions,
                                                 supports,
                                                 direction);
  }

  double
  reaction_moment(const SolvedShell         &shell,
                  const Supports            &supports,
                  const Tensor<1, spacedim> &direction,
                  const Point<spacedim>     &origin)
  {
    const double of_nodes =
      shell.residual *
      support_field(shell.discretization,
                    shell.conditions,
                    supports,
                    &shell.displacement,
                    [&](const auto &X, const auto &u) {
                      return cross_product_3d(direction,
                                              lever(shell, origin, X, u));
                    });
    // The work of the rotation conditions enters the nodes' residual on a
    // rigid rotation already, with the opposite share of the nodes inside:
    // formulation.md.
    return of_nodes + direction * rotation_moment(shell, supports);
  }

  Balance::Balance(const SolvedShell &shell, const Point<spacedim> &origin)
  {
    Supports supports;
    supports.all = true;
    for (unsigned int c = 0; c < spacedim; ++c)
      {
        reactions.force[c] =
          reaction(shell, supports, Point<spacedim>::unit_vector(c));
        reactions.moment[c] = reaction_moment(shell,
                                              supports,
                                              Point<spacedim>::unit_vector(c),
                                              origin);
      }

    Vector f(shell.discretization.locally_owned_dofs(),
             shell.discretization.communicator());
    shell.assembly.loads(shell.displacement, f, shell.actions.loads);
    loads = resultant(shell, f, origin);
    if (shell.mass == nullptr && !has_deformed_levers(shell))
      return;
    // What the residual of all nodes holds beside loads and reactions.
    const Resultant all = resultant(shell, shell.residual, origin);
    Resultant &rest = (shell.mass != nullptr ? inertia : internal).emplace();
    rest.force      = -1. * (all.force + loads.force);
    rest.moment =
      -1. * (all.moment + loads.moment + rotation_moment(shell, supports));
  }

  void
  write_balance(const Balance         &balance,
                const Point<spacedim> &origin,
                std::ostream          &out)
  {
    const auto row = [&](const std::string &name, const Resultant &r) {
      out << "  " << std::left << std::setw(10) << name << std::right;
      for (const auto &v : {r.force, r.moment})
        for (unsigned int c = 0; c < spacedim; ++c)
          out << std::setw(15) << v[c];
      out << '\n';
    };
    const auto flags     = out.flags();
    const auto precision = out.precision();
    out << "Balance of forces, and of moments about (" << origin[0] << ", "
        << origin[1] << ", " << origin[2] << "):\n"
        << std::scientific << std::setprecision(6) << std::setw(12) << "";
    for (const auto *const name : {"Fx", "Fy", "Fz", "Mx", "My", "Mz"})
      out << std::setw(15) << name;
    out << '\n';
    Resultant sum = balance.loads;
    sum += balance.reactions;
    row("loads", balance.loads);
    row("reactions", balance.reactions);
    for (const auto &[name, rest] :
         {std::make_pair("inertia", &balance.inertia),
          std::make_pair("internal", &balance.internal)})
      if (*rest)
        {
          sum += **rest;
          row(name, **rest);
        }
    row("sum", sum);
    out.flags(flags);
    out.precision(precision);
  }
} // namespace Nacre
