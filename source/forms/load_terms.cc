// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
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

    /** Add minus the load, as a residual, on the one side of an edge. */
    void
    add_line_load(const LineLoad &load, const TermEdge &edge, LocalTerms &terms)
    {
      const ShellEdgeValues &values  = edge.values;
      const Instant         &instant = edge.actions.loads;
      if (load.moment != nullptr)
        {
          std::vector<double> moments(values.n_points());
          for (unsigned int q = 0; q < moments.size(); ++q)
            moments[q] = load.moment_at(values.point(q), instant);
          edge.kinematics.add_moment_terms(values,
                                           moments,
                                           edge.state.u,
                                           terms);
        }
      if (load.force == nullptr && load.pressure == nullptr)
        return;
      const auto &shapes = values.shapes(0);
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          const auto f =
            values.JxW(q) *
            load.force_at(values.point(q), values.conormal(0, q), instant);
          for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              terms.residual[values.dof(0, a, c)] -= shapes.value(q, a) * f[c];
          for (unsigned int k = 0; k < values.n_tip_functions(0); ++k)
            terms.residual[values.tip_dof(0, k)] -=
              values.tip_function(0, q, k).value * f;
        }
    }
  } // namespace

  SurfaceLoadTerm::SurfaceLoadTerm(const SectionLaw &section,
                                   const Loads      &loads)
    : LoadTerm(loads)
    , section_(section)
  {}

  void
  SurfaceLoadTerm::add_on_cell(TermCell &cell, LocalTerms &terms) const
  {
    const ShellCellValues &values = cell.values();
    const auto            &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   x            = values.point(q);
        const double area_density = section_.density(x) * section_.thickness(x);
        const auto   load =
          values.JxW(q) * loads_.force_per_area(x,
                                                values.frame(q).t0,
                                                area_density,
                                                cell.actions.loads);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[values.dof(a, c)] -= shapes.value(q, a) * load[c];
        for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
          terms.residual[values.tip_dof(k)] -=
            values.tip_function(q, k).value * load;
      }
  }

  void
  FollowingPressureTerm::add_on_cell(TermCell &cell, LocalTerms &terms) const
  {
    const ShellCellValues &values = cell.values();
    const LocalState      &state  = cell.state;
    const auto            &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto   du  = displacement_gradient(values, q, state.u);
        const auto  &a   = values.frame(q).a_cov;
        const auto   phi = std::array<Vector3, 2>{{a[0] + du[0], a[1] + du[1]}};
        const double p = loads_.pressure(values.point(q), cell.actions.loads) *
                         values.JxW(q) / values.frame(q).j0;
        Vector3 force = p * cross_product_3d(phi[0], phi[1]);
        if (state.is_step())
          {
            // The mean over phi + s Delta(phi), s from -1/2 to 1/2, and
            // Delta(phi) = 2 (u - u_start)
            const auto start = displacement_gradient(values, q, state.u_start);
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

  bool
  EdgeLoadTerm::acts_on_boundary(const types::boundary_id id,
                                 const std::pair<unsigned int, unsigned int> &,
                                 const ShellActions &) const
  {
    return !loads_.on_edge(id).is_zero();
  }

  void
  EdgeLoadTerm::add_on_boundary(const TermEdge &edge, LocalTerms &terms) const
  {
    add_line_load(loads_.on_edge(edge.boundary_id), edge, terms);
  }

  bool
  EdgeLoadTerm::acts_on_lips() const
  {
    return loads_.has_lip_loads();
  }

  void
  EdgeLoadTerm::add_on_lip(const TermEdge &edge,
                           const CutLip   &lip,
                           LocalTerms     &terms) const
  {
    add_line_load(loads_.on_lip({lip.cut, lip.is_left}), edge, terms);
  }

  PointForceTerm::PointForceTerm(const Discretization &discretization,
                                 const Loads          &loads)
    : LoadTerm(loads)
    , discretization_(discretization)
  {
    for (const auto &force : loads_.point_forces())
      places_.push_back(discretization_.locate(force.position, force.source));
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const auto &place : places_)
        AssertThrow(!place.is_mine || place.part.enrichment() == nullptr,
                    ExcMessage(
                      "Loads: a point force lies within two cells of "
                      "the tip of a cut, or within 'Cuts/Tip radius' of it, "
                      "where it has functions; refine the mesh, or choose "
                      "'Cuts/Tips = closed'."));
    });
  }

  void
  PointForceTerm::add_point_forces(
    const AffineConstraints<double> &constraints,
    const ShellActions              &actions,
    TrilinosWrappers::MPI::Vector   &right_hand_side) const
  {
    const auto &fe = discretization_.scalar_fe();
    for (unsigned int k = 0; k < places_.size(); ++k)
      {
        // On all ranks: a value that isn't finite must throw on all.
        const auto &load  = loads_.point_forces()[k];
        const auto  force = load.force(load.position, actions.loads);
        const auto &place = places_[k];
        if (!place.is_mine)
          continue;
        std::vector<types::global_dof_index> dofs;
        discretization_.get_dof_indices(place.part, dofs);
        dealii::Vector<double> local(dofs.size());
        for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            local[discretization_.node_dofs()[spacedim * a + c]] =
              fe.shape_value(a, place.unit) * force[c];
        constraints.distribute_local_to_global(local, dofs, right_hand_side);
      }
    right_hand_side.compress(VectorOperation::add);
  }
} // namespace Nacre
