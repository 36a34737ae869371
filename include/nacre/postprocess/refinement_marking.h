// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_refinement_marking_h
#define nacre_postprocess_refinement_marking_h

#include <nacre/discretization/discretization.h>

#include <vector>

namespace Nacre
{
  /**
   * Which cells to refine. The indicators are eta_K^2 >= 0 of this rank's
   * cells; other entries are 0. Cells whose indicators differ by round-off only
   * (1e-6) are marked together, so that the choice depends neither on the
   * number of ranks nor breaks the symmetry of a problem. Collective.
   */
  namespace RefinementMarking
  {
    /**
     * Doerfler: the smallest set of cells whose indicators sum up to at least
     * the @p fraction of all.
     */
    std::vector<bool>
    bulk(const std::vector<double> &indicators,
         const double               fraction,
         const MPI_Comm             communicator);

    /**
     * The @p fraction of all cells that has the largest indicators, at least
     * one cell.
     * @param n_cells number of the cells of all ranks
     */
    std::vector<bool>
    fixed_fraction(const std::vector<double>     &indicators,
                   const double                   fraction,
                   const types::global_cell_index n_cells,
                   const MPI_Comm                 communicator);

    /**
     * Mark what must be refined along with the @p marked cells of this rank:
     * where one cell near a cut (CellParts::is_near_cut()) is, all cells near
     * that cut and those that touch it are, so that they keep one size; and
     * cells that would get neighbours of less than half their size, as p4est
     * refines them.
     */
    void
    add_cells_along_cuts(const Discretization &discretization,
                         std::vector<bool>    &marked);
  } // namespace RefinementMarking
} // namespace Nacre

#endif
