// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// What acts on a shell from outside: following pressure, the vector of all
// loads, the work of prescribed rotations.

#include <nacre/base/mpi_errors.h>
#include <nacre/base/mutation.h>
#include <nacre/forms/shell_operator.h>
#include <nacre/problem/boundary_conditions.h>
#include <nacre/problem/loads.h>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    /** u,1 and u,2 at the point @p q; zero if @p u is empty. */
    std::array<Vector3, 2>
    displacement_gradient(const ShellCellValues        &values,
                          const unsigned int            q,
                          const dealii::Vector<double> &u)
    {
      std::array<Vector3, 2> du;
      for (unsigned int a = 0; u.size() > 0 && a < values.shapes().n_nodes();
           ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            du[alpha][c] +=
              values.shapes().gradient(q, a)[alpha] * u[values.dof(a, c)];
      return du;
    }

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
  ShellOperator::subtract_following_pressure(
    const ShellCellValues        &values,
    const dealii::Vector<double> &u,
    const dealii::Vector<double> &u_start,
    LocalTerms                   &terms) const
  {
    const auto &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   du  = displacement_gradient(values, q, u);
        const auto  &a   = values.frame(q).a_cov;
        const auto   phi = std::array<Vector3, 2>{{a[0] + du[0], a[1] + du[1]}};
        const double p =
          loads_.pressure(values.point(q)) * values.JxW(q) / values.frame(q).j0;
        Vector3 force = p * cross_product_3d(phi[0], phi[1]);
        if (u_start.size() > 0)
          {
            // The mean over phi + s Delta(phi), s from -1/2 to 1/2, and
            // Delta(phi) = 2 (u - u_start)
            const auto start = displacement_gradient(values, q, u_start);
            force +=
              p / 3. * cross_product_3d(du[0] - start[0], du[1] - start[1]);
          }
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[values.dof(a, c)] -= shapes.value(q, a) * force[c];
        if (!terms.wants_tangent)
          continue;
        for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
          {
            // d(phi,1 x phi,2) = du,1 x phi,2 + phi,1 x du,2 = m x du
            const auto m = shapes.gradient(q, b)[1] * phi[0] -
                           shapes.gradient(q, b)[0] * phi[1];
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const unsigned int d = (c + 1) % 3, e = (c + 2) % 3;
                  const double       w = p * shapes.value(q, a);
                  terms.tangent(values.dof(a, c), values.dof(b, e)) -=
                    NACRE_MUTABLE(following_tangent, 1., -1.) * w * m[d];
                  terms.tangent(values.dof(a, c), values.dof(b, d)) += w * m[e];
                }
          }
      }
  }

  std::vector<double>
  ShellOperator::prescribed_rotation(const types::boundary_id id,
                                     const ShellEdgeValues   &edge) const
  {
    const auto conditions = boundary_conditions_.edges().find(id);
    if (conditions == boundary_conditions_.edges().end() ||
        conditions->second.rotation == nullptr)
      return {};
    std::vector<double> rotation(edge.n_points());
    for (unsigned int q = 0; q < rotation.size(); ++q)
      rotation[q] = (*conditions->second.rotation)(edge.point(q));
    return rotation;
  }

  void
  ShellOperator::loads(const Vector &u,
                       const Vector &u_start,
                       Vector       &result) const
  {
    result                                          = 0.;
    const auto                           kinematics = kinematics_->clone();
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
            if (!loads_.no_surface_load())
              subtract_surface_loads(kinematics->cell_values(), terms.residual);
            if (loads_.pressure_follows())
              subtract_following_pressure(kinematics->cell_values(),
                                          extract(u, dofs),
                                          extract(u_start, dofs),
                                          terms);
            add(terms.residual, dofs, result);
            for (const auto f : cell->face_indices())
              {
                const auto id = cell->face(f)->boundary_id();
                if (!cell->at_boundary(f) ||
                    (loads_.edge_forces().count(id) == 0 &&
                     loads_.edge_moments().count(id) == 0))
                  continue;
                edge.reinit(cell, f);
                terms.reinit(edge.n_dofs());
                add_edge_loads(id,
                               edge,
                               extract(u, edge.dof_indices()),
                               *kinematics,
                               terms);
                add(terms.residual, edge.dof_indices(), result);
              }
          }
    });
    result.compress(VectorOperation::add);
    result *= -1.;
    AffineConstraints<double> none;
    none.close();
    add_point_forces(none, 1., result);
  }

  PrescribedRotations
  ShellOperator::prescribed_rotations() const
  {
    PrescribedRotations rotations;
    ShellEdgeValues     edge(discretization_);
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const auto &cell :
           discretization_.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto f : cell->face_indices())
            {
              if (!cell->at_boundary(f))
                continue;
              const auto id         = cell->face(f)->boundary_id();
              const auto conditions = boundary_conditions_.edges().find(id);
              if (conditions == boundary_conditions_.edges().end() ||
                  conditions->second.rotation == nullptr)
                continue;
              edge.reinit(cell, f);
              rotations[{cell->active_cell_index(), f}] =
                prescribed_rotation(id, edge);
            }
    });
    return rotations;
  }

  double
  ShellOperator::rotation_work(const StepStart &start,
                               const Vector    &u_end) const
  {
    const auto      kinematics = kinematics_->clone();
    ShellEdgeValues edge(discretization_);
    LocalTerms      terms;
    double          sum = 0.;
    terms.wants_tangent = false;
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const auto &cell :
           discretization_.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto f : cell->face_indices())
            {
              const auto before =
                start.rotations.find({cell->active_cell_index(), f});
              if (before == start.rotations.end())
                continue;
              edge.reinit(cell, f);
              terms.reinit(edge.n_dofs());
              kinematics->add_rotation_step_terms(
                edge,
                penalty_.boundary(cell),
                before->second,
                prescribed_rotation(cell->face(f)->boundary_id(), edge),
                extract(start.u, edge.dof_indices()),
                extract(u_end, edge.dof_indices()),
                terms);
              sum += terms.rotation_work;
            }
    });
    return Utilities::MPI::sum(sum, discretization_.communicator());
  }
} // namespace Nacre
