// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/tied_green_strain.h>

namespace Nacre
{
  void
  TiedStrainTangent::add_strain_row(const MembraneTying &tying,
                                    const unsigned int   q,
                                    const unsigned int   v,
                                    const double         factor,
                                    double *const        row) const
  {
    for (const auto &[k, weight] : tying.weights(q, v))
      add_scaled(rows_.n(), factor * weight, &rows_(k, 0), row);
  }

  const FullMatrix<double> &
  TiedStrainTangent::force_stiffness(const ShapeTable &tying_shapes,
                                     const TiedGreenStrain<double> &strain)
  {
    const unsigned int n_points = tying_shapes.n_points();
    const unsigned int n_nodes  = tying_shapes.n_nodes();
    gradient_rows_.reinit(2 * n_points, n_nodes, true);
    force_rows_.reinit(2 * n_points, n_nodes, true);
    for (unsigned int k = 0; k < n_points; ++k)
      {
        const auto &n = strain.resultant(k);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            const auto &dN               = tying_shapes.gradient(k, a);
            gradient_rows_(2 * k, a)     = dN[0];
            gradient_rows_(2 * k + 1, a) = dN[1];
            force_rows_(2 * k, a)        = n[0] * dN[0] + n[2] * dN[1];
            force_rows_(2 * k + 1, a)    = n[2] * dN[0] + n[1] * dN[1];
          }
      }
    stiffness_.reinit(n_nodes, n_nodes, true);
    gradient_rows_.Tmmult(stiffness_, force_rows_);
    return stiffness_;
  }
} // namespace Nacre
