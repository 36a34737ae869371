// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/load_terms.h>
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
  } // namespace

  LoadTerms::LoadTerms(const Discretization &discretization,
                       const SectionLaw     &section,
                       const Loads          &loads)
    : discretization_(discretization)
    , section_(section)
    , loads_(loads)
  {
    for (const auto &force : loads_.point_forces())
      force_points_.push_back(
        discretization_.locate(force.position, force.source));
  }

  bool
  LoadTerms::act_on(const types::boundary_id id) const
  {
    return loads_.edge_forces().count(id) > 0 ||
           loads_.edge_moments().count(id) > 0;
  }

  void
  LoadTerms::subtract_on_cell(const ShellCellValues        &values,
                              const dealii::Vector<double> &u,
                              const dealii::Vector<double> &u_start,
                              const Instant                &instant,
                              LocalTerms                   &terms) const
  {
    if (!loads_.no_surface_load())
      subtract_surface_loads(values, instant, terms.residual);
    if (loads_.pressure_follows())
      subtract_following_pressure(values, u, u_start, instant, terms);
  }

  void
  LoadTerms::subtract_surface_loads(const ShellCellValues  &values,
                                    const Instant          &instant,
                                    dealii::Vector<double> &residual) const
  {
    const auto               &shapes = values.shapes();
    const unsigned int *const dofs   = discretization_.node_dofs().data();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   x            = values.point(q);
        const double area_density = section_.density(x) * section_.thickness(x);
        const auto   load =
          values.JxW(q) *
          loads_.force_per_area(x, values.frame(q).t0, area_density, instant);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            residual[dofs[spacedim * a + c]] -= shapes.value(q, a) * load[c];
      }
  }

  void
  LoadTerms::subtract_following_pressure(const ShellCellValues        &values,
                                         const dealii::Vector<double> &u,
                                         const dealii::Vector<double> &u_start,
                                         const Instant                &instant,
                                         LocalTerms &terms) const
  {
    const auto &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   du  = displacement_gradient(values, q, u);
        const auto  &a   = values.frame(q).a_cov;
        const auto   phi = std::array<Vector3, 2>{{a[0] + du[0], a[1] + du[1]}};
        const double p   = loads_.pressure(values.point(q), instant) *
                         values.JxW(q) / values.frame(q).j0;
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
                  terms.tangent(values.dof(a, c), values.dof(b, e)) -= w * m[d];
                  terms.tangent(values.dof(a, c), values.dof(b, d)) += w * m[e];
                }
          }
      }
  }

  void
  LoadTerms::subtract_on_edge(const types::boundary_id      id,
                              const ShellEdgeValues        &edge,
                              const dealii::Vector<double> &u,
                              const Instant                &instant,
                              Kinematics                   &kinematics,
                              LocalTerms                   &terms) const
  {
    const auto moment = loads_.edge_moments().find(id);
    if (moment != loads_.edge_moments().end())
      {
        std::vector<double> values(edge.n_points());
        for (unsigned int q = 0; q < values.size(); ++q)
          values[q] = moment->second(edge.point(q), instant);
        kinematics.add_moment_terms(edge, values, u, terms);
      }
    const auto force = loads_.edge_forces().find(id);
    if (force == loads_.edge_forces().end())
      return;
    const auto &shapes = edge.shapes(0);
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        const auto f = edge.JxW(q) * force->second(edge.point(q), instant);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[edge.dof(0, a, c)] -= shapes.value(q, a) * f[c];
      }
  }

  void
  LoadTerms::add_point_forces(const AffineConstraints<double> &constraints,
                              const double                     factor,
                              const Instant                   &instant,
                              TrilinosWrappers::MPI::Vector   &vector) const
  {
    const auto &fe = discretization_.scalar_fe();
    for (unsigned int k = 0; k < force_points_.size(); ++k)
      {
        // On all ranks: a value that isn't finite must throw on all.
        const auto &load  = loads_.point_forces()[k];
        const auto  force = load.force(load.position, instant);
        const auto &place = force_points_[k];
        if (!place.is_mine)
          continue;
        const auto             n = discretization_.node_dofs().size();
        dealii::Vector<double> local(n);
        std::vector<types::global_dof_index> dofs(n);
        place.cell->get_dof_indices(dofs);
        for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            local[discretization_.node_dofs()[spacedim * a + c]] =
              factor * fe.shape_value(a, place.unit) * force[c];
        constraints.distribute_local_to_global(local, dofs, vector);
      }
    vector.compress(VectorOperation::add);
  }
} // namespace Nacre
