// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_tip_jump_h
#define nacre_mechanics_tip_jump_h

#include <nacre/mechanics/williams_fields.h>

#include <optional>
#include <vector>

namespace Nacre
{
  /** A point of the boundary of a cell in which a crack ends. */
  struct JumpBoundaryPoint
  {
    /** Ahead of the tip and to the left of it (length). */
    double x, y;
    /** The outward normal, of length 1. */
    double normal_x, normal_y;
    /** The value there; none: natural conditions. */
    std::optional<double> value;
  };

  /** A jump function, and how well it obeys its conditions. */
  struct JumpFunction
  {
    PolarSeries psi;
    /** Root of the mean square of the errors of the values; of order 1. */
    double residual;
  };

  /**
   * Weights of the points of a boundary, for each condition: sum_q w_q
   * (psi - value)_q = 0 holds exactly.
   */
  using JumpMoments = std::vector<std::vector<double>>;

  /**
   * The function that opens a crack inside of a cell,
   *
   *   Laplace psi = 0,  psi,theta = 0 on the lips theta = +-pi,
   *   psi = value or psi,n = 0 on the boundary:
   *
   * Kaufmann, Martin, Botsch, Grinspun, Gross (2009). It is the series
   *
   *   sum_k a_k r^k cos k theta + b_k r^(k + 1/2) sin (k + 1/2) theta,
   *
   * whose terms obey all but the last line, which they fit by least squares.
   */
  JumpFunction
  harmonic_jump(const std::vector<JumpBoundaryPoint> &boundary,
                const JumpMoments                    &moments = {});

  /**
   * The same for deflections, which need r^(3/2) for a finite energy,
   *
   *   Laplace Laplace psi = 0, on the lips m_nn = V = 0,
   *   psi = value and psi,n = 0, or m_nn = V = 0 on the boundary:
   *
   * the series of bending_williams_series() and of rigid motions.
   */
  JumpFunction
  biharmonic_jump(const std::vector<JumpBoundaryPoint> &boundary,
                  const double                          poissons_ratio,
                  const JumpMoments                    &moments = {});
} // namespace Nacre

#endif
