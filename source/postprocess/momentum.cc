// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_enrichment.h>
#include <nacre/forms/mass_terms.h>
#include <nacre/postprocess/momentum.h>

#include <functional>
#include <set>

namespace Nacre
{
  namespace
  {
    /** M v of the ghosted velocity; zero in statics. */
    TrilinosWrappers::MPI::Vector
    momentum_vector(const SolvedShell &shell)
    {
      TrilinosWrappers::MPI::Vector Mv(
        shell.discretization.locally_owned_dofs(),
        shell.discretization.communicator());
      if (shell.mass != nullptr)
        shell.mass->vmult(Mv, *shell.velocity);
      return Mv;
    }

    /**
     * The sum of what @p use gives for X + u and M v of each node.
     * @param functions whether the scalar functions of tips are nodes, too,
     *   without a place; those of nodes alone have the sum 1
     */
    Tensor<1, spacedim>
    sum_over_nodes(
      const SolvedShell &shell,
      const bool         functions,
      const std::function<Tensor<1, spacedim>(const Tensor<1, spacedim> &,
                                              const Tensor<1, spacedim> &)>
        &use)
    {
      const auto &discretization = shell.discretization;
      const auto  Mv             = momentum_vector(shell);
      std::vector<types::global_dof_index> dofs;
      std::set<types::global_dof_index>    visited;
      Tensor<1, spacedim>                  sum;
      for (const CellPart &part : discretization.owned_parts())
        {
          discretization.get_dof_indices(part, dofs);
          const auto nodes       = discretization.node_positions(part);
          const bool has_scalars = functions && part.enrichment() != nullptr &&
                                   part.enrichment()->has_scalars();
          const unsigned int n =
            has_scalars ? dofs.size() / spacedim : nodes.size();
          for (unsigned int a = 0; a < n; ++a)
            {
              const auto first = dofs[discretization.local_dof(a, 0)];
              if (!discretization.locally_owned_dofs().is_element(first) ||
                  !visited.insert(first).second)
                continue;
              Tensor<1, spacedim> x, p;
              if (a < nodes.size())
                x = nodes[a];
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const auto i = dofs[discretization.local_dof(a, c)];
                  x[c] += shell.displacement(i);
                  p[c] = Mv(i);
                }
              sum += use(x, p);
            }
        }
      return Utilities::MPI::sum(sum, discretization.communicator());
    }
  } // namespace

  double
  kinetic_energy(const SolvedShell &shell)
  {
    if (shell.mass == nullptr)
      return 0.;
    const auto Mv  = momentum_vector(shell);
    double     sum = 0.;
    for (const auto i : shell.discretization.locally_owned_dofs())
      sum += 0.5 * (*shell.velocity)(i)*Mv(i);
    return Utilities::MPI::sum(sum, shell.discretization.communicator());
  }

  Tensor<1, spacedim>
  linear_momentum(const SolvedShell &shell)
  {
    return sum_over_nodes(shell, false, [](const auto & /*x*/, const auto &p) {
      return p;
    });
  }

  Tensor<1, spacedim>
  angular_momentum(const SolvedShell &shell)
  {
    return sum_over_nodes(shell, true, [](const auto &x, const auto &p) {
      return cross_product_3d(x, p);
    });
  }
} // namespace Nacre
