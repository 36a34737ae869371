// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_lip_release_h
#define nacre_simulation_lip_release_h

#include <nacre/discretization/discretization.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/simulation/crack_growth.h>

#include <vector>

namespace Nacre
{
  /**
   * The speed of Rayleigh waves along the edge of the sheet at @p x
   * (length/time),
   *
   *   c_R = c_s (0.862 + 1.14 nu)/(1 + nu),   c_s = (A_1212/(rho h))^(1/2),
   *
   * Viktorov's approximation, with the membrane stiffness A, nu = A_1122/A_1111
   * and the density rho.
   * @param e_1, e_2 tangent, orthogonal, of length 1: along the edge and across
   */
  double
  rayleigh_speed(const SectionLaw   &section,
                 const SectionPoint &x,
                 const Tensor<1, 3> &e_1,
                 const Tensor<1, 3> &e_2);

  /**
   * How long lips are held that a step of growth in dynamics releases (time):
   * as Growth::release_time says, or while a Rayleigh wave runs along the
   * longest advance of a tip; collective.
   * @param discretization before the step
   * @param before, after the tips before and after it
   */
  double
  release_time(const ShellProblem            &problem,
               const Discretization          &discretization,
               const std::vector<GrowingTip> &before,
               const std::vector<GrowingTip> &after);
} // namespace Nacre

#endif
