// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_deformation_check_h
#define nacre_analysis_deformation_check_h

#include <nacre/discretization/discretization.h>

#include <deal.II/lac/trilinos_vector.h>

#include <string>

namespace Nacre
{
  /**
   * Why the deformation from the ghosted displacement @p before to @p after
   * can't be a step of a path: a cell has lost its area or has been turned
   * inside out (its normal has turned by more than 90 degrees in the step), or
   * the fold angle of an edge has jumped beyond 180 degrees. Empty if nothing
   * is wrong. Collective, the same on all ranks.
   */
  std::string
  find_impossible_deformation(const Discretization &discretization,
                              const TrilinosWrappers::MPI::Vector &before,
                              const TrilinosWrappers::MPI::Vector &after);
} // namespace Nacre

#endif
