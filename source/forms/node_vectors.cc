// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/simd.h>
#include <nacre/forms/node_vectors.h>

namespace Nacre
{
  void
  extract_nodes(const ShellCellValues &values,
                const Vector<double>  &u,
                NodeVectors<double>   &nodes)
  {
    nodes.assign(values.shapes().n_nodes(), Tensor<1, spacedim>());
    if (u.size() != 0)
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          nodes[a][c] = u[values.dof(a, c)];
  }

  void
  extract_nodes(const ShellEdgeValues &edge,
                const unsigned int     side,
                const Vector<double>  &u,
                NodeVectors<double>   &nodes)
  {
    nodes.assign(edge.shapes(side).n_nodes(), Tensor<1, spacedim>());
    if (u.size() != 0)
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          nodes[a][c] = u[edge.dof(side, a, c)];
  }

  NACRE_SIMD void
  add_scaled(const unsigned int  n,
             const double        v,
             const double *const x,
             double *__restrict const y)
  {
    for (unsigned int j = 0; j < n; ++j)
      y[j] += v * x[j];
  }
} // namespace Nacre
