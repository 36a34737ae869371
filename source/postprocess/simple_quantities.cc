// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/error_norms.h>
#include <nacre/postprocess/momentum.h>
#include <nacre/postprocess/simple_quantities.h>
#include <nacre/postprocess/state_quantities.h>
#include <nacre/postprocess/strain_values.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    using Vector3  = Tensor<1, spacedim>;
    using Evaluate = std::function<double(const SolvedShell &)>;

    double
    maximum_displacement(const SolvedShell &shell)
    {
      const auto  &discretization = shell.discretization;
      const auto  &node_dofs      = discretization.node_dofs();
      double       maximum        = 0.;
      StrainValues on_parts(
        shell,
        Quadrature<dim>(discretization.scalar_fe().get_unit_support_points()),
        true);
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      for (const CellPart &part : discretization.owned_parts())
        {
          if (part.is_cut())
            {
              // Some of its nodes lie beyond a cut.
              on_parts.reinit(part);
              for (unsigned int q = 0; q < on_parts.values().n_points(); ++q)
                maximum = std::max(maximum, on_parts.displacement(q).norm());
              continue;
            }
          discretization.get_dof_indices(part, dofs);
          for (unsigned int a = 0; a < node_dofs.size() / spacedim; ++a)
            {
              Vector3 u;
              for (unsigned int c = 0; c < spacedim; ++c)
                u[c] = shell.displacement(dofs[node_dofs[spacedim * a + c]]);
              maximum = std::max(maximum, u.norm());
            }
        }
      return Utilities::MPI::max(maximum, discretization.communicator());
    }

    template <typename Function>
    Evaluate
    of_energies(const Function &part)
    {
      return [part](const SolvedShell &shell) {
        return std::invoke(part, shell.energies);
      };
    }

    Evaluate
    error_norm(double ErrorNorms::*norm)
    {
      return [norm](const SolvedShell &shell) {
        return compute_error_norms(shell).*norm;
      };
    }

    double
    total_energy(const SolvedShell &shell)
    {
      return shell.energies.total() + kinetic_energy(shell);
    }

    template <typename Function>
    Evaluate
    of_balance(const Function &part)
    {
      return [part](const SolvedShell &shell) {
        return std::invoke(part, shell.balance);
      };
    }

    Evaluate
    momentum(const unsigned int c, const bool angular)
    {
      return [=](const SolvedShell &shell) {
        return (angular ? angular_momentum(shell) : linear_momentum(shell))[c];
      };
    }
  } // namespace

  const std::vector<SimpleQuantity> &
  simple_quantities()
  {
    static const std::vector<SimpleQuantity> table = {
      {"maximum displacement", maximum_displacement, true},
      {"energy", of_energies(&Energies::total), true},
      {"membrane energy", of_energies(&Energies::membrane), true},
      {"bending energy", of_energies(&Energies::bending), true},
      {"edge energy", of_energies(&Energies::edge), true},
      {"plastic dissipation", plastic_dissipation, true},
      {"foundation energy", of_energies(&Energies::foundation), true},
      {"kinetic energy", kinetic_energy},
      {"total energy", total_energy},
      {"external work", of_balance(&EnergyBalance::external_work)},
      {"work of prescribed motion",
       of_balance(&EnergyBalance::prescribed_work)},
      {"dissipation", of_balance(&EnergyBalance::dissipation)},
      {"released energy", of_balance(&EnergyBalance::released)},
      {"energy balance", of_balance(&EnergyBalance::gain)},
      {"momentum x", momentum(0, false)},
      {"momentum y", momentum(1, false)},
      {"momentum z", momentum(2, false)},
      {"angular momentum x", momentum(0, true)},
      {"angular momentum y", momentum(1, true)},
      {"angular momentum z", momentum(2, true)},
      {"L2 error", error_norm(&ErrorNorms::L2), false, true},
      {"H1 error", error_norm(&ErrorNorms::H1), false, true},
      {"energy error", error_norm(&ErrorNorms::energy), false, true}};
    return table;
  }
} // namespace Nacre
