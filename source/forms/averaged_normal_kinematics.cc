// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/averaged_normal_kinematics.h>
#include <nacre/mechanics/edge_frame.h>
#include <nacre/mechanics/shell_strain.h>

#include <sstream>

namespace Nacre
{
  void
  AveragedNormalPoint::reinit(const ShellEdgeValues &edge,
                              const unsigned int     q,
                              const SectionLaw      &section,
                              const Instant         &instant)
  {
    AssertDimension(edge.n_sides(), 2);
    const auto &t_minus = edge.frame(0, q).t0;
    const auto  t_plus  = edge.sigma(1, q) * edge.frame(1, q).t0;
    if ((t_minus + t_plus).norm() < 1e-8)
      {
        std::ostringstream text;
        text << "Discretization/Edge form: averaged normal: at ("
             << edge.point(q)
             << ") two cells are folded onto each other, the mean of their "
                "normals is zero; use rotation jump.";
        AssertThrow(false, ExcMessage(text.str()));
      }
    // Nothing depends on the tangent's length, here 1; its direction makes
    // phi_e,2 = nu^- where the surface is smooth.
    const auto edge_frame =
      EdgeFrame::make_edge_frame(cross_product_3d(edge.conormal(0, q), t_minus),
                                 t_minus,
                                 t_plus);

    stiffness_      = 0.;
    initial_moment_ = Voigt<>();
    normal_jump_.reinit(3, edge.n_dofs());
    mean_moment_.reinit(3, edge.n_dofs());
    for (unsigned int side = 0; side < 2; ++side)
      add_side(edge, side, q, section, instant, edge_frame);
  }

  void
  AveragedNormalPoint::add_side(const ShellEdgeValues &edge,
                                const unsigned int     side,
                                const unsigned int     q,
                                const SectionLaw      &section,
                                const Instant         &instant,
                                const SurfaceFrame<>  &edge_frame)
  {
    const auto &frame  = edge.frame(side, q);
    const auto &shapes = edge.shapes(side);
    const auto  N_hat  = EdgeFrame::jump_matrix(edge_frame);
    const auto  p      = EdgeFrame::strain_transformation(frame, edge_frame);
    // jump = plus - minus; the neighbour of the opposite orientation enters
    // with -t0 and -rho.
    const double sign  = side == 0 ? -1. : 1.;
    const double sigma = edge.sigma(side, q);
    // Regions of different sections may meet here.
    const auto H_m = section.stiffness(edge_frame, edge.point(q, side)).bending;
    stiffness_ += 0.5 * H_m;
    const auto stiffness = 0.5 * sigma * H_m;
    if (section.has_initial_strain())
      initial_moment_ +=
        0.5 * sigma *
        (invert(transpose(p)) *
         section.initial_forces(frame, edge.point(q, side), instant).moment);

    for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
      {
        const auto &dN = shapes.gradient(q, a);
        const auto  change =
          N_hat * EdgeFrame::normal_change_of_shape_function(
                    edge_frame,
                    EdgeFrame::transform_derivatives(frame, edge_frame, dN));
        const auto strain =
          ShellStrain::bending_of_shape_function(frame,
                                                 dN,
                                                 shapes.hessian(q, a));
        const auto moment = stiffness * (p * strain);
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            const unsigned int i = edge.dof(side, a, c);
            for (unsigned int v = 0; v < 3; ++v)
              {
                normal_jump_(v, i) += sign * change[v] * edge_frame.t0[c];
                mean_moment_(v, i) += moment[v] * frame.t0[c];
              }
          }
      }
  }

  std::unique_ptr<Kinematics>
  AveragedNormalKinematics::clone() const
  {
    return std::make_unique<AveragedNormalKinematics>(*this);
  }

  void
  AveragedNormalKinematics::fill_rows(const unsigned int q,
                                      const double       penalty,
                                      const double       dx)
  {
    const auto &jump   = point_.normal_jump();
    const auto &moment = point_.mean_moment();
    const auto &H      = point_.stiffness();
    for (unsigned int i = 0; i < jump.n(); ++i)
      for (unsigned int v = 0; v < 3; ++v)
        {
          const unsigned int row        = 6 * q + v;
          normal_test_rows_(row, i)     = jump(v, i);
          normal_test_rows_(row + 3, i) = moment(v, i);
          normal_trial_rows_(row, i) =
            dx * penalty *
              (H[v][0] * jump(0, i) + H[v][1] * jump(1, i) +
               H[v][2] * jump(2, i)) +
            dx * moment(v, i);
          normal_trial_rows_(row + 3, i) = dx * jump(v, i);
        }
  }

  void
  AveragedNormalKinematics::add_point_residual(const double          penalty,
                                               const double          dx,
                                               const Vector<double> &u,
                                               LocalTerms &terms) const
  {
    const auto &jump   = point_.normal_jump();
    const auto &moment = point_.mean_moment();
    Voigt<>     u_jump, u_moment = -1. * point_.initial_moment();
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int i = 0; i < u.size(); ++i)
        {
          u_jump[v] += jump(v, i) * u[i];
          u_moment[v] += moment(v, i) * u[i];
        }
    const auto u_penalty = penalty * (point_.stiffness() * u_jump);
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int i = 0; i < u.size(); ++i)
        terms.residual[i] += dx * ((u_penalty[v] + u_moment[v]) * jump(v, i) +
                                   u_jump[v] * moment(v, i));
    terms.energies.edge +=
      dx * (0.5 * (u_penalty * u_jump) + u_moment * u_jump);
  }

  void
  AveragedNormalKinematics::add_edge_terms(const ShellEdgeValues &edge,
                                           const double           penalty,
                                           const Vector<double>  &u,
                                           LocalTerms            &terms)
  {
    const unsigned int n_points = edge.n_points();
    if (terms.wants_tangent)
      {
        normal_test_rows_.reinit(6 * n_points, edge.n_dofs(), true);
        normal_trial_rows_.reinit(6 * n_points, edge.n_dofs(), true);
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        point_.reinit(edge, q, section_, instant_);
        const double dx = edge.JxW(q);
        if (terms.wants_tangent)
          fill_rows(q, penalty, dx);
        add_point_residual(penalty, dx, u, terms);
      }
    if (terms.wants_tangent)
      normal_test_rows_.Tmmult(terms.tangent, normal_trial_rows_, true);
  }
} // namespace Nacre
