// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/child_map.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <memory>

namespace Nacre
{
  std::vector<ChildMap>
  child_maps(const ReferenceCell &cell)
  {
    // The linear functions of the parent at the vertices of a child
    std::unique_ptr<FiniteElement<dim>> linear;
    if (cell == ReferenceCells::Quadrilateral)
      linear = std::make_unique<FE_Q<dim>>(1);
    else
      linear = std::make_unique<FE_SimplexP<dim>>(1);
    std::vector<ChildMap> maps(ChildMap::identity + 1);
    for (unsigned int child = 0; child < ChildMap::identity; ++child)
      {
        const auto &P      = linear->get_prolongation_matrix(child);
        const auto  vertex = [&](const unsigned int v) {
          Point<dim> x;
          for (const unsigned int w : cell.vertex_indices())
            x += P(v, w) * cell.vertex<dim>(w);
          return x;
        };
        ChildMap &map = maps[child];
        map.origin    = vertex(0);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int c = 0; c < dim; ++c)
            map.jacobian[c][d] = vertex(d + 1)[c] - map.origin[c];
      }
    for (unsigned int d = 0; d < dim; ++d)
      maps[ChildMap::identity].jacobian[d][d] = 1.;
    return maps;
  }
} // namespace Nacre
