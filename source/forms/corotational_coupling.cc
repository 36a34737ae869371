// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The terms of CorotationalKinematics for sections that couple membrane forces
// and bending: n = A eps + B rho, m = B^T eps + D rho.

#include <nacre/forms/corotational_kinematics.h>
#include <nacre/mechanics/step_differences.h>

namespace Nacre
{
  void
  CorotationalKinematics::fill_strain_rows(const CellPoints &points)
  {
    const auto        &values = points.values;
    const auto        &tying  = values.tying();
    const auto        &shapes = values.shapes();
    const unsigned int n      = values.n_dofs();
    eps_rows_.reinit(3 * values.n_points(), n);
    rho_rows_.reinit(3 * values.n_points(), n, true);
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        for (unsigned int v = 0; v < 3; ++v)
          for (const auto &[s, weight] : tying.weights(q, v))
            for (unsigned int j = 0; j < n; ++j)
              eps_rows_(3 * q + v, j) += weight * sample_rows_(s, j);
        const auto &deformed = bending_.deformed(q);
        for (unsigned int b = 0; b < u_.size(); ++b)
          {
            const auto strain =
              ShellStrain::bending_of_shape_function(is_consistent() ?
                                                       deformed :
                                                       values.frame(q),
                                                     shapes.gradient(q, b),
                                                     shapes.hessian(q, b));
            for (unsigned int v = 0; v < 3; ++v)
              for (unsigned int d = 0; d < spacedim; ++d)
                rho_rows_(3 * q + v, spacedim * b + d) =
                  strain[v] * deformed.t0[d];
          }
      }
  }

  void
  CorotationalKinematics::add_coupling_to_force_rows(const CellPoints &points)
  {
    const auto        &tying = points.values.tying();
    const unsigned int n     = rho_rows_.n();
    for (unsigned int q = 0; q < points.values.n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          const auto &B = points.stiffness.coupling[q][v];
          for (const auto &[s, weight] : tying.weights(q, v))
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int j = 0; j < n; ++j)
                force_rows_(s, j) += weight * B[w] * rho_rows_(3 * q + w, j);
        }
  }

  void
  CorotationalKinematics::add_coupling_to_bending_rows(
    const CellPoints  &points,
    const unsigned int first_row)
  {
    const unsigned int  n = eps_rows_.n();
    std::vector<double> moment(n);
    for (unsigned int q = 0; q < points.values.n_points(); ++q)
      {
        const auto &t = bending_.deformed(q).t0;
        for (unsigned int v = 0; v < 3; ++v)
          {
            std::fill(moment.begin(), moment.end(), 0.);
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int j = 0; j < n; ++j)
                moment[j] +=
                  points.stiffness.coupling[q][w][v] * eps_rows_(3 * q + w, j);
            for (unsigned int c = 0; c < spacedim; ++c)
              for (unsigned int j = 0; j < n; ++j)
                derivative_rows_(first_row + 3 * q + v, c * n + j) +=
                  t[c] * moment[j];
          }
      }
  }

  void
  CorotationalKinematics::evaluate_edge_membrane(const ShellEdgeValues &edge)
  {
    if (!section_.is_coupled())
      return;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const EdgeSideTying values(edge, s);
        edge_membrane_[s].reinit_strains(values, edge_u_[s]);
        edge_membrane_[s].clear_forces();
        if (in_step_)
          for (unsigned int end = 0; end < 2; ++end)
            ends_edge_membrane_[end][s].reinit_strains(values,
                                                       ends_edge_u_[end][s]);
      }
  }

  std::array<Tensor<1, spacedim>, 2>
  CorotationalKinematics::edge_step_vectors(
    const ShellEdgeValues       &edge,
    const unsigned int           side,
    const MembraneTying::Sample &sample) const
  {
    const auto &frame = edge.tying_frames(side)[sample.point];
    Voigt<>     strain;
    for (const auto &end : ends_edge_membrane_)
      strain +=
        0.5 * CorotationalStrain::membrane(frame,
                                           end[side].deformed(sample.point),
                                           end[side].polar(sample.point));
    return StepDifferences::stretch_vectors(frame,
                                            edge_membrane_[side].deformed(
                                              sample.point),
                                            strain,
                                            sample.direction);
  }

  void
  CorotationalKinematics::fill_edge_membrane_rows(const ShellEdgeValues &edge,
                                                  const unsigned int     side,
                                                  const unsigned int     q,
                                                  const Voigt<>         &B_nu)
  {
    const auto        &tying    = edge.tying(side);
    const auto        &shapes   = edge.tying_shapes(side);
    const auto        &membrane = edge_membrane_[side];
    const unsigned int n        = spacedim * shapes.n_nodes();
    auto              &force    = membrane_force_row_[side];
    auto              &moment   = membrane_moment_row_[side];
    force.assign(n, 0.);
    moment.assign(n, 0.);
    std::vector<double> share(tying.n_coefficients());
    for (unsigned int v = 0; v < 3; ++v)
      for (const auto &[s, weight] : tying.weights(q, v))
        share[s] += B_nu[v] * weight;
    tying.spread(share);
    for (unsigned int s = 0; s < share.size(); ++s)
      {
        const auto &sample         = tying.samples()[s];
        const auto &[k, direction] = sample;
        const auto vectors = in_step_ ? edge_step_vectors(edge, side, sample) :
                                        membrane.sample_vectors(direction, k);
        // Without the rotations' derivatives both are the same.
        const auto derivatives = is_consistent() && !in_step_ ?
                                   membrane.sample_derivatives(direction, k) :
                                   vectors;
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          {
            const auto &dN = shapes.gradient(k, a);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                force[spacedim * a + c] +=
                  share[s] * (dN[0] * vectors[0][c] + dN[1] * vectors[1][c]);
                moment[spacedim * a + c] +=
                  share[s] *
                  (dN[0] * derivatives[0][c] + dN[1] * derivatives[1][c]);
              }
          }
      }
  }

  void
  CorotationalKinematics::add_edge_membrane_force(const ShellEdgeValues &edge,
                                                  const unsigned int     side,
                                                  const double moment_force,
                                                  LocalTerms  &terms) const
  {
    const auto &row = membrane_force_row_[side];
    for (unsigned int a = 0; a < row.size() / spacedim; ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[edge.dof(side, a, c)] +=
          moment_force * row[spacedim * a + c];
  }

  void
  CorotationalKinematics::add_membrane_to_mean_row(const ShellEdgeValues &edge)
  {
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const auto  &row    = membrane_moment_row_[s];
        const double factor = edge_point_.side(s).mean_factor;
        for (unsigned int a = 0; a < row.size() / spacedim; ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            mean_row_[edge.dof(s, a, c)] += factor * row[spacedim * a + c];
      }
  }

  void
  CorotationalKinematics::add_edge_membrane_tangent(const ShellEdgeValues &edge,
                                                    const unsigned int     side,
                                                    const unsigned int     q,
                                                    LocalTerms &terms)
  {
    const auto  &point  = edge_point_.side(side);
    const auto  &row    = membrane_force_row_[side];
    const double factor = point.mean_factor * edge_point_.fluxes().symmetry;
    for (unsigned int a = 0; a < row.size() / spacedim; ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const double       f = factor * row[spacedim * a + c];
          const unsigned int i = edge.dof(side, a, c);
          for (unsigned int j = 0; j < jump_row_.size(); ++j)
            terms.tangent(i, j) += f * jump_row_[j];
        }
    edge_membrane_[side].add_point_force(edge.tying(side),
                                         q,
                                         edge_point_.moment_force(side) *
                                           point.linear.coupling);
  }

  void
  CorotationalKinematics::add_edge_turn_tangent(const ShellEdgeValues &edge,
                                                const unsigned int     side,
                                                LocalTerms            &terms)
  {
    const auto &shapes   = edge.tying_shapes(side);
    auto       &membrane = edge_membrane_[side];
    membrane.set_resultants(edge.tying(side));
    for (unsigned int k = 0; k < shapes.n_points(); ++k)
      {
        const auto X = membrane.turn_derivative(k);
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
            {
              Tensor<2, spacedim> K;
              for (unsigned int alpha = 0; alpha < 2; ++alpha)
                for (unsigned int g = 0; g < 2; ++g)
                  K +=
                    (shapes.gradient(k, a)[alpha] * shapes.gradient(k, b)[g]) *
                    X[alpha][g];
              for (unsigned int c = 0; c < spacedim; ++c)
                for (unsigned int d = 0; d < spacedim; ++d)
                  terms.tangent(edge.dof(side, a, c), edge.dof(side, b, d)) +=
                    K[c][d];
            }
      }
  }
} // namespace Nacre
