// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_tip_release_h
#define nacre_postprocess_tip_release_h

#include <nacre/mechanics/hoop_stress.h>
#include <nacre/postprocess/crack_tip.h>
#include <nacre/postprocess/shell_state.h>

#include <array>
#include <optional>
#include <string>

namespace Nacre
{
  /** All that is known of the tip of a crack. */
  struct TipRelease
  {
    CrackPlateau plateau;
    /** h at the tip (length). */
    double thickness;
    /** G (force): the energy per length of the crack in the mid-surface. */
    double rate;
    /**
     * Whether the intensities are known: in linear kinematics, of a homogeneous
     * isotropic section.
     */
    bool has_intensities = false;
    /**
     * K_I, K_II (force/length^(3/2)), K_M, K_T (force length^(1/2)), as
     * unit_williams_field() defines them; else 0.
     */
    std::array<double, 4> intensities{{0., 0., 0., 0.}};
    /** Where the crack turns to, from the intensities. */
    HoopStress hoop_stress = {};
  };

  /**
   * The radii that are taken if none are given: 2 and 6 cells at the tip; 1.5
   * and 6 beyond Cuts::tip_radius where displacements have tip functions,
   * whose blending isn't to be felt.
   */
  CrackPlateau
  default_plateau(const CrackTip &tip, const Cuts &cuts);

  /**
   * What the tip of a crack releases, and its intensities. See EnergyRelease
   * for what throws. Collective.
   * @param plateau none: default_plateau()
   * @param where begins the messages
   */
  TipRelease
  compute_tip_release(const SolvedShell                 &shell,
                      const CrackTip                    &tip,
                      const std::optional<CrackPlateau> &plateau,
                      const std::string                 &where);
} // namespace Nacre

#endif
