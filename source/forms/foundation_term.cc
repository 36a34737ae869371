// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/foundation_term.h>
#include <nacre/problem/foundation.h>

namespace Nacre
{
  namespace
  {
    /** The displacement at the point @p q; zero if @p u is empty. */
    Tensor<1, spacedim>
    displacement_at(const ShellCellValues        &values,
                    const unsigned int            q,
                    const dealii::Vector<double> &u)
    {
      Tensor<1, spacedim> result;
      for (unsigned int a = 0; u.size() > 0 && a < values.shapes().n_nodes();
           ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          result[c] += values.shapes().value(q, a) * u[values.dof(a, c)];
      for (unsigned int k = 0; u.size() > 0 && k < values.n_tip_functions();
           ++k)
        result += u[values.tip_dof(k)] * values.tip_function(q, k).value;
      return result;
    }

    /** What @p force and its derivative K mean for functions of tips. */
    void
    add_tip_functions(const ShellCellValues     &values,
                      const unsigned int         q,
                      const Tensor<1, spacedim> &force,
                      const Tensor<2, spacedim> &K,
                      LocalTerms                &terms)
    {
      for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
        {
          const unsigned int i     = values.tip_dof(k);
          const auto        &psi   = values.tip_function(q, k).value;
          const auto         K_psi = K * psi;
          terms.residual[i] += psi * force;
          if (!terms.wants_tangent)
            continue;
          for (unsigned int l = 0; l < values.n_tip_functions(); ++l)
            terms.tangent(i, values.tip_dof(l)) +=
              values.tip_function(q, l).value * K_psi;
          for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const double entry = values.shapes().value(q, a) * K_psi[c];
                terms.tangent(i, values.dof(a, c)) += entry;
                terms.tangent(values.dof(a, c), i) += entry;
              }
        }
    }
  } // namespace

  Tensor<1, spacedim>
  foundation_force(const Foundation             &foundation,
                   const ShellCellValues        &values,
                   const unsigned int            q,
                   const dealii::Vector<double> &u)
  {
    const auto  &t0       = values.frame(q).t0;
    const auto   u_q      = displacement_at(values, q, u);
    const double w        = u_q * t0;
    const auto [k_n, k_t] = foundation.stiffness(values.point(q));
    return foundation.normal_answer(k_n, w, w).force * t0 +
           k_t * (u_q - w * t0);
  }

  void
  FoundationTerm::add_on_cell(TermCell &cell, LocalTerms &terms) const
  {
    const ShellCellValues &values = cell.values();
    const LocalState      &state  = cell.state;
    const auto            &shapes = values.shapes();
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto  &t0       = values.frame(q).t0;
        const auto   u        = displacement_at(values, q, state.u);
        const double w        = u * t0;
        const auto [k_n, k_t] = foundation_.stiffness(values.point(q));
        const auto tangential = u - w * t0;
        double     w_start = w, w_end = w;
        if (state.is_step())
          {
            w_start = displacement_at(values, q, state.u_start) * t0;
            w_end   = displacement_at(values, q, state.u_end) * t0;
          }
        else
          terms.energies.foundation +=
            values.JxW(q) * (foundation_.normal_energy(k_n, w) +
                             0.5 * k_t * tangential.norm_square());
        const auto answer = foundation_.normal_answer(k_n, w_start, w_end);
        const auto force =
          values.JxW(q) * (answer.force * t0 + k_t * tangential);
        const Tensor<2, spacedim> K =
          values.JxW(q) *
          (k_t * Tensor<2, spacedim>(unit_symmetric_tensor<spacedim>()) +
           (answer.stiffness - k_t) * outer_product(t0, t0));
        for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              const unsigned int i = values.dof(a, c);
              terms.residual[i] += shapes.value(q, a) * force[c];
              for (unsigned int b = 0;
                   terms.wants_tangent && b < shapes.n_nodes();
                   ++b)
                for (unsigned int d = 0; d < spacedim; ++d)
                  terms.tangent(i, values.dof(b, d)) +=
                    shapes.value(q, a) * shapes.value(q, b) * K[c][d];
            }
        add_tip_functions(values, q, force, K, terms);
      }
  }
} // namespace Nacre
