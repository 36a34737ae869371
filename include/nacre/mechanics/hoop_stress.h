// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_hoop_stress_h
#define nacre_mechanics_hoop_stress_h

#include <nacre/mechanics/williams_fields.h>

#include <array>

namespace Nacre
{
  /** The largest hoop stress around the tip of a crack, and where it acts. */
  struct HoopStress
  {
    /**
     * From the crack's own direction e_1 towards e_2, in (-pi, pi): how far a
     * crack turns that grows where this stress is largest.
     */
    double angle = 0.;
    /** s_tt sqrt(2 pi r) (force/length^(3/2)); 0: no tension anywhere. */
    double intensity = 0.;
    /** z above the mid-surface (length). */
    double height = 0.;
  };

  /**
   * The hoop stress over angles theta in (-pi, pi) and heights z is largest at
   * one of the faces z = +-h/2, since it is linear in z:
   *
   *   s_tt sqrt(2 pi r) = K_I/4 (3 cos theta/2 + cos 3 theta/2)
   *     - 3/4 K_II (sin theta/2 + sin 3 theta/2)
   *     + 12 z/h^3 {K_M [(7 + nu) cos 3 theta/2 + (5 + 3 nu) cos theta/2]
   *                 / (12 + 4 nu)
   *       - K_T (5 + 3 nu)/(12 + 4 nu) (sin theta/2 + sin 3 theta/2)}.  (C.10)
   *
   * The membrane part is Erdogan and Sih's, J. Basic Eng. 85 (1963) 519. Of
   * equal stresses at both faces that at z = h/2 is taken. Where nothing is
   * pulled, all numbers are 0.
   *
   * @param intensities K_I, K_II, K_M, K_T as unit_williams_field() has them
   */
  HoopStress
  largest_hoop_stress(const std::array<double, 4> &intensities,
                      const ElasticPlate          &plate);
} // namespace Nacre

#endif
