// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// What acts on a shell from outside: the vector of all loads, the work of
// prescribed rotations.

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/shell_operator.h>

namespace Nacre
{
  namespace
  {
    dealii::Vector<double>
    extract(const TrilinosWrappers::MPI::Vector        &u,
            const std::vector<types::global_dof_index> &dofs)
    {
      dealii::Vector<double> local(dofs.size());
      for (unsigned int i = 0; i < dofs.size(); ++i)
        local[i] = u(dofs[i]);
      return local;
    }

    void
    add(const dealii::Vector<double>               &local,
        const std::vector<types::global_dof_index> &dofs,
        TrilinosWrappers::MPI::Vector              &result)
    {
      result.add(dofs, std::vector<double>(local.begin(), local.end()));
    }
  } // namespace

  void
  ShellOperator::loads(const Vector  &u,
                       const Vector  *u_start,
                       Vector        &result,
                       const Instant &instant) const
  {
    result                                          = 0.;
    const auto                           kinematics = kinematics_->clone();
    const dealii::Vector<double>         none;
    ShellEdgeValues                      edge(discretization_);
    LocalTerms                           terms;
    std::vector<types::global_dof_index> dofs(
      discretization_.node_dofs().size());
    terms.wants_tangent = false;
    // The user's expressions may be undefined on the cells of one rank only.
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const auto &cell :
           discretization_.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            cell->get_dof_indices(dofs);
            terms.reinit(dofs.size());
            kinematics->reinit_cell_values(cell);
            load_terms_.subtract_on_cell(kinematics->cell_values(),
                                         extract(u, dofs),
                                         u_start ? extract(*u_start, dofs) :
                                                   none,
                                         instant,
                                         terms);
            add(terms.residual, dofs, result);
            for (const auto f : cell->face_indices())
              if (cell->at_boundary(f) &&
                  load_terms_.act_on(cell->face(f)->boundary_id()))
                {
                  edge.reinit(cell, f);
                  terms.reinit(edge.n_dofs());
                  load_terms_.subtract_on_edge(cell->face(f)->boundary_id(),
                                               edge,
                                               extract(u, edge.dof_indices()),
                                               instant,
                                               *kinematics,
                                               terms);
                  add(terms.residual, edge.dof_indices(), result);
                }
          }
    });
    result.compress(VectorOperation::add);
    result *= -1.;
    AffineConstraints<double> free;
    free.close();
    load_terms_.add_point_forces(free, 1., instant, result);
  }

  double
  ShellOperator::rotation_work(const StepStart           &start,
                               const Vector              &u_end,
                               const PrescribedRotations &end) const
  {
    const auto      kinematics = kinematics_->clone();
    ShellEdgeValues edge(discretization_);
    LocalTerms      terms;
    double          sum = 0.;
    terms.wants_tangent = false;
    for_each_rotation([&](const Cell        &cell,
                          const unsigned int f,
                          const EdgeConditions &) {
      const std::pair<unsigned, unsigned> place{cell->active_cell_index(), f};
      edge.reinit(cell, f);
      terms.reinit(edge.n_dofs());
      kinematics->add_rotation_step_terms(edge,
                                          penalty_.boundary(cell),
                                          start.rotations.at(place),
                                          end.at(place),
                                          extract(start.u, edge.dof_indices()),
                                          extract(u_end, edge.dof_indices()),
                                          terms);
      sum += terms.rotation_work;
    });
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }
} // namespace Nacre
