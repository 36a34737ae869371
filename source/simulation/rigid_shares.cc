// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/shell_components.h>
#include <nacre/simulation/rigid_shares.h>

#include <cmath>

namespace Nacre
{
  namespace
  {
    using PartVector = TrilinosWrappers::MPI::Vector;

    /** The six rigid motions of each component, orthonormal in the mass. */
    std::vector<PartVector>
    rigid_basis(const DiscreteShell &shell, const MassTerms &mass)
    {
      const Discretization &discretization = shell.discretization();
      const ShellComponents components(discretization);
      const auto [centre, length] = discretization.extent();
      std::vector<PartVector> motions(6 * components.size(),
                                      shell.owned_vector());
      const auto             &node_dofs = discretization.node_dofs();
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      for (const CellPart &part : discretization.owned_parts())
        {
          const unsigned int first = 6 * components.of(part);
          discretization.get_dof_indices(part, dofs);
          const auto nodes = discretization.node_positions(part);
          for (unsigned int k = 0; k < node_dofs.size(); ++k)
            {
              const auto i = dofs[node_dofs[k]];
              if (!discretization.locally_owned_dofs().is_element(i))
                continue;
              const unsigned int c  = k % spacedim;
              const auto         x  = (nodes[k / spacedim] - centre) / length;
              motions[first + c](i) = 1.;
              for (unsigned int d = 0; d < spacedim; ++d)
                motions[first + 3 + d](i) =
                  cross_product_3d(Point<spacedim>::unit_vector(d), x)[c];
            }
        }
      PartVector Mx = shell.owned_vector();
      for (unsigned int k = 0; k < motions.size(); ++k)
        {
          motions[k].compress(VectorOperation::insert);
          for (unsigned int repeat = 0; repeat < 2; ++repeat)
            for (unsigned int l = 0; l <= k; ++l)
              {
                PartVector ghosted = shell.ghosted_vector();
                ghosted            = motions[k];
                mass.vmult(Mx, ghosted);
                if (l < k)
                  motions[k].add(-(motions[l] * Mx), motions[l]);
                else
                  motions[k] /= std::sqrt(motions[k] * Mx);
              }
        }
      return motions;
    }
  } // namespace

  std::vector<bool>
  rigid_shares(const DiscreteShell                  &shell,
               const MassTerms                      &mass,
               const TrilinosWrappers::SparseMatrix &K,
               const AffineConstraints<double>      &constraints,
               const std::vector<PartVector>        &modes)
  {
    std::vector<bool> result(modes.size(), false);
    if (shell.conditions().free_rigid_motions().empty())
      return result;
    const auto motions = rigid_basis(shell, mass);
    PartVector Mx = shell.owned_vector(), Kx = shell.owned_vector();
    for (unsigned int k = 0; k < modes.size(); ++k)
      {
        PartVector x(modes[k]);
        K.vmult(Kx, x);
        double diagonal = 0.;
        for (const auto i : shell.discretization().locally_owned_dofs())
          diagonal += std::abs(K.diag_element(i)) * x(i) * x(i);
        diagonal =
          Utilities::MPI::sum(diagonal, shell.discretization().communicator());
        const double energy = std::abs(x * Kx);
        constraints.distribute(x);
        PartVector ghosted = shell.ghosted_vector();
        ghosted            = x;
        mass.vmult(Mx, ghosted);
        double share = 0.;
        for (const auto &motion : motions)
          share += std::pow(motion * Mx, 2);
        result[k] = share > (1. - 1e-6) * (x * Mx) && energy <= 1e-9 * diagonal;
      }
    return result;
  }
} // namespace Nacre
