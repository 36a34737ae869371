// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/linear_kinematics.h>

namespace Nacre
{
  namespace
  {
    /** c = alpha a + beta b. */
    NACRE_SIMD void
    add_rows(const double        alpha,
             const double *const a,
             const double        beta,
             const double *const b,
             const unsigned int  n,
             double *const       c)
    {
      for (unsigned int i = 0; i < n; ++i)
        c[i] = alpha * a[i] + beta * b[i];
    }
  } // namespace

  LinearKinematics::LinearKinematics(const Discretization &discretization,
                                     const SectionLaw     &section,
                                     const MembraneStrain  membrane_strain)
    : discretization_(discretization)
    , section_(section)
    , membrane_strain_(membrane_strain)
    , full_values_(discretization,
                   cell_quadrature(discretization.element(), membrane_strain),
                   membrane_strain == MembraneStrain::tied)
  {
    full_values_.project_on_parts(membrane_strain != MembraneStrain::full);
    if (blends_integration(discretization.element(), membrane_strain))
      reduced_values_.emplace(discretization,
                              discretization.element().reduced_quadrature(),
                              false);
  }

  std::unique_ptr<Kinematics>
  LinearKinematics::clone() const
  {
    return std::make_unique<LinearKinematics>(*this);
  }

  double
  LinearKinematics::add_strain_terms(
    const FullMatrix<double>         &rows,
    const std::vector<VoigtMatrix<>> &stiffness,
    const Vector<double>             &u,
    LocalTerms                       &terms)
  {
    const unsigned int n = rows.n();
    if (terms.wants_tangent)
      {
        // K += B^T D B as dense products.
        stress_rows_.reinit(rows.m(), n, true);
        for (unsigned int q = 0; q < stiffness.size(); ++q)
          multiply_voigt_rows(stiffness[q],
                              &rows(3 * q, 0),
                              n,
                              &stress_rows_(3 * q, 0));
        rows.Tmmult(terms.tangent, stress_rows_, true);
      }
    if (u.size() == 0)
      return 0.;

    double energy = 0.;
    for (unsigned int q = 0; q < stiffness.size(); ++q)
      {
        Voigt<> strain;
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int i = 0; i < n; ++i)
            strain[v] += rows(3 * q + v, i) * u[i];
        const Voigt<> stress = stiffness[q] * strain;
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int i = 0; i < n; ++i)
            terms.residual[i] += rows(3 * q + v, i) * stress[v];
        energy += 0.5 * (stress * strain);
      }
    return energy;
  }

  void
  LinearKinematics::add_coupling_terms(const ShellCellValues &values,
                                       const Vector<double>  &u,
                                       LocalTerms            &terms)
  {
    if (stiffness_.coupling.empty())
      return;
    const auto        &eps = values.membrane_rows();
    const auto        &rho = values.bending_rows();
    const unsigned int n   = rho.n();
    if (terms.wants_tangent)
      {
        stress_rows_.reinit(rho.m(), n, true);
        for (unsigned int q = 0; q < values.n_points(); ++q)
          multiply_voigt_rows(stiffness_.coupling[q],
                              &rho(3 * q, 0),
                              n,
                              &stress_rows_(3 * q, 0));
        eps.Tmmult(terms.tangent, stress_rows_, true);
        stress_rows_.Tmmult(terms.tangent, eps, true);
      }
    if (u.size() == 0)
      return;
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        Voigt<> u_eps, u_rho;
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int i = 0; i < n; ++i)
            {
              u_eps[v] += eps(3 * q + v, i) * u[i];
              u_rho[v] += rho(3 * q + v, i) * u[i];
            }
        const Voigt<> force  = stiffness_.coupling[q] * u_rho;
        const Voigt<> moment = transpose(stiffness_.coupling[q]) * u_eps;
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int i = 0; i < n; ++i)
            terms.residual[i] +=
              eps(3 * q + v, i) * force[v] + rho(3 * q + v, i) * moment[v];
        terms.energies.membrane += 0.5 * (force * u_eps);
        terms.energies.bending += 0.5 * (moment * u_rho);
      }
  }

  void
  LinearKinematics::add_initial_terms(const ShellCellValues       &values,
                                      const std::array<double, 2> &shares,
                                      const Vector<double>        &u,
                                      LocalTerms                  &terms) const
  {
    const auto  held = held_forces(values, section_, shares, instant_);
    const auto &eps  = values.membrane_rows();
    const auto &rho  = values.bending_rows();
    for (unsigned int q = 0; q < held.size(); ++q)
      {
        terms.energies.membrane += held[q].membrane_energy;
        terms.energies.bending += held[q].bending_energy;
        for (unsigned int i = 0; i < eps.n(); ++i)
          {
            double n_eps = 0., m_rho = 0.;
            for (unsigned int v = 0; v < 3; ++v)
              {
                n_eps += held[q].membrane_force[v] * eps(3 * q + v, i);
                m_rho += held[q].moment[v] * rho(3 * q + v, i);
              }
            terms.residual[i] -= n_eps + m_rho;
            if (u.size() > 0)
              {
                terms.energies.membrane -= n_eps * u[i];
                terms.energies.bending -= m_rho * u[i];
              }
          }
      }
  }

  void
  LinearKinematics::add_cell_terms(const CellPart       &part,
                                   const Vector<double> &u,
                                   LocalTerms           &terms)
  {
    full_values_.reinit(part);
    const bool   reduced = reduced_values_.has_value();
    const double share =
      reduced ? full_integration_share(full_values_, section_) : 1.;

    // (32), (33)
    stiffness_.reinit(full_values_, section_, share);
    terms.energies.membrane += add_strain_terms(full_values_.membrane_rows(),
                                                stiffness_.membrane,
                                                u,
                                                terms);
    terms.energies.bending += add_strain_terms(full_values_.bending_rows(),
                                               stiffness_.bending,
                                               u,
                                               terms);
    add_coupling_terms(full_values_, u, terms);
    add_initial_terms(full_values_, {{share, 1.}}, u, terms);
    if (reduced && share < 1.)
      {
        reduced_values_->reinit(part);
        stiffness_.reinit(*reduced_values_, section_, 1. - share);
        terms.energies.membrane +=
          add_strain_terms(reduced_values_->membrane_rows(),
                           stiffness_.membrane,
                           u,
                           terms);
        add_coupling_terms(*reduced_values_, u, terms);
        add_initial_terms(*reduced_values_, {{1. - share, 0.}}, u, terms);
      }
  }

  void
  LinearKinematics::fill_edge_rows(const unsigned int q,
                                   const EdgeFluxes  &fluxes)
  {
    const auto        &jump   = jump_.rotation_jump();
    const auto        &moment = jump_.mean_moment();
    const unsigned int n      = jump.size();
    std::copy(jump.begin(), jump.end(), &test_rows_(2 * q, 0));
    std::copy(moment.begin(), moment.end(), &test_rows_(2 * q + 1, 0));
    add_rows(fluxes.penalty,
             jump.data(),
             fluxes.consistency,
             moment.data(),
             n,
             &trial_rows_(2 * q, 0));
    add_rows(fluxes.symmetry,
             jump.data(),
             0.,
             moment.data(),
             n,
             &trial_rows_(2 * q + 1, 0));
  }

  void
  LinearKinematics::add_edge_residual(const EdgeFluxes     &fluxes,
                                      const double          rotation,
                                      const double          initial_moment,
                                      const Vector<double> &u,
                                      LocalTerms           &terms) const
  {
    const auto &jump   = jump_.rotation_jump();
    const auto &moment = jump_.mean_moment();
    // With a prescribed rotation, the jump is rotation - theta^-.
    double u_jump   = rotation;
    double u_moment = -initial_moment;
    for (unsigned int i = 0; i < u.size(); ++i)
      {
        u_jump += jump[i] * u[i];
        u_moment += moment[i] * u[i];
      }
    if (u_jump == 0. && u_moment == 0.)
      return;
    for (unsigned int i = 0; i < jump.size(); ++i)
      terms.residual[i] +=
        (fluxes.penalty * u_jump + fluxes.consistency * u_moment) * jump[i] +
        fluxes.symmetry * u_jump * moment[i];
    terms.energies.edge +=
      0.5 * fluxes.penalty * u_jump * u_jump +
      0.5 * (fluxes.consistency + fluxes.symmetry) * u_moment * u_jump;
  }

  void
  LinearKinematics::add_edge_terms(const ShellEdgeValues &edge,
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
  LinearKinematics::add_rotation_terms(
    const ShellEdgeValues                 &edge,
    const double                           penalty,
    const std::vector<PrescribedRotation> &rotation,
    const Vector<double>                  &u,
    LocalTerms                            &terms)
  {
    const unsigned int n_points = edge.n_points();
    if (terms.wants_tangent)
      {
        test_rows_.reinit(2 * n_points, edge.n_dofs(), true);
        trial_rows_.reinit(2 * n_points, edge.n_dofs(), true);
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        jump_.reinit(edge, q, section_);
        const auto weights = edge_fluxes(edge, q, jump_.stiffness(), penalty);
        if (terms.wants_tangent)
          fill_edge_rows(q, weights);
        add_edge_residual(weights,
                          rotation[q].angle,
                          mean_initial_moment(edge, q, section_, instant_),
                          u,
                          terms);
      }
    // Rank two a point: one dense product for all points.
    if (terms.wants_tangent)
      test_rows_.Tmmult(terms.tangent, trial_rows_, true);
  }

  void
  LinearKinematics::add_moment_terms(const ShellEdgeValues     &edge,
                                     const std::vector<double> &moment,
                                     const Vector<double> & /*u*/,
                                     LocalTerms &terms)
  {
    JumpSide side;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      {
        side.reinit(edge, 0, q, section_);
        const double m = edge.JxW(q) * moment[q];
        for (unsigned int a = 0; a < side.rotation.size(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            terms.residual[edge.dof(0, a, c)] +=
              m * side.rotation[a] * side.t0[c];
        for (unsigned int k = 0; k < side.tip_rotation.size(); ++k)
          terms.residual[edge.tip_dof(0, k)] += m * side.tip_rotation[k];
      }
  }
} // namespace Nacre
