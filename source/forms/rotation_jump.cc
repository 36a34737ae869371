// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/rotation_jump.h>
#include <nacre/mechanics/shell_strain.h>

namespace Nacre
{
  void
  JumpSide::reinit(const ShellEdgeValues &edge,
                   const unsigned int     side,
                   const unsigned int     q,
                   const SectionLaw      &section)
  {
    const auto  &frame  = edge.frame(side, q);
    const auto  &shapes = edge.shapes(side);
    const auto   nu     = edge.conormal(side, q);
    const double sigma  = edge.sigma(side, q);

    // Components of the dyad nu nu, and of the moment it cuts out:
    // m_nn = nu . (B^T eps + D rho) . nu = (B nu nu) : eps + (D nu nu) : rho.
    const auto   dyad         = ShellStrain::dyad_of(frame, nu);
    const auto   stiffness_at = section.stiffness(frame, edge.point(q, side));
    const auto   H_nu         = stiffness_at.bending * dyad;
    const double nu_1         = frame.a_con[0] * nu;
    const double nu_2         = frame.a_con[1] * nu;

    t0               = frame.t0;
    stiffness        = dyad * H_nu;
    curvature_moment = 0.;
    for (unsigned int v = 0; v < 3; ++v)
      curvature_moment += sigma * (v < 2 ? 1. : 2.) * H_nu[v] * frame.b(v);
    rotation.resize(shapes.n_nodes());
    moment.resize(shapes.n_nodes());
    for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
      {
        const auto &dN = shapes.gradient(q, a);
        rotation[a]    = sigma * (nu_1 * dN[0] + nu_2 * dN[1]);
        moment[a] =
          sigma *
          (H_nu * ShellStrain::bending_of_shape_function(frame,
                                                         dN,
                                                         shapes.hessian(q, a)));
      }
    membrane_moment.clear();
    coupling = Voigt<>();
    if (section.is_coupled())
      {
        coupling = sigma * (stiffness_at.coupling * dyad);
        fill_membrane_moment(edge.tied_membrane_rows(side), q);
      }
    fill_tip_functions(edge, side, q, {{nu_1, nu_2}}, H_nu);
  }

  void
  JumpSide::fill_tip_functions(const ShellEdgeValues       &edge,
                               const unsigned int           side,
                               const unsigned int           q,
                               const std::array<double, 2> &nu,
                               const Voigt<>               &H_nu)
  {
    const unsigned int n = edge.n_tip_functions(side);
    tip_rotation.resize(n);
    tip_moment.resize(n);
    const double sigma = n > 0 ? edge.sigma(side, q) : 1.;
    const auto  &frame = edge.frame(side, q);
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto &psi = edge.tip_function(side, q, k);
        tip_rotation[k] =
          sigma * (t0 * (nu[0] * psi.first[0] + nu[1] * psi.first[1]));
        tip_moment[k] =
          sigma * (H_nu * ShellStrain::bending(frame, psi.first, psi.second)) +
          coupling * ShellStrain::membrane(frame, psi.first[0], psi.first[1]);
      }
  }

  void
  JumpSide::fill_membrane_moment(const FullMatrix<double> &rows,
                                 const unsigned int        q)
  {
    membrane_moment.resize(rotation.size());
    for (unsigned int a = 0; a < rotation.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        for (unsigned int v = 0; v < 3; ++v)
          membrane_moment[a][c] +=
            coupling[v] * rows(3 * q + v, spacedim * a + c);
  }

  double
  initial_moment(const ShellEdgeValues &edge,
                 const unsigned int     side,
                 const unsigned int     q,
                 const SectionLaw      &section,
                 const Instant         &instant)
  {
    const auto &frame = edge.frame(side, q);
    const auto  held =
      section.initial_forces(frame, edge.point(q, side), instant);
    return edge.sigma(side, q) *
           (ShellStrain::dyad_of(frame, edge.conormal(side, q)) * held.moment);
  }

  double
  mean_initial_moment(const ShellEdgeValues &edge,
                      const unsigned int     q,
                      const SectionLaw      &section,
                      const Instant         &instant)
  {
    double mean = 0.;
    if (section.has_initial_strain())
      for (unsigned int side = 0; side < edge.n_sides(); ++side)
        mean +=
          initial_moment(edge, side, q, section, instant) / edge.n_sides();
    return mean;
  }

  EdgeFluxes
  edge_fluxes(const ShellEdgeValues &edge,
              const unsigned int     q,
              const double           stiffness,
              const double           penalty)
  {
    // The mirror image of a boundary cell doubles the penalty.
    const double factor = edge.n_sides() == 2 ? 1. : 2.;
    const double dx     = edge.JxW(q);

    EdgeFluxes fluxes;
    fluxes.penalty     = factor * penalty * stiffness * dx;
    fluxes.symmetry    = -dx;
    fluxes.consistency = -dx;
    return fluxes;
  }

  void
  RotationJump::reinit(const ShellEdgeValues &edge,
                       const unsigned int     q,
                       const SectionLaw      &section)
  {
    rotation_jump_.assign(edge.n_dofs(), 0.);
    mean_moment_.assign(edge.n_dofs(), 0.);
    stiffness_            = 0.;
    const bool   interior = (edge.n_sides() == 2);
    const double half     = interior ? 0.5 : 1.;
    for (unsigned int side = 0; side < edge.n_sides(); ++side)
      {
        side_.reinit(edge, side, q, section);
        // jump = plus - minus
        const double sign = side == 0 ? -1. : 1.;
        for (unsigned int a = 0; a < side_.rotation.size(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              const unsigned int i = edge.dof(side, a, c);
              rotation_jump_[i] += sign * side_.rotation[a] * side_.t0[c];
              mean_moment_[i] += half * side_.moment[a] * side_.t0[c];
              if (!side_.membrane_moment.empty())
                mean_moment_[i] += half * side_.membrane_moment[a][c];
            }
        for (unsigned int k = 0; k < side_.tip_rotation.size(); ++k)
          {
            const unsigned int i = edge.tip_dof(side, k);
            rotation_jump_[i] += sign * side_.tip_rotation[k];
            mean_moment_[i] += half * side_.tip_moment[k];
          }
        stiffness_ += (interior ? 0.5 : 1.) * side_.stiffness;
      }
  }
} // namespace Nacre
