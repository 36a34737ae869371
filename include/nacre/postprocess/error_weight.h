// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_error_weight_h
#define nacre_postprocess_error_weight_h

#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/surface_frame.h>

namespace Nacre
{
  /**
   * The wave number (1, with respect to the coordinates of the reference cell)
   * of functions that an element of the degree @p degree resolves just no
   * more: p half waves from edge to edge, with zeros at the nodes.
   */
  double
  resolved_wave_number(const unsigned int degree);

  /**
   * The weight W (length^3/force) of a residual force per area in the estimate
   * r . W r of the square of the error's energy norm: the mean of A(k)^-1 over
   * the directions of the wave vector k of the covariant components
   * kappa (cos phi, sin phi).
   *
   * A(k) is the symbol of the energy: twice the energy per area of the
   * displacement v cos(k . x) with v a unit vector of space, for frozen
   * coefficients,
   *   eps_ab = 1/2 (k_a v_b + k_b v_a) - b_ab v_n,   rho_ab = k_a k_b v_n ,
   * tangential and normal parts a quarter of a wave apart. On a plate its
   * inverse is 1/(D k^4) along the normal and about 1/(C k^2) along the
   * surface; on a curved shell waves that stretch the surface get less.
   * The mean over k and -k leaves nothing that couples tangent and normal.
   *
   * @param kappa wave number on the reference cell (1)
   */
  Tensor<2, 3>
  error_weight(const SurfaceFrame<>   &frame,
               const SectionStiffness &stiffness,
               const double            kappa);

  /** Height of the cell over its edge of the conormal @p n (length). */
  double
  cell_height(const SurfaceFrame<> &frame, const Tensor<1, 3> &n);
} // namespace Nacre

#endif
