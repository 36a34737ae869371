// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/error_indicators.h>

#include <deal.II/base/mpi.h>

namespace Nacre
{
  double
  ErrorIndicators::of_cell(const unsigned int cell) const
  {
    double sum = 0.;
    for (const double part : parts_[cell])
      sum += part;
    return sum;
  }

  double
  ErrorIndicators::total(const MPI_Comm communicator) const
  {
    double sum = 0.;
    for (unsigned int cell = 0; cell < parts_.size(); ++cell)
      sum += of_cell(cell);
    return Utilities::MPI::sum(sum, communicator);
  }

  double
  ErrorIndicators::total(const Residual residual,
                         const MPI_Comm communicator) const
  {
    double sum = 0.;
    for (unsigned int cell = 0; cell < parts_.size(); ++cell)
      sum += part(cell, residual);
    return Utilities::MPI::sum(sum, communicator);
  }
} // namespace Nacre
