// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/shell_strain.h>
#include <nacre/postprocess/part_points.h>
#include <nacre/postprocess/strain_values.h>

#include <cmath>

namespace Nacre
{
  StrainValues::StrainValues(const ShellState      &state,
                             const Quadrature<dim> &points,
                             const bool             spread)
    : membrane_strain_(state.model.kinematics.membrane_strain)
    , is_linear_(state.model.kinematics.model == KinematicsModel::linear)
    , points_(points)
    , spread_(spread)
    , discretization_(state.discretization)
    , displacement_(state.displacement)
    , section_states_(state.section_states)
    , u_(state.discretization.node_dofs().size())
  {
    set_points(points);
  }

  void
  StrainValues::set_points(const Quadrature<dim> &points)
  {
    values_.emplace(discretization_,
                    points,
                    recovers_tied_strain(membrane_strain_),
                    ShellCellValues::Points::given);
    values_->project_on_parts(membrane_strain_ != MembraneStrain::full);
    membrane_.reinit(3 * points.size());
    bending_.reinit(3 * points.size());
  }

  void
  StrainValues::reinit(const CellPart &part)
  {
    part_                 = part;
    const bool was_spread = is_spread_;
    is_spread_            = spread_ && has_blocks(part);
    if (is_spread_)
      set_points(Quadrature<dim>(points_on_part(part, points_.get_points())));
    else if (was_spread)
      set_points(points_);
    discretization_.get_dof_indices(part, dofs_);
    u_.reinit(dofs_.size(), true);
    for (unsigned int i = 0; i < dofs_.size(); ++i)
      u_[i] = displacement_(dofs_[i]);
    if (is_linear_)
      {
        values_->reinit(part);
        values_->membrane_rows().vmult(membrane_, u_);
        values_->bending_rows().vmult(bending_, u_);
      }
    else
      {
        values_->reinit_frames(part);
        fill_finite_strains();
      }
  }

  Tensor<1, spacedim>
  StrainValues::displacement(const unsigned int q) const
  {
    Tensor<1, spacedim> u = tip_displacement(q).value;
    for (unsigned int a = 0; a < values_->shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        u[c] += values_->shapes().value(q, a) * u_[values_->dof(a, c)];
    return u;
  }

  FieldDerivatives
  StrainValues::tip_displacement(const unsigned int q) const
  {
    FieldDerivatives sum;
    for (unsigned int k = 0; k < values_->n_tip_functions(); ++k)
      sum.add(u_[values_->tip_dof(k)], values_->tip_function(q, k));
    return sum;
  }

  Tensor<1, spacedim>
  StrainValues::normal_change(const unsigned int q) const
  {
    const auto &frame = values_->frame(q);
    const auto  phi   = deformed_basis(frame, values_->shapes(), q);
    const auto  tip   = tip_displacement(q);
    if (is_linear_)
      return ShellStrain::normal_change(
        frame,
        {{phi[0] - frame.a_cov[0] + tip.first[0],
          phi[1] - frame.a_cov[1] + tip.first[1]}});
    const Tensor<1, spacedim> area = cross_product_3d(phi[0], phi[1]);
    return area / area.norm() - frame.t0;
  }

  Tensor<1, spacedim>
  StrainValues::rotation(const unsigned int q) const
  {
    const auto &t0 = values_->frame(q).t0;
    const auto  dt = normal_change(q);
    // t0 x t, of the length of the angle's sine.
    const Tensor<1, spacedim> axis = cross_product_3d(t0, dt);
    const double              sine = axis.norm();
    if (is_linear_ || sine == 0.)
      return axis;
    return std::atan2(sine, 1. + t0 * dt) / sine * axis;
  }

  std::array<Tensor<1, spacedim>, dim>
  StrainValues::deformed_basis(const SurfaceFrame<> &frame,
                               const ShapeTable     &shapes,
                               const unsigned int    q) const
  {
    auto phi = frame.a_cov;
    for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        for (unsigned int alpha = 0; alpha < dim; ++alpha)
          phi[alpha][c] +=
            shapes.gradient(q, a)[alpha] * u_[values_->dof(a, c)];
    return phi;
  }

  void
  StrainValues::fill_finite_strains()
  {
    const auto         &tying = values_->tying();
    std::vector<double> samples;
    for (const auto &[point, direction] : tying.samples())
      {
        const auto &frame = values_->tying_frame(point);
        const auto  phi = deformed_basis(frame, values_->tying_shapes(), point);
        const auto &a   = frame.a_cov;
        samples.push_back(0.5 * direction[0] * (phi[0] * phi[0] - a[0] * a[0]) +
                          0.5 * direction[1] * (phi[1] * phi[1] - a[1] * a[1]) +
                          direction[2] * (phi[0] * phi[1] - a[0] * a[1]));
      }
    tying.sum(samples);
    const auto &shapes = values_->shapes();
    for (unsigned int q = 0; q < values_->n_points(); ++q)
      {
        const auto &frame = values_->frame(q);
        const auto  phi   = deformed_basis(frame, shapes, q);
        auto        ddphi = frame.a_cov_derivatives;
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            for (unsigned int v = 0; v < 3; ++v)
              ddphi[v][c] += shapes.hessian(q, a)[v] * u_[values_->dof(a, c)];
        const Tensor<1, spacedim> area = cross_product_3d(phi[0], phi[1]);
        for (unsigned int v = 0; v < 3; ++v)
          {
            double strain = 0.;
            for (const auto &[k, weight] : tying.weights(q, v))
              strain += weight * samples[k];
            membrane_[3 * q + v] = strain;
            bending_[3 * q + v] =
              (v == 2 ? 2. : 1.) * (frame.b(v) - ddphi[v] * area / area.norm());
          }
      }
  }
} // namespace Nacre
