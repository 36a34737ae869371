// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_shell_terms_h
#define nacre_forms_shell_terms_h

#include <nacre/forms/term.h>

#include <optional>

namespace Nacre
{
  class BoundaryConditions;
  class Expression;
  class Loads;
  struct Foundation;
  struct ShellModel;

  /**
   * What the weak form takes of a ShellModel. All must live as long as what is
   * made of it.
   */
  struct ShellParts
  {
    ShellParts(const ShellModel &model);

    /** For a mesh that is no Midsurface's. */
    ShellParts(const SectionLaw            &section,
               const BoundaryConditions    &supports,
               const Loads                 &loads,
               const KinematicsOptions     &kinematics,
               const std::optional<double> &eta = {});

    const SectionLaw         &section;
    const BoundaryConditions &supports;
    const Loads              &loads;
    KinematicsOptions         kinematics;
    /** The penalty's factor (15); none: twice the bound of each cell. */
    std::optional<double> eta;
    /**
     * Of prescribed displacements over the time, by which they turn edges;
     * null: they don't.
     */
    const Expression *load_factor = nullptr;
    /** Null: none. */
    const Foundation *foundation = nullptr;
  };

  enum class TermSelection
  {
    all,
    /** Those that have a derivative: all that coarse levels need. */
    with_tangent
  };

  /**
   * The terms of a shell. A new one is a class of its own and a line here.
   * Throws where a load has no meaning on this mesh; collective.
   */
  Terms
  make_terms(const Discretization &discretization,
             const ShellParts     &parts,
             const TermSelection   selection);
} // namespace Nacre

#endif
