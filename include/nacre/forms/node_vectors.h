// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_node_vectors_h
#define nacre_forms_node_vectors_h

#include <nacre/discretization/shell_edge_values.h>
#include <nacre/discretization/shell_values.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace Nacre
{
  /** A vector for each node of a cell. */
  template <typename Number>
  using NodeVectors = std::vector<Tensor<1, spacedim, Number>>;

  /** u,1 and u,2 at the point @p q of @p shapes. */
  template <typename Number>
  std::array<Tensor<1, spacedim, Number>, 2>
  displacement_gradient(const ShapeTable          &shapes,
                        const unsigned int         q,
                        const NodeVectors<Number> &u)
  {
    std::array<Tensor<1, spacedim, Number>, 2> du;
    for (unsigned int a = 0; a < u.size(); ++a)
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        du[alpha] += shapes.gradient(q, a)[alpha] * u[a];
    return du;
  }

  /** u,11, u,22 and u,12 at the point @p q of @p shapes. */
  template <typename Number>
  std::array<Tensor<1, spacedim, Number>, 3>
  displacement_hessian(const ShapeTable          &shapes,
                       const unsigned int         q,
                       const NodeVectors<Number> &u)
  {
    std::array<Tensor<1, spacedim, Number>, 3> ddu;
    for (unsigned int a = 0; a < u.size(); ++a)
      for (unsigned int v = 0; v < 3; ++v)
        ddu[v] += shapes.hessian(q, a)[v] * u[a];
    return ddu;
  }

  /** Displacements of the cell's nodes; zero if @p u is empty. */
  void
  extract_nodes(const ShellCellValues &values,
                const Vector<double>  &u,
                NodeVectors<double>   &nodes);

  /** Those of the cell of one side of an edge. */
  void
  extract_nodes(const ShellEdgeValues &edge,
                const unsigned int     side,
                const Vector<double>  &u,
                NodeVectors<double>   &nodes);

  /** y += v x, of @p n entries. */
  void
  add_scaled(const unsigned int  n,
             const double        v,
             const double *const x,
             double *__restrict const y);
} // namespace Nacre

#endif
