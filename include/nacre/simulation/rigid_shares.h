// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_rigid_shares_h
#define nacre_simulation_rigid_shares_h

#include <nacre/forms/mass_terms.h>
#include <nacre/simulation/discrete_shell.h>

#include <vector>

namespace Nacre
{
  /**
   * Which of the @p modes are rigid motions of the shell's components: all but
   * 1e-6 of the kinetic energy is that of such motions, and the strain energy
   * vanishes but for round-off. Collective.
   * @param mass of the shell @param K its stiffness
   * @param constraints homogeneous
   * @param modes without ghosts, constrained entries unset
   */
  std::vector<bool>
  rigid_shares(const DiscreteShell                              &shell,
               const MassTerms                                  &mass,
               const TrilinosWrappers::SparseMatrix             &K,
               const AffineConstraints<double>                  &constraints,
               const std::vector<TrilinosWrappers::MPI::Vector> &modes);
} // namespace Nacre

#endif
