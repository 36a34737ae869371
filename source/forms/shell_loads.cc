// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The vector of all loads.

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/problem/loads.h>

namespace Nacre
{
  void
  ShellOperator::loads(const Vector &u, Vector &result) const
  {
    result                            = 0.;
    const auto             kinematics = kinematics_->clone();
    ShellEdgeValues        edge(discretization_);
    dealii::Vector<double> local_u;
    LocalTerms             terms;
    terms.wants_tangent = false;
    const auto begin    = [&](const auto &dofs) {
      local_u.reinit(dofs.size());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        local_u[i] = u(dofs[i]);
      terms.reinit(dofs.size());
    };
    const auto end = [&](const auto &dofs) {
      terms.residual *= -1.;
      result.add(dofs,
                 std::vector<double>(terms.residual.begin(),
                                     terms.residual.end()));
    };
    std::vector<types::global_dof_index> dofs(
      discretization_.node_dofs().size());
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const auto &cell :
           discretization_.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(dofs);
            begin(dofs);
            kinematics->add_cell_terms(cell, local_u, terms);
            terms.residual = 0.;
            subtract_surface_loads(kinematics->cell_values(), terms.residual);
            if (loads_.pressure_follows())
              subtract_following_pressure(kinematics->cell_values(),
                                          local_u,
                                          terms);
            end(dofs);
            for (const auto f : cell->face_indices())
              if (cell->at_boundary(f))
                {
                  edge.reinit(cell, f);
                  begin(edge.dof_indices());
                  add_edge_loads(cell->face(f)->boundary_id(),
                                 edge,
                                 local_u,
                                 *kinematics,
                                 terms);
                  end(edge.dof_indices());
                }
          }
    });
    result.compress(VectorOperation::add);
    AffineConstraints<double> none;
    none.close();
    add_point_forces(none, 1., result);
  }
} // namespace Nacre
