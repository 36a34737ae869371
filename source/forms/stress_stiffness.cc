// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/stress_stiffness.h>

namespace Nacre
{
  namespace
  {
    /**
     * The work conjugates, at the tying points, of the strains sampled there,
     * from @p forces at the points times area and weight.
     */
    std::vector<Voigt<>>
    forces_at_tying_points(const MembraneTying        &tying,
                           const std::vector<Voigt<>> &forces)
    {
      std::vector<double> samples(tying.n_coefficients(), 0.);
      for (unsigned int q = 0; q < forces.size(); ++q)
        for (unsigned int v = 0; v < 3; ++v)
          for (const auto &[s, weight] : tying.weights(q, v))
            samples[s] += weight * forces[q][v];
      tying.spread(samples);
      std::vector<Voigt<>> result(tying.points().size());
      for (unsigned int s = 0; s < samples.size(); ++s)
        for (unsigned int v = 0; v < 3; ++v)
          result[tying.samples()[s].point][v] +=
            tying.samples()[s].direction[v] * samples[s];
      return result;
    }

    /** Add N,a n^ab N,b of each tying point for all three components. */
    void
    add_gradient_products(const ShellCellValues      &values,
                          const std::vector<Voigt<>> &forces,
                          FullMatrix<double>         &local)
    {
      const auto &shapes = values.tying_shapes();
      for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
        for (unsigned int b = 0; b < shapes.n_nodes(); ++b)
          {
            double sum = 0.;
            for (unsigned int k = 0; k < forces.size(); ++k)
              {
                const auto    &dN_a = shapes.gradient(k, a);
                const auto    &dN_b = shapes.gradient(k, b);
                const Voigt<> &n    = forces[k];
                sum += n[0] * dN_a[0] * dN_b[0] + n[1] * dN_a[1] * dN_b[1] +
                       n[2] * (dN_a[0] * dN_b[1] + dN_a[1] * dN_b[0]);
              }
            for (unsigned int c = 0; c < spacedim; ++c)
              local(values.dof(a, c), values.dof(b, c)) += sum;
          }
    }

    /** The same of the functions of tips, where strains are not tied. */
    void
    add_tip_products(const ShellCellValues      &values,
                     const std::vector<Voigt<>> &forces,
                     FullMatrix<double>         &local)
    {
      const auto &shapes = values.shapes();
      for (unsigned int q = 0; q < values.n_points(); ++q)
        for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
          {
            const auto        &n   = forces[q];
            const auto        &psi = values.tip_function(q, k).first;
            const auto         p_1 = n[0] * psi[0] + n[2] * psi[1];
            const auto         p_2 = n[2] * psi[0] + n[1] * psi[1];
            const unsigned int i   = values.tip_dof(k);
            for (unsigned int l = 0; l < values.n_tip_functions(); ++l)
              {
                const auto &other = values.tip_function(q, l).first;
                local(i, values.tip_dof(l)) += other[0] * p_1 + other[1] * p_2;
              }
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const auto  &dN    = shapes.gradient(q, a);
                  const double entry = dN[0] * p_1[c] + dN[1] * p_2[c];
                  local(i, values.dof(a, c)) += entry;
                  local(values.dof(a, c), i) += entry;
                }
          }
    }

    Voigt<>
    strain_of_rows(const FullMatrix<double>  &rows,
                   const unsigned int         q,
                   const std::vector<double> &u)
    {
      Voigt<> strain;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int i = 0; i < u.size(); ++i)
          strain[v] += rows(3 * q + v, i) * u[i];
      return strain;
    }
  } // namespace

  StressStiffness::StressStiffness(const Discretization &discretization,
                                   const SectionLaw     &section,
                                   const MembraneStrain  membrane_strain)
    : discretization_(discretization)
    , section_(section)
    , membrane_strain_(membrane_strain)
  {}

  void
  StressStiffness::add(const Forces                    &forces,
                       const AffineConstraints<double> &constraints,
                       Matrix                          &matrix) const
  {
    loop([&](const ShellCellValues &values,
             const unsigned int     q,
             const auto &) { return forces(values, q); },
         constraints,
         matrix);
  }

  void
  StressStiffness::add(const Vector                    &u,
                       const AffineConstraints<double> &constraints,
                       Matrix                          &matrix,
                       const Instant                   &instant) const
  {
    std::vector<double> local;
    loop(
      [&](const ShellCellValues &values,
          const unsigned int     q,
          const auto            &dofs) {
        local.resize(dofs.size());
        for (unsigned int i = 0; i < dofs.size(); ++i)
          local[i] = u(dofs[i]);
        const auto stiffness =
          section_.stiffness(values.frame(q), values.point(q));
        return stiffness.membrane *
                 strain_of_rows(values.membrane_rows(), q, local) +
               stiffness.coupling *
                 strain_of_rows(values.bending_rows(), q, local) -
               section_
                 .initial_forces(values.frame(q), values.point(q), instant)
                 .membrane_force;
      },
      constraints,
      matrix);
  }

  void
  StressStiffness::loop(const CellForces                &forces,
                        const AffineConstraints<double> &constraints,
                        Matrix                          &matrix) const
  {
    const Element  &element = discretization_.element();
    ShellCellValues full(discretization_,
                         cell_quadrature(element, membrane_strain_),
                         membrane_strain_ == MembraneStrain::tied);
    full.project_on_parts(membrane_strain_ != MembraneStrain::full);
    std::unique_ptr<ShellCellValues> reduced;
    if (blends_integration(element, membrane_strain_))
      reduced = std::make_unique<ShellCellValues>(discretization_,
                                                  element.reduced_quadrature(),
                                                  false);
    std::vector<types::global_dof_index> dofs;
    FullMatrix<double>                   local;
    std::vector<Voigt<>>                 at_points;
    const auto add_points = [&](const ShellCellValues &values,
                                const double           share) {
      at_points.clear();
      for (unsigned int q = 0; q < values.n_points(); ++q)
        at_points.push_back(share * values.JxW(q) * forces(values, q, dofs));
      add_gradient_products(values,
                            forces_at_tying_points(values.tying(), at_points),
                            local);
      add_tip_products(values, at_points, local);
    };
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const CellPart &part : discretization_.owned_parts())
        {
          discretization_.get_dof_indices(part, dofs);
          local.reinit(dofs.size(), dofs.size());
          full.reinit(part);
          const double share =
            reduced ? full_integration_share(full, section_) : 1.;
          add_points(full, share);
          if (share < 1.)
            {
              reduced->reinit(part);
              add_points(*reduced, 1. - share);
            }
          constraints.distribute_local_to_global(local, dofs, matrix);
        }
    });
  }
} // namespace Nacre
