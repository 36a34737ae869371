// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/discretization.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/simulation/conditioning.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Nacre
{
  std::string
  Conditioning::cause() const
  {
    std::ostringstream thin, cells, text;
    thin << std::fixed << std::setprecision(0);
    cells << std::fixed << std::setprecision(1);
    thin << "the shell is " << slenderness
         << " times as long as thick, so that stretching is much stiffer than "
            "bending";
    cells << "cells are up to " << elongation << " times as long as wide";
    if (elongation * elongation > slenderness)
      text << cells.str() << ". Besides, " << thin.str()
           << ". Cells of more equal sides help";
    else
      text << thin.str() << ". Besides, " << cells.str()
           << ". Fewer unknowns lose fewer digits";
    return text.str() + ".";
  }


  Conditioning
  measure_conditioning(const Discretization &discretization,
                       const SectionLaw     &section)
  {
    const MPI_Comm communicator = discretization.communicator();
    Conditioning   result;
    double         thinnest = std::numeric_limits<double>::max();
    run_on_all_ranks(communicator, [&]() {
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            double longest  = 0.;
            double shortest = std::numeric_limits<double>::max();
            for (const unsigned int k : cell->line_indices())
              {
                const auto   line   = cell->line(k);
                const double length = line->vertex(0).distance(line->vertex(1));
                longest             = std::max(longest, length);
                shortest            = std::min(shortest, length);
              }
            const double h = section.thickness(
              SectionPoint(cell->center(), cell->material_id()));
            result.elongation = std::max(result.elongation, longest / shortest);
            thinnest          = std::min(thinnest, h);
          }
    });
    result.elongation  = Utilities::MPI::max(result.elongation, communicator);
    result.slenderness = discretization.extent().second /
                         Utilities::MPI::min(thinnest, communicator);
    return result;
  }
} // namespace Nacre
