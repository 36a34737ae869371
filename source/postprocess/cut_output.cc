// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/output_file.h>
#include <nacre/postprocess/cut_output.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <utility>
#include <vector>

namespace Nacre
{
  void
  write_cut_lines(const Discretization &discretization, const std::string &name)
  {
    if (discretization.cell_parts().is_empty())
      return;
    const MPI_Comm communicator = discretization.communicator();
    using Line = std::pair<unsigned int, std::vector<Point<spacedim>>>;
    std::vector<Line> mine;
    for (const auto &line : discretization.cut_lines())
      mine.emplace_back(line.cut, line.points);
    const auto all = Utilities::MPI::gather(communicator, mine);

    using Patch = DataOutBase::Patch<1, spacedim>;
    std::vector<Patch> patches;
    for (const auto &of_rank : all)
      for (const auto &[cut, points] : of_rank)
        {
          Patch patch;
          patch.patch_index          = patches.size();
          patch.reference_cell       = ReferenceCells::Line;
          patch.n_subdivisions       = points.size() - 1;
          patch.points_are_available = true;
          patch.vertices[0]          = points.front();
          patch.vertices[1]          = points.back();
          patch.data.reinit(1 + spacedim, points.size());
          for (unsigned int q = 0; q < points.size(); ++q)
            {
              patch.data(0, q) = cut + 1;
              for (unsigned int c = 0; c < spacedim; ++c)
                patch.data(1 + c, q) = points[q][c];
            }
          patches.push_back(patch);
        }
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    run_on_root(communicator, [&] {
      write_file(name + ".vtu", [&](std::ostream &out) {
        DataOutBase::write_vtu(patches, {"cut"}, {}, flags, out);
      });
    });
  }
} // namespace Nacre
