// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_deformation_check_h
#define nacre_analysis_deformation_check_h

#include <nacre/discretization/discretization.h>
#include <nacre/forms/shell_actions.h>

#include <deal.II/base/numbers.h>

#include <deal.II/lac/trilinos_vector.h>

#include <string>

namespace Nacre
{
  class Assembly;

  /** How much a cell of a static shell may bend between two points (rad). */
  constexpr double largest_bend = dealii::numbers::PI / 3.;

  /**
   * In motions: a sharp fold that passes through a coarse cell opens again,
   * while a path of equilibria would go on with the cell folded.
   */
  constexpr double largest_bend_in_motions = 85. / 180. * dealii::numbers::PI;

  /**
   * Why the deformation from the ghosted displacement @p before to @p after
   * can't be a step of a path:
   *
   * - a cell has lost its area, or folds onto itself: from one point to the
   *   next its material turns by more than @p allowed_bend (rad); a hairpin
   *   turns by 90 degrees at least once;
   * - a cell has been turned over: its normal has turned by more than 90
   *   degrees in the step;
   * - the fold angle of an edge, hanging ones included, has jumped beyond 180
   *   degrees.
   *
   * Cells are looked at in a lattice of points twice as fine as their nodes,
   * which holds the corners and the edges. Empty if nothing is wrong.
   * Collective, the same on all ranks.
   */
  std::string
  find_impossible_deformation(const Discretization &discretization,
                              const TrilinosWrappers::MPI::Vector &before,
                              const TrilinosWrappers::MPI::Vector &after,
                              const double allowed_bend = largest_bend);

  /**
   * The same without the changes of the step, for states that are reached by a
   * jump: only what is wrong with the ghosted displacement @p u itself.
   */
  std::string
  find_impossible_state(const Discretization                &discretization,
                        const TrilinosWrappers::MPI::Vector &u,
                        const double allowed_bend = largest_bend);

  /**
   * Why the ghosted displacement @p u tears the shell off one of the prescribed
   * @p rotations: the normal of an edge departs from it by more than @p allowed
   * (rad). The moment that pulls it back grows like the sine of twice the
   * angle and turns over at 90 degrees: beyond, no equilibrium is one, but a
   * coarse cell that swings may pass there and come back. Empty if nothing is
   * wrong. Collective.
   */
  std::string
  find_torn_edge(const Assembly                      &assembly,
                 const TrilinosWrappers::MPI::Vector &u,
                 const PrescribedRotations           &rotations,
                 const double                         allowed);
} // namespace Nacre

#endif
