// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// What is asked of edges outside of the assembly.

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/problem/boundary_conditions.h>

#include <algorithm>

namespace Nacre
{
  std::vector<PrescribedRotation>
  ShellOperator::prescribed_rotations(
    const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
    const unsigned int                                     face,
    const Expression                                      &rotation,
    const ShellEdgeValues                                 &edge) const
  {
    const auto *const               turns = turns_.find(cell, face);
    std::vector<PrescribedRotation> result(edge.n_points());
    for (unsigned int q = 0; q < result.size(); ++q)
      {
        result[q].angle = rotation(edge.point(q));
        if (turns != nullptr)
          result[q].turn = (*turns)[q];
      }
    return result;
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
  ShellOperator::largest_rotation_gap(const Vector &u) const
  {
    const auto &edges = boundary_conditions_.edges();
    if (std::none_of(edges.begin(), edges.end(), [](const auto &edge) {
          return edge.second.rotation != nullptr;
        }))
      return {};
    run_on_all_ranks(discretization_.communicator(),
                     [&]() { turns_.update(); });
    const auto             kinematics = kinematics_->clone();
    ShellEdgeValues        edge(discretization_);
    dealii::Vector<double> local;
    RotationGap            mine;
    for (const auto &[id, conditions] : edges)
      if (conditions.rotation != nullptr)
        for (const auto &cell :
             discretization_.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto f : cell->face_indices())
              if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
                {
                  edge.reinit(cell, f);
                  local.reinit(edge.n_dofs());
                  for (unsigned int i = 0; i < edge.n_dofs(); ++i)
                    local[i] = u(edge.dof_indices()[i]);
                  const auto rotations =
                    prescribed_rotations(cell, f, *conditions.rotation, edge);
                  for (unsigned int q = 0; q < rotations.size(); ++q)
                    {
                      const double angle =
                        kinematics->rotation_gap(edge, q, rotations[q], local);
                      if (!(angle <= mine.angle))
                        mine = {angle, edge.point(q)};
                    }
                }
    RotationGap largest;
    for (const auto &[angle, position] :
         Utilities::MPI::all_gather(discretization_.communicator(),
                                    std::make_pair(mine.angle, mine.position)))
      if (!(angle <= largest.angle))
        largest = {angle, position};
    return largest;
  }
} // namespace Nacre
