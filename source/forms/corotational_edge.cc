// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/corotational_kinematics.h>

#include <cmath>

namespace Nacre
{
  std::pair<Tensor<1, spacedim>, Tensor<1, spacedim>>
  prescribed_frame(const Tensor<1, spacedim> &nu,
                   const Tensor<1, spacedim> &t0,
                   const PrescribedRotation  &rotation)
  {
    const double sine   = std::sin(rotation.angle);
    const double cosine = std::cos(rotation.angle);
    return {rotation.turn * (cosine * nu + sine * t0),
            rotation.turn * (cosine * t0 - sine * nu)};
  }

  void
  CorotationalKinematics::add_edge_terms(const ShellEdgeValues &edge,
                                         const double           penalty,
                                         const Vector<double>  &u,
                                         LocalTerms            &terms)
  {
    add_rotation_terms(edge,
                       penalty,
                       std::vector<PrescribedRotation>(edge.n_points()),
                       u,
                       terms);
  }

  void
  CorotationalKinematics::add_rotation_terms(
    const ShellEdgeValues                 &edge,
    const double                           penalty,
    const std::vector<PrescribedRotation> &rotation,
    const Vector<double>                  &u,
    LocalTerms                            &terms)
  {
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      extract_nodes(edge, s, u, edge_u_[s]);
    in_step_ = false;
    evaluate_edge_membrane(edge);
    if (terms.wants_tangent)
      reinit_edge_rows(edge);
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        edge_point_.reinit(edge,
                           q,
                           section_,
                           penalty,
                           rotation[q],
                           edge_u_,
                           edge_membrane_);
        terms.energies.edge += edge_point_.energy();
        for (unsigned int s = 0; s < edge.n_sides(); ++s)
          {
            force_.assign(edge_u_[s].size(), Tensor<1, spacedim>());
            edge_point_.add_force(s, force_);
            add_edge_residual(edge, s, terms);
            if (section_.is_coupled())
              {
                fill_edge_membrane_rows(edge,
                                        s,
                                        q,
                                        edge_point_.side(s).linear.coupling);
                add_edge_membrane_force(edge,
                                        s,
                                        edge_point_.moment_force(s),
                                        terms);
              }
          }
        if (terms.wants_tangent)
          add_edge_point_rows(edge, q, terms);
      }
    if (terms.wants_tangent)
      for (unsigned int s = 0; s < edge.n_sides(); ++s)
        {
          add_edge_tangent(edge, s, terms);
          if (section_.is_coupled() && is_consistent())
            add_edge_turn_tangent(edge, s, terms);
        }
  }

  void
  CorotationalKinematics::add_edge_point_rows(const ShellEdgeValues &edge,
                                              const unsigned int     q,
                                              LocalTerms            &terms)
  {
    fill_edge_derivatives(edge, q);
    if (section_.is_coupled())
      add_membrane_to_mean_row(edge);
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        fill_edge_rows(s, q);
        if (section_.is_coupled())
          add_edge_membrane_tangent(edge, s, q, terms);
      }
  }

  double
  CorotationalKinematics::rotation_gap(const ShellEdgeValues    &edge,
                                       const unsigned int        q,
                                       const PrescribedRotation &rotation,
                                       const Vector<double>     &u)
  {
    in_step_ = false;
    extract_nodes(edge, 0, u, edge_u_[0]);
    evaluate_edge_membrane(edge);
    edge_point_
      .reinit(edge, q, section_, 1., rotation, edge_u_, edge_membrane_);
    const auto &side = edge_point_.side(0);
    return std::atan2(cross_product_3d(side.normal, side.deformed.t0).norm(),
                      side.normal * side.deformed.t0);
  }

  void
  CorotationalKinematics::reinit_edge_rows(const ShellEdgeValues &edge)
  {
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        edge_shape_rows_[s].reinit(2 * edge.n_points(),
                                   edge.shapes(s).n_nodes(),
                                   true);
        edge_derivative_rows_[s].reinit(2 * edge.n_points(),
                                        spacedim * edge.n_dofs(),
                                        true);
      }
  }

  void
  CorotationalKinematics::add_edge_residual(const ShellEdgeValues &edge,
                                            const unsigned int     s,
                                            LocalTerms            &terms) const
  {
    for (unsigned int a = 0; a < force_.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[edge.dof(s, a, c)] += force_[a][c];
  }

  void
  CorotationalKinematics::add_edge_step_terms(const ShellEdgeValues &edge,
                                              const double           penalty,
                                              const Vector<double>  &u_start,
                                              const Vector<double>  &u_end,
                                              LocalTerms            &terms)
  {
    const std::vector<PrescribedRotation> none(edge.n_points());
    add_rotation_step_terms(edge, penalty, none, none, u_start, u_end, terms);
  }

  void
  CorotationalKinematics::add_rotation_step_terms(
    const ShellEdgeValues                 &edge,
    const double                           penalty,
    const std::vector<PrescribedRotation> &rotation_start,
    const std::vector<PrescribedRotation> &rotation_end,
    const Vector<double>                  &u_start,
    const Vector<double>                  &u_end,
    LocalTerms                            &terms)
  {
    in_step_ = true;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        extract_nodes(edge, s, u_start, ends_edge_u_[0][s]);
        extract_nodes(edge, s, u_end, ends_edge_u_[1][s]);
        edge_u_[s].resize(ends_edge_u_[0][s].size());
        for (unsigned int a = 0; a < edge_u_[s].size(); ++a)
          edge_u_[s][a] = 0.5 * (ends_edge_u_[0][s][a] + ends_edge_u_[1][s][a]);
      }
    evaluate_edge_membrane(edge);
    if (terms.wants_tangent)
      reinit_edge_rows(edge);
    auto &[start, end] = ends_edge_point_;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        const std::array<PrescribedRotation, 2> rotation = {
          {rotation_start[q], rotation_end[q]}};
        start.reinit(edge,
                     q,
                     section_,
                     penalty,
                     rotation[0],
                     ends_edge_u_[0],
                     ends_edge_membrane_[0]);
        end.reinit(edge,
                   q,
                   section_,
                   penalty,
                   rotation[1],
                   ends_edge_u_[1],
                   ends_edge_membrane_[1]);
        edge_step_.reinit(edge, q, start, end, rotation[0], rotation[1]);
        terms.rotation_work += edge_step_.rotation_work();
        add_edge_step_forces(edge, q, terms);
        if (!terms.wants_tangent)
          continue;
        edge_point_.reinit(edge,
                           q,
                           section_,
                           penalty,
                           mean_rotation(rotation[0], rotation[1]),
                           edge_u_,
                           edge_membrane_);
        edge_point_.take_mean_strains(start, end);
        add_edge_point_rows(edge, q, terms);
      }
    if (terms.wants_tangent)
      for (unsigned int s = 0; s < edge.n_sides(); ++s)
        add_edge_tangent(edge, s, terms);
  }

  void
  CorotationalKinematics::add_edge_step_forces(const ShellEdgeValues &edge,
                                               const unsigned int     q,
                                               LocalTerms            &terms)
  {
    const auto &[start, end] = ends_edge_point_;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        force_.assign(edge.shapes(s).n_nodes(), Tensor<1, spacedim>());
        edge_step_.add_force(edge, q, s, force_);
        add_edge_residual(edge, s, terms);
        if (section_.is_coupled())
          {
            fill_edge_membrane_rows(edge, s, q, start.side(s).linear.coupling);
            add_edge_membrane_force(edge,
                                    s,
                                    0.5 * (start.moment_force(s) +
                                           end.moment_force(s)),
                                    terms);
          }
      }
  }

  namespace
  {
    /** Derivatives [d] . d(e) of omega for the tangent e = dx/ds. */
    std::array<Tensor<1, spacedim>, spacedim>
    tangent_rotation(const CorotationalEdgePoint<double> &point)
    {
      // omega = d x dd + d (tangent_spin . dd), dd = (1 - d d) de / |e|
      const auto &d    = point.tangent();
      const auto  spin = point.tangent_spin() - (point.tangent_spin() * d) * d;
      std::array<Tensor<1, spacedim>, spacedim> columns;
      for (unsigned int i = 0; i < spacedim; ++i)
        {
          Tensor<1, spacedim> unit;
          unit[i] = 1.;
          columns[i] =
            (cross_product_3d(d, unit) + spin[i] * d) / point.stretch();
        }
      return columns;
    }
  } // namespace

  namespace
  {
    /**
     * A component of d(R t0) = omega x R t0 and of what multiplies it:
     * row = factors[0] jump + factors[1] mean + factors[2] d(R t0).
     */
    NACRE_SIMD void
    turn_rows(const unsigned int                   n,
              const std::array<double, 2>         &normal,
              const std::array<const double *, 2> &omega,
              const std::array<const double *, 2> &jump_and_mean,
              const std::array<double, 3>         &factors,
              double *__restrict const row)
    {
      const double *const jump   = jump_and_mean[0];
      const double *const mean   = jump_and_mean[1];
      const double *const omega1 = omega[0];
      const double *const omega2 = omega[1];
      const double        turn1  = factors[2] * normal[1];
      const double        turn2  = factors[2] * normal[0];
      const double        f      = factors[0];
      const double        g      = factors[1];
      for (unsigned int j = 0; j < n; ++j)
        row[j] =
          f * jump[j] + g * mean[j] + turn1 * omega1[j] - turn2 * omega2[j];
    }

    NACRE_SIMD void
    add_row(const unsigned int  n,
            const double *const from,
            double *__restrict const to)
    {
      for (unsigned int j = 0; j < n; ++j)
        to[j] += from[j];
    }
  } // namespace

  void
  CorotationalKinematics::fill_edge_derivatives(const ShellEdgeValues &edge,
                                                const unsigned int     q)
  {
    const unsigned int n = edge.n_dofs();
    omega_.assign(spacedim * n, 0.);
    jump_row_.assign(n, 0.);
    mean_row_.assign(n, 0.);

    // How [[theta]] and {m_nn} change with a rotation of R.
    Tensor<1, spacedim> jump_by_omega, mean_by_omega;
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const auto &side = edge_point_.side(s);
        jump_by_omega +=
          side.jump_factor * cross_product_3d(side.normal, side.lambda);
        mean_by_omega +=
          side.mean_factor * cross_product_3d(side.normal, side.mu);
      }

    const auto          columns   = tangent_rotation(edge_point_);
    const auto         &d0        = edge_point_.initial_tangent();
    const auto         &d         = edge_point_.tangent();
    const double        jump_by_d = jump_by_omega * d;
    const double        mean_by_d = mean_by_omega * d;
    Tensor<1, spacedim> jump_by_columns, mean_by_columns;
    for (unsigned int c = 0; c < spacedim; ++c)
      {
        jump_by_columns[c] = jump_by_omega * columns[c];
        mean_by_columns[c] = mean_by_omega * columns[c];
      }
    const double d_1 = d0 * edge.frame(0, q).a_con[0];
    const double d_2 = d0 * edge.frame(0, q).a_con[1];
    for (unsigned int s = 0; s < edge.n_sides(); ++s)
      {
        const auto &side   = edge_point_.side(s);
        const auto &shapes = edge.shapes(s);
        for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
          {
            const auto  &dN   = shapes.gradient(q, b);
            const double spin = side.spin[0] * dN[0] + side.spin[1] * dN[1];
            const double e    = s == 0 ? d_1 * dN[0] + d_2 * dN[1] : 0.;
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const unsigned int j = edge.dof(s, b, c);
                jump_row_[j] +=
                  side.jump_factor * side.linear.rotation[b] * side.normal[c];
                mean_row_[j] +=
                  side.mean_factor * side.linear.moment[b] * side.normal[c];
                if (is_consistent())
                  {
                    // omega = spin t0[c] d + e columns[c]
                    const double turn = spin * side.deformed.t0[c];
                    for (unsigned int k = 0; k < spacedim; ++k)
                      omega_[k * n + j] += turn * d[k] + e * columns[c][k];
                    jump_row_[j] += turn * jump_by_d + e * jump_by_columns[c];
                    mean_row_[j] += turn * mean_by_d + e * mean_by_columns[c];
                  }
              }
          }
      }
  }

  void
  CorotationalKinematics::fill_edge_rows(const unsigned int s,
                                         const unsigned int q)
  {
    const auto        &side   = edge_point_.side(s);
    const auto        &fluxes = edge_point_.fluxes();
    const unsigned int n      = jump_row_.size();
    for (unsigned int a = 0; a < side.linear.rotation.size(); ++a)
      {
        edge_shape_rows_[s](2 * q, a)     = side.linear.rotation[a];
        edge_shape_rows_[s](2 * q + 1, a) = side.linear.moment[a];
      }
    const double f = edge_point_.rotation_force(s);
    const double g = edge_point_.moment_force(s);
    for (unsigned int c = 0; c < spacedim; ++c)
      {
        const unsigned int c1 = (c + 1) % spacedim;
        const unsigned int c2 = (c + 2) % spacedim;
        const double       t  = side.normal[c];
        turn_rows(n,
                  {{side.normal[c1], side.normal[c2]}},
                  {{&omega_[c1 * n], &omega_[c2 * n]}},
                  {{jump_row_.data(), mean_row_.data()}},
                  {{side.jump_factor * t * fluxes.penalty,
                    side.jump_factor * t * fluxes.consistency,
                    f}},
                  &edge_derivative_rows_[s](2 * q, c * n));
        turn_rows(n,
                  {{side.normal[c1], side.normal[c2]}},
                  {{&omega_[c1 * n], &omega_[c2 * n]}},
                  {{jump_row_.data(), mean_row_.data()}},
                  {{side.mean_factor * t * fluxes.symmetry, 0., g}},
                  &edge_derivative_rows_[s](2 * q + 1, c * n));
      }
  }

  void
  CorotationalKinematics::add_edge_tangent(const ShellEdgeValues &edge,
                                           const unsigned int     side,
                                           LocalTerms            &terms)
  {
    const unsigned int n       = edge.n_dofs();
    const unsigned int n_nodes = edge.shapes(side).n_nodes();
    product_.reinit(n_nodes, spacedim * n, true);
    edge_shape_rows_[side].Tmmult(product_, edge_derivative_rows_[side]);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const double *entry = &product_(a, c * n);
          double       *row   = &terms.tangent(edge.dof(side, a, c), 0);
          add_row(n, entry, row);
        }
  }

  void
  CorotationalKinematics::add_moment_terms(const ShellEdgeValues     &edge,
                                           const std::vector<double> &moment,
                                           const Vector<double>      &u,
                                           LocalTerms                &terms)
  {
    const auto             &shapes = edge.shapes(0);
    FollowingMoment<double> load;
    extract_nodes(edge, 0, u, edge_u_[0]);
    force_.assign(shapes.n_nodes(), Tensor<1, spacedim>());
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        load.reinit(edge, q, moment[q], edge_u_[0]);
        load.add_force(edge, q, force_);
        if (!terms.wants_tangent || !is_consistent())
          continue;
        const auto X = load.derivative();
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
            {
              Tensor<2, spacedim> K;
              for (unsigned int alpha = 0; alpha < 2; ++alpha)
                for (unsigned int g = 0; g < 2; ++g)
                  K +=
                    (shapes.gradient(q, a)[alpha] * shapes.gradient(q, b)[g]) *
                    X[alpha][g];
              for (unsigned int c = 0; c < spacedim; ++c)
                for (unsigned int d = 0; d < spacedim; ++d)
                  terms.tangent(edge.dof(0, a, c), edge.dof(0, b, d)) +=
                    K[c][d];
            }
      }
    for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        terms.residual[edge.dof(0, a, c)] += force_[a][c];
  }
} // namespace Nacre
