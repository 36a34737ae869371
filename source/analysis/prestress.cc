// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/prestress.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/stress_stiffness.h>
#include <nacre/mechanics/surface_axes.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  namespace
  {
    /** (N11, N22, N12) along the unit vector @p e_1 and across, as n^ab. */
    Voigt<>
    contravariant_force(const Tensor<1, 3>        &N,
                        const Tensor<1, spacedim> &e_1,
                        const SurfaceFrame<>      &frame)
    {
      const auto e_2 = cross_product_3d(frame.t0, e_1);
      const auto N_1 = N[0] * e_1 + N[2] * e_2;
      const auto N_2 = N[2] * e_1 + N[1] * e_2;
      Voigt<>    n;
      for (unsigned int v = 0; v < 3; ++v)
        {
          const auto &a_a = frame.a_con[v == 1 ? 1 : 0];
          const auto &a_b = frame.a_con[v == 0 ? 0 : 1];
          n[v] = (N_1 * a_a) * (e_1 * a_b) + (N_2 * a_a) * (e_2 * a_b);
        }
      return n;
    }

    /**
     * Of central differences along a displacement whose gradient is at most
     * @p gradient: small to the state, large to round-off. With no gradient
     * only initial strains change.
     */
    double
    difference_step(const double gradient)
    {
      return gradient > 0. ? 1e-3 / gradient : 1.;
    }
  } // namespace

  Prestress::Prestress(const Discretization &discretization,
                       const Assembly       &assembly,
                       const ShellModel     &model,
                       const ModeOptions    &options)
    : discretization_(discretization)
    , assembly_(assembly)
    , model_(model)
    , options_(options)
  {
    const DisplacementConditions conditions(discretization, model.supports);
    constraints_.copy_from(conditions.constraints());
    relevant_dofs_ = conditions.relevant_dofs();
    for (const auto &line : conditions.constraints().get_lines())
      constraints_.set_inhomogeneity(line.index, 0.);
  }

  Prestress::Vector
  Prestress::ghosted(const Vector &owned) const
  {
    Vector result(discretization_.locally_owned_dofs(),
                  relevant_dofs_,
                  discretization_.communicator());
    result = owned;
    return result;
  }

  void
  Prestress::assemble_stiffness(Matrix &K) const
  {
    assembly_.reinit_matrix(constraints_, K);
    Vector       unused(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    const Vector zero = ghosted(unused);
    assembly_.assemble(zero,
                       assembly_.actions({0., 0.}),
                       constraints_,
                       K,
                       unused);
  }

  bool
  Prestress::acts(const double time) const
  {
    const Instant instant = model_.at(time);
    if (options_.prestress == PrestressKind::membrane_force)
      return instant.factor != 0.;
    if (options_.prestress == PrestressKind::none)
      return false;
    const DisplacementConditions conditions(discretization_,
                                            model_.supports,
                                            instant);
    double                       largest = 0.;
    for (const auto &line : conditions.constraints().get_lines())
      largest = std::max(largest, std::abs(line.inhomogeneity));
    Vector       force(discretization_.locally_owned_dofs(),
                 discretization_.communicator());
    const Vector zero = ghosted(force);
    assembly_.residual(zero, assembly_.actions(instant), force);
    return Utilities::MPI::max(largest, discretization_.communicator()) > 0. ||
           force.linfty_norm() > 0.;
  }

  Prestress::Vector
  Prestress::solve(const Matrix &K,
                   const double  time,
                   LinearSolver &solver) const
  {
    Vector u(discretization_.locally_owned_dofs(),
             discretization_.communicator());
    if (options_.prestress == PrestressKind::none ||
        options_.prestress == PrestressKind::membrane_force)
      return ghosted(u);
    const Instant                instant = model_.at(time);
    const DisplacementConditions conditions(discretization_,
                                            model_.supports,
                                            instant);
    const bool                   is_moved =
      std::any_of(conditions.constraints().get_lines().begin(),
                  conditions.constraints().get_lines().end(),
                  [](const auto &line) { return line.inhomogeneity != 0.; });
    AssertThrow(!model_.loads.pressure_follows() ||
                  Utilities::MPI::max(int(is_moved),
                                      discretization_.communicator()) == 0,
                ExcMessage("Loads/Pressure follows: a prestress of prescribed "
                           "displacements takes a pressure that doesn't "
                           "follow."));
    Matrix       matrix;
    Vector       force(u);
    const Vector zero = ghosted(u);
    assembly_.reinit_matrix(conditions.constraints(), matrix);
    assembly_.assemble(zero,
                       assembly_.actions(instant),
                       conditions.constraints(),
                       matrix,
                       force);
    // A following pressure has put its stiffness into that matrix.
    solver.prepare({K, conditions.constraints()});
    check_regular(solver.solve(u, force).is_regular);
    conditions.constraints().distribute(u);
    return ghosted(u);
  }

  void
  Prestress::add(const Vector &u,
                 const double  time,
                 const double  factor,
                 Matrix       &matrix) const
  {
    const Instant instant = model_.at(time);
    switch (options_.prestress)
      {
        case PrestressKind::none:
          return;
        case PrestressKind::membrane_force:
          add_membrane_force(instant, factor, matrix);
          add_load_stiffness(instant, factor, matrix);
          break;
        case PrestressKind::linear:
          {
            Vector scaled(u);
            scaled *= factor;
            StressStiffness(discretization_,
                            *model_.section,
                            model_.kinematics.membrane_strain)
              .add(scaled,
                   constraints_,
                   matrix,
                   {instant.time, factor * instant.factor});
            add_load_stiffness(instant, factor, matrix);
            break;
          }
        case PrestressKind::forces_and_moments:
        case PrestressKind::tangent:
          add_tangent_derivative(u, time, factor, matrix);
          break;
      }
    matrix.compress(VectorOperation::add);
    clear_constrained(matrix);
  }

  void
  Prestress::add_membrane_force(const Instant &instant,
                                const double   factor,
                                Matrix        &matrix) const
  {
    StressStiffness(discretization_,
                    *model_.section,
                    model_.kinematics.membrane_strain)
      .add(
        [&](const ShellCellValues &values, const unsigned int q) {
          const auto point = values.point(q);
          const auto N     = factor * options_.membrane_force(point, instant);
          return contravariant_force(
            N,
            projected_direction(options_.force_axis(point),
                                values.frame(q).t0,
                                point,
                                "Analysis/Membrane force axis"),
            values.frame(q));
        },
        constraints_,
        matrix);
    matrix.compress(VectorOperation::add);
  }

  void
  Prestress::add_load_stiffness(const Instant &instant,
                                const double   factor,
                                Matrix        &matrix) const
  {
    if (!model_.loads.pressure_follows())
      return;
    // The tangent at rest is K less the load stiffness, which is linear in the
    // load.
    Matrix tangent;
    assembly_.reinit_matrix(constraints_, tangent);
    Vector       unused(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    const Vector zero = ghosted(unused);
    for (const double sign : {1., -1.})
      {
        assembly_.assemble(zero,
                           assembly_.actions(
                             {instant.time, sign > 0. ? instant.factor : 0.}),
                           constraints_,
                           tangent,
                           unused);
        matrix.add(sign * factor, tangent);
      }
  }

  double
  Prestress::largest_gradient(const Vector &u) const
  {
    const auto     &element = discretization_.element();
    ShellCellValues values(discretization_, element.full_quadrature(), false);
    std::vector<types::global_dof_index> dofs(values.n_dofs());
    double                               largest = 0.;
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        values.reinit_frames(part);
        const auto &shapes = values.shapes();
        for (unsigned int q = 0; q < values.n_points(); ++q)
          {
            std::array<Tensor<1, spacedim>, 2> du;
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              for (unsigned int c = 0; c < spacedim; ++c)
                for (unsigned int alpha = 0; alpha < 2; ++alpha)
                  du[alpha][c] +=
                    shapes.gradient(q, a)[alpha] * u(dofs[values.dof(a, c)]);
            const auto &a_con = values.frame(q).a_con;
            largest           = std::max(largest,
                               du[0].norm() * a_con[0].norm() +
                                 du[1].norm() * a_con[1].norm());
          }
      }
    return Utilities::MPI::max(largest, discretization_.communicator());
  }

  void
  Prestress::add_tangent_derivative(const Vector &u,
                                    const double  time,
                                    const double  factor,
                                    Matrix       &matrix) const
  {
    const double gradient = largest_gradient(u);
    if (gradient == 0. && !model_.section->has_initial_strain())
      return;
    ShellParts parts(model_);
    parts.kinematics.model = KinematicsModel::finite;
    // The stress part vanishes at rest: its derivative is that of the forces
    // and moments, times the second variations of the strains at rest.
    parts.kinematics.tangent =
      options_.prestress == PrestressKind::forces_and_moments ?
        TangentType::stress :
        TangentType::consistent;
    const Assembly finite(discretization_, parts);
    const Instant  instant = model_.at(time);
    differentiate(
      finite,
      [&](const double place) {
        Vector state(u);
        state *= place;
        return std::make_pair(state,
                              Instant{instant.time, place * instant.factor});
      },
      difference_step(gradient),
      factor,
      matrix);
  }

  void
  Prestress::assemble_tangent(const Vector &u,
                              const double  time,
                              Matrix       &K) const
  {
    assembly_.reinit_matrix(constraints_, K);
    Vector unused(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    assembly_.assemble(u,
                       assembly_.actions(model_.at(time)),
                       constraints_,
                       K,
                       unused);
  }

  void
  Prestress::add_tangent_rate(const Vector &u,
                              const Vector &velocity,
                              const double  time,
                              const double  factor,
                              Matrix       &matrix) const
  {
    const double gradient = largest_gradient(velocity);
    AssertThrow(gradient > 0. || model_.section->has_initial_strain(),
                ExcMessage("Analysis/Start from: no load and no prescribed "
                           "displacement depends on t at that state, so that "
                           "nothing makes it buckle."));
    differentiate(
      assembly_,
      [&](const double place) {
        Vector state(u);
        state.add(place, velocity);
        return std::make_pair(state, model_.at(time + place));
      },
      difference_step(gradient),
      factor,
      matrix);
    matrix.compress(VectorOperation::add);
    clear_constrained(matrix);
  }

  void
  Prestress::differentiate(const Assembly &assembly,
                           const Line     &line,
                           const double    step,
                           const double    factor,
                           Matrix         &matrix) const
  {
    Matrix tangent;
    assembly.reinit_matrix(constraints_, tangent);
    Vector unused(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
    // Central differences of two steps, extrapolated: the error is of the
    // fourth order in displacement gradients of size 1e-3.
    const std::pair<double, double> stencil[] = {{1., 2. / 3.},
                                                 {-1., -2. / 3.},
                                                 {2., -1. / 12.},
                                                 {-2., 1. / 12.}};
    for (const auto &[place, weight] : stencil)
      {
        const auto [state, instant] = line(place * step);
        assembly.assemble(state,
                          assembly.actions(instant),
                          constraints_,
                          tangent,
                          unused);
        matrix.add(factor * weight / step, tangent);
      }
  }

  void
  Prestress::clear_constrained(Matrix &matrix) const
  {
    for (const auto &line : constraints_.get_lines())
      if (discretization_.locally_owned_dofs().is_element(line.index))
        matrix.set(line.index, line.index, 0.);
    matrix.compress(VectorOperation::insert);
  }
} // namespace Nacre
