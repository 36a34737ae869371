// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_error_indicators_h
#define nacre_postprocess_error_indicators_h

#include <nacre/base/types.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <vector>

namespace Nacre
{
  /** The residuals that an estimate is made of. */
  enum class Residual
  {
    /** Equilibrium within the cell: p + div f. */
    equilibrium,
    /** Jump of the traction, the effective shear included; edge forces. */
    traction,
    /** Jump of the bending moment m_nn; moments prescribed. */
    moment,
    /** Jump of the rotation; rotations prescribed. */
    rotation
  };
  constexpr unsigned int n_residuals = 4;

  /** eta_K^2 (force times length), or products of two fields' residuals. */
  class ErrorIndicators
  {
  public:
    explicit ErrorIndicators(const unsigned int n_cells = 0)
      : parts_(n_cells)
    {}

    /** By active cell index and residual; 0 for cells of other ranks. */
    double
    part(const unsigned int cell, const Residual residual) const
    {
      return parts_[cell][static_cast<unsigned int>(residual)];
    }

    void
    add(const unsigned int cell, const Residual residual, const double value)
    {
      parts_[cell][static_cast<unsigned int>(residual)] += value;
    }

    unsigned int
    n_cells() const
    {
      return parts_.size();
    }

    /** All residuals of the cell @p cell. */
    double
    of_cell(const unsigned int cell) const;

    /** Sum over the cells of all ranks; collective. */
    double
    total(const MPI_Comm communicator) const;

    /** The same of one residual. */
    double
    total(const Residual residual, const MPI_Comm communicator) const;

  private:
    std::vector<std::array<double, n_residuals>> parts_;
  };
} // namespace Nacre

#endif
