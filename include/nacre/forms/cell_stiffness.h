// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_cell_stiffness_h
#define nacre_forms_cell_stiffness_h

#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/section_law.h>

#include <array>
#include <vector>

namespace Nacre
{
  /** Section stiffness times area and weight at the points of a cell. */
  struct CellStiffness
  {
    /** A times the area (force times 1/length^3). */
    std::vector<VoigtMatrix<>> membrane;
    /** D times the area (force/length). */
    std::vector<VoigtMatrix<>> bending;
    /** B times the area (force/length^2); empty if nothing is coupled. */
    std::vector<VoigtMatrix<>> coupling;

    /**
     * @param membrane_factor share of these points in the energy of the
     *   membrane strain, that of its coupling with bending included
     */
    void
    reinit(const ShellCellValues &values,
           const SectionLaw      &section,
           const double           membrane_factor);
  };

  /**
   * What the section's initial strains hold at the points of a cell at
   * @p instant, times area and weight; none if there are no initial strains.
   * @param shares of these points in the energies of membrane and bending
   */
  std::vector<InitialForces>
  held_forces(const ShellCellValues       &values,
              const SectionLaw            &section,
              const std::array<double, 2> &shares,
              const Instant               &instant);

  /**
   * stress = D strain, for the three Voigt rows of strains and resultants of
   * @p n dofs each.
   */
  void
  multiply_voigt_rows(const VoigtMatrix<> &D,
                      const double        *strain,
                      const unsigned int   n,
                      double              *stress);

  /**
   * f = min(1, h^2 / |K|) of MembraneStrain::reduced on the cell of
   * @p values, h the mean thickness; 1 on parts of divided cells.
   */
  double
  full_integration_share(const ShellCellValues &values,
                         const SectionLaw      &section);
} // namespace Nacre

#endif
