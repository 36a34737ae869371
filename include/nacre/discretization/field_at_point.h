// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_field_at_point_h
#define nacre_discretization_field_at_point_h

#include <nacre/discretization/shell_values.h>

namespace Nacre
{
  /**
   * The field sum_a N_a u_a + sum_k c_k psi_k, (C.4) of doc/cutting.md, at the
   * point @p q.
   * @param numbers u_a and c_k, by local dof
   */
  template <typename Numbers>
  Tensor<1, spacedim>
  field_at_point(const ShellCellValues &values,
                 const unsigned int     q,
                 const Numbers         &numbers)
  {
    Tensor<1, spacedim> field;
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        field[c] += values.shapes().value(q, a) * numbers[values.dof(a, c)];
    for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
      field += numbers[values.tip_dof(k)] * values.tip_function(q, k).value;
    return field;
  }

  /** Add phi_i . @p force of the point @p q to each entry i of @p result. */
  inline void
  add_force_at_point(const ShellCellValues     &values,
                     const unsigned int         q,
                     const Tensor<1, spacedim> &force,
                     Vector<double>            &result)
  {
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        result[values.dof(a, c)] += values.shapes().value(q, a) * force[c];
    for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
      result[values.tip_dof(k)] += values.tip_function(q, k).value * force;
  }
} // namespace Nacre

#endif
