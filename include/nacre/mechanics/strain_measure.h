// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_strain_measure_h
#define nacre_mechanics_strain_measure_h

namespace Nacre
{
  /**
   * How the strains E, kappa and the angle theta at an edge follow from the
   * deformed surface. The chain from there to forces and tangents, by the first
   * and second variations, is the same for all measures.
   */
  enum class StrainMeasure
  {
    /** Green strains, exact changes of curvature and of angles: GreenStrain. */
    green,
    /**
     * The first variations of the green ones at the undeformed surface, applied
     * to the displacement: eps and rho of ShellStrain, and the jump of t0 .
     * du/dnu. Second variations are zero.
     */
    linear
  };
} // namespace Nacre

#endif
