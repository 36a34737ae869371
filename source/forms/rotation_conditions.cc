// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/edge_turns.h>
#include <nacre/forms/rotation_conditions.h>
#include <nacre/problem/boundary_conditions.h>

#include <algorithm>

namespace Nacre
{
  RotationConditions::RotationConditions(const Discretization &discretization,
                                         const BoundaryConditions &conditions,
                                         const Expression         *load_factor,
                                         const EdgePenalty        &penalty,
                                         const Kinematics         &kinematics)
    : discretization_(discretization)
    , conditions_(conditions)
    , load_factor_(load_factor)
    , penalty_(penalty)
    , kinematics_(kinematics)
  {}

  dealii::Vector<double>
  RotationConditions::Edge::extract(const Vector &u) const
  {
    dealii::Vector<double> local(values.n_dofs());
    for (unsigned int i = 0; i < local.size(); ++i)
      local[i] = u(values.dof_indices()[i]);
    return local;
  }

  void
  RotationConditions::for_each(
    const std::function<void(const Edge &)> &work) const
  {
    const auto &edges = conditions_.edges();
    if (std::none_of(edges.begin(), edges.end(), [](const auto &edge) {
          return edge.second.rotation != nullptr;
        }))
      return;
    ShellEdgeValues values(discretization_);
    for (const CellPart &part : discretization_.owned_parts())
      for (const auto f : part.cell->face_indices())
        if (part.cell->at_boundary(f))
          {
            const auto found = edges.find(part.cell->face(f)->boundary_id());
            if (found == edges.end() || found->second.rotation == nullptr)
              continue;
            for (const auto &piece :
                 discretization_.cell_parts().pieces_of(part, f))
              {
                if (part.is_cut())
                  values.reinit(piece);
                else
                  values.reinit(part.cell, f);
                work({piece, found->second, values});
              }
          }
  }

  PrescribedRotations
  RotationConditions::evaluate(const Instant &instant) const
  {
    PrescribedRotations rotations;
    const auto          evaluate_edge = [&](const Edge &edge) {
      auto &result = rotations[edge.place()];
      result.resize(edge.values.n_points());
      for (unsigned int q = 0; q < result.size(); ++q)
        result[q].angle =
          (*edge.conditions.rotation)(edge.values.point(q), instant);
      if (load_factor_ == nullptr || !edge.conditions.may_turn())
        return;
      const auto turns = follow_edge_turns(discretization_,
                                           edge.values,
                                           edge.conditions,
                                           *load_factor_,
                                           instant.time);
      for (unsigned int q = 0; q < result.size(); ++q)
        result[q].turn = turns[q];
    };
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(),
                     [&]() { for_each(evaluate_edge); });
    return rotations;
  }

  double
  RotationConditions::work(const StepStart    &start,
                           const Vector       &u_end,
                           const ShellActions &end) const
  {
    const auto kinematics = kinematics_.clone();
    kinematics->set_instant(end.loads);
    LocalTerms terms;
    double     sum      = 0.;
    terms.wants_tangent = false;
    for_each([&](const Edge &edge) {
      terms.reinit(edge.values.n_dofs());
      kinematics->add_rotation_step_terms(edge.values,
                                          penalty_.boundary(edge.part()),
                                          start.rotations.at(edge.place()),
                                          end.rotations.at(edge.place()),
                                          edge.extract(start.u),
                                          edge.extract(u_end),
                                          terms);
      sum += terms.rotation_work;
    });
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }

  Tensor<1, spacedim>
  RotationConditions::reaction(const types::boundary_id id,
                               const Vector            &u,
                               const ShellActions      &actions,
                               const bool has_deformed_levers) const
  {
    const auto kinematics = kinematics_.clone();
    kinematics->set_instant(actions.loads);
    LocalTerms          terms;
    Tensor<1, spacedim> sum;
    terms.wants_tangent = false;
    for_each([&](const Edge &edge) {
      const auto &side = edge.piece.sides[0];
      if (side.part.cell->face(side.face)->boundary_id() != id)
        return;
      const dealii::Vector<double> local = edge.extract(u);
      terms.reinit(local.size());
      kinematics->add_rotation_terms(edge.values,
                                     penalty_.boundary(edge.part()),
                                     actions.rotations.at(edge.place()),
                                     local,
                                     terms);
      // Virtual work on the rigid rotation e_k x x.
      const auto nodes = discretization_.node_positions(edge.part());
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          Tensor<1, spacedim> x(nodes[a]), force;
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              force[c] = terms.residual[edge.values.dof(0, a, c)];
              if (has_deformed_levers)
                x[c] += local[edge.values.dof(0, a, c)];
            }
          sum += cross_product_3d(x, force);
        }
    });
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }

  RotationConditions::Gap
  RotationConditions::largest_gap(const Vector              &u,
                                  const PrescribedRotations &rotations) const
  {
    const auto kinematics = kinematics_.clone();
    Gap        mine;
    for_each([&](const Edge &edge) {
      const dealii::Vector<double> local   = edge.extract(u);
      const auto                  &of_edge = rotations.at(edge.place());
      for (unsigned int q = 0; q < of_edge.size(); ++q)
        {
          const double angle =
            kinematics->rotation_gap(edge.values, q, of_edge[q], local);
          if (!(angle <= mine.angle))
            mine = {angle, edge.values.point(q)};
        }
    });
    Gap largest;
    for (const auto &[angle, position] :
         Utilities::MPI::all_gather(discretization_.communicator(),
                                    std::make_pair(mine.angle, mine.position)))
      if (!(angle <= largest.angle))
        largest = {angle, position};
    return largest;
  }
} // namespace Nacre
