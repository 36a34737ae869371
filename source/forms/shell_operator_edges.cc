// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// What is asked of edges outside of the assembly.

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/edge_turns.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/problem/boundary_conditions.h>

#include <algorithm>

namespace Nacre
{
  void
  ShellOperator::for_each_rotation(
    const std::function<
      void(const Cell &, const unsigned int, const EdgeConditions &)> &work)
    const
  {
    const auto &edges = boundary_conditions_.edges();
    if (std::none_of(edges.begin(), edges.end(), [](const auto &edge) {
          return edge.second.rotation != nullptr;
        }))
      return;
    for (const auto &cell :
         discretization_.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              const auto found = edges.find(cell->face(f)->boundary_id());
              if (found != edges.end() && found->second.rotation != nullptr)
                work(cell, f, found->second);
            }
  }

  PrescribedRotations
  ShellOperator::prescribed_rotations(const Instant &instant) const
  {
    PrescribedRotations rotations;
    ShellEdgeValues     edge(discretization_);
    const auto          evaluate = [&](const Cell           &cell,
                              const unsigned int    f,
                              const EdgeConditions &conditions) {
      edge.reinit(cell, f);
      auto &result = rotations[{cell->active_cell_index(), f}];
      result.resize(edge.n_points());
      for (unsigned int q = 0; q < result.size(); ++q)
        result[q].angle = (*conditions.rotation)(edge.point(q), instant);
      if (load_factor_ == nullptr || !conditions.may_turn())
        return;
      const auto turns = follow_edge_turns(discretization_,
                                           cell,
                                           f,
                                           edge,
                                           conditions,
                                           *load_factor_,
                                           instant.time);
      for (unsigned int q = 0; q < result.size(); ++q)
        result[q].turn = turns[q];
    };
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(),
                     [&]() { for_each_rotation(evaluate); });
    return rotations;
  }

  bool
  ShellOperator::is_consistently_oriented() const
  {
    ShellEdgeValues edge(discretization_);
    bool            consistent = true;
    for (const auto &cell :
         discretization_.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          if (edge.reinit_to_neighbor(cell, f))
            consistent &= (edge.sigma(1, 0) > 0.);
    return Utilities::MPI::min(consistent ? 1 : 0,
                               discretization_.communicator()) == 1;
  }

  ShellOperator::RotationGap
  ShellOperator::largest_rotation_gap(
    const Vector              &u,
    const PrescribedRotations &rotations) const
  {
    const auto             kinematics = kinematics_->clone();
    ShellEdgeValues        edge(discretization_);
    dealii::Vector<double> local;
    RotationGap            mine;
    for_each_rotation(
      [&](const Cell &cell, const unsigned int f, const EdgeConditions &) {
        edge.reinit(cell, f);
        local.reinit(edge.n_dofs());
        for (unsigned int i = 0; i < edge.n_dofs(); ++i)
          local[i] = u(edge.dof_indices()[i]);
        const auto &of_edge = rotations.at({cell->active_cell_index(), f});
        for (unsigned int q = 0; q < of_edge.size(); ++q)
          {
            const double angle =
              kinematics->rotation_gap(edge, q, of_edge[q], local);
            if (!(angle <= mine.angle))
              mine = {angle, edge.point(q)};
          }
      });
    RotationGap largest;
    for (const auto &[angle, position] :
         Utilities::MPI::all_gather(discretization_.communicator(),
                                    std::make_pair(mine.angle, mine.position)))
      if (!(angle <= largest.angle))
        largest = {angle, position};
    return largest;
  }

  Tensor<1, spacedim>
  ShellOperator::rotation_reaction(const types::boundary_id   id,
                                   const Vector              &u,
                                   const PrescribedRotations &rotations) const
  {
    const auto             kinematics = kinematics_->clone();
    ShellEdgeValues        edge(discretization_);
    dealii::Vector<double> local;
    LocalTerms             terms;
    Tensor<1, spacedim>    sum;
    terms.wants_tangent = false;
    for_each_rotation(
      [&](const Cell &cell, const unsigned int f, const EdgeConditions &) {
        if (cell->face(f)->boundary_id() != id)
          return;
        edge.reinit(cell, f);
        terms.reinit(edge.n_dofs());
        local.reinit(edge.n_dofs());
        for (unsigned int i = 0; i < edge.n_dofs(); ++i)
          local[i] = u(edge.dof_indices()[i]);
        kinematics->add_rotation_terms(edge,
                                       penalty_.boundary(cell),
                                       rotations.at(
                                         {cell->active_cell_index(), f}),
                                       local,
                                       terms);
        // Virtual work on the rigid rotation e_k x x.
        const auto nodes = discretization_.node_positions(cell);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            Tensor<1, spacedim> x(nodes[a]), force;
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                force[c] = terms.residual[edge.dof(0, a, c)];
                if (has_deformed_levers_)
                  x[c] += local[edge.dof(0, a, c)];
              }
            sum += cross_product_3d(x, force);
          }
      });
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }
} // namespace Nacre
