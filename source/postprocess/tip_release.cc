// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/energy_release.h>
#include <nacre/postprocess/tip_release.h>

namespace Nacre
{
  CrackPlateau
  default_plateau(const CrackTip &tip, const Cuts &cuts)
  {
    const double radius = tip.has_functions ? cuts.tip_radius : 0.;
    return {radius + (tip.has_functions ? 1.5 : 2.) * tip.cell_size,
            radius + 6. * tip.cell_size};
  }

  TipRelease
  compute_tip_release(const SolvedShell                 &shell,
                      const CrackTip                    &tip,
                      const std::optional<CrackPlateau> &plateau,
                      const std::string                 &where)
  {
    TipRelease result{plateau.value_or(default_plateau(tip, shell.model.cuts)),
                      shell.model.section->thickness(tip.position),
                      0.};
    const EnergyRelease release(shell, tip, result.plateau, where);
    const auto          plate = release.plate();
    result.has_intensities    = plate.has_value();
    if (!plate)
      result.rate = release.rate();
    else
      {
        const auto all     = release.rate_and_intensities(*plate);
        result.rate        = all.rate;
        result.intensities = all.intensities;
        result.hoop_stress = largest_hoop_stress(all.intensities, *plate);
      }
    return result;
  }
} // namespace Nacre
