// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/connected_parts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace Nacre
{
  namespace
  {
    using PartVector = TrilinosWrappers::MPI::Vector;

    /** The part of each coarse cell, by its index; parts count from 0. */
    std::vector<unsigned int>
    parts_of_coarse_cells(const Triangulation<dim, spacedim> &mesh)
    {
      // Every rank knows all coarse cells.
      std::vector<unsigned int> root(mesh.n_vertices());
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&](unsigned int v) {
        while (root[v] != v)
          v = root[v] = root[root[v]];
        return v;
      };
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int v : cell->vertex_indices())
          root[find(cell->vertex_index(v))] = find(cell->vertex_index(0));
      std::map<unsigned int, unsigned int> numbers;
      std::vector<unsigned int>            parts(mesh.n_cells(0));
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        parts[cell->index()] =
          numbers.emplace(find(cell->vertex_index(0)), numbers.size())
            .first->second;
      return parts;
    }

    /** The six rigid motions of each part, orthonormal in the mass. */
    std::vector<PartVector>
    rigid_basis(const DiscreteShell &shell, const MassTerms &mass)
    {
      const Discretization &discretization = shell.discretization();
      const auto parts = parts_of_coarse_cells(discretization.triangulation());
      const unsigned int n_parts =
        1 + *std::max_element(parts.begin(), parts.end());
      const auto [centre, length] = discretization.extent();
      std::vector<PartVector> motions(6 * n_parts, shell.owned_vector());
      const auto             &node_dofs = discretization.node_dofs();
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      for (const CellPart &here : discretization.owned_parts())
        {
          auto coarse =
            typename Triangulation<dim, spacedim>::cell_iterator(here.cell);
          while (coarse->level() > 0)
            coarse = coarse->parent();
          const unsigned int part = parts[coarse->index()];
          discretization.get_dof_indices(here, dofs);
          const auto nodes = discretization.node_positions(here);
          for (unsigned int k = 0; k < dofs.size(); ++k)
            {
              const auto i = dofs[node_dofs[k]];
              if (!discretization.locally_owned_dofs().is_element(i))
                continue;
              const unsigned int c = k % spacedim;
              const auto         x = (nodes[k / spacedim] - centre) / length;
              motions[6 * part + c](i) = 1.;
              for (unsigned int d = 0; d < spacedim; ++d)
                motions[6 * part + 3 + d](i) =
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

  unsigned int
  n_parts(const Discretization &discretization)
  {
    const auto parts = parts_of_coarse_cells(discretization.triangulation());
    return 1 + *std::max_element(parts.begin(), parts.end());
  }

  std::vector<bool>
  rigid_shares(const DiscreteShell                  &shell,
               const MassTerms                      &mass,
               const TrilinosWrappers::SparseMatrix &K,
               const AffineConstraints<double>      &constraints,
               const std::vector<PartVector>        &modes)
  {
    std::vector<bool> result(modes.size(), false);
    if (shell.conditions().free_rigid_motions().empty() &&
        n_parts(shell.discretization()) == 1)
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
