// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

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

    /** The sum of what @p use gives for X + u and M v of each node. */
    Tensor<1, spacedim>
    sum_over_nodes(
      const SolvedShell &shell,
      const std::function<Tensor<1, spacedim>(const Tensor<1, spacedim> &,
                                              const Tensor<1, spacedim> &)>
        &use)
    {
      const auto &discretization = shell.discretization;
      const auto &node_dofs      = discretization.node_dofs();
      const auto  Mv             = momentum_vector(shell);
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      std::set<types::global_dof_index>    visited;
      Tensor<1, spacedim>                  sum;
      for (const CellPart &part : discretization.owned_parts())
        {
          discretization.get_dof_indices(part, dofs);
          const auto nodes = discretization.node_positions(part);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            {
              const auto first = dofs[node_dofs[spacedim * a]];
              if (!discretization.locally_owned_dofs().is_element(first) ||
                  !visited.insert(first).second)
                continue;
              Tensor<1, spacedim> x(nodes[a]), p;
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  const auto i = dofs[node_dofs[spacedim * a + c]];
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
    return sum_over_nodes(shell,
                          [](const auto & /*x*/, const auto &p) { return p; });
  }

  Tensor<1, spacedim>
  angular_momentum(const SolvedShell &shell)
  {
    return sum_over_nodes(shell, [](const auto &x, const auto &p) {
      return cross_product_3d(x, p);
    });
  }
} // namespace Nacre
