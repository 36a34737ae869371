// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/cell_stiffness.h>

namespace Nacre
{
  void
  CellStiffness::reinit(const ShellCellValues &values,
                        const SectionLaw      &section,
                        const double           membrane_factor)
  {
    membrane.resize(values.n_points());
    bending.resize(values.n_points());
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        const auto stiffness =
          section.stiffness(values.frame(q), values.point(q));
        membrane[q] = membrane_factor * values.JxW(q) * stiffness.membrane;
        bending[q]  = values.JxW(q) * stiffness.bending;
      }
  }

  double
  full_integration_share(const ShellCellValues &values,
                         const SectionLaw      &section)
  {
    double area = 0., volume = 0.;
    for (unsigned int q = 0; q < values.n_points(); ++q)
      {
        area += values.JxW(q);
        volume += values.JxW(q) * section.thickness(values.point(q));
      }
    const double thickness = volume / area;
    return std::min(1., thickness * thickness / area);
  }
} // namespace Nacre
