// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/tip_dofs.h>

namespace Nacre
{
  unsigned int
  TipDofs::n_owned_functions() const
  {
    const auto   me = Utilities::MPI::this_mpi_process(communicator_);
    unsigned int n  = 0;
    for (const Range &range : ranges_)
      if (range.owner == me)
        n += range.n_functions;
    return n;
  }

  void
  TipDofs::number(const std::vector<Dof> &ends)
  {
    std::vector<Dof> next(ends);
    for (const Range &range : ranges_)
      next[range.owner] -= range.n_functions;
    dofs_.set_size(ends.back());
    for (Range &range : ranges_)
      {
        range.first = next[range.owner];
        next[range.owner] += range.n_functions;
        dofs_.add_range(range.first, next[range.owner]);
      }
    dofs_.compress();
  }
} // namespace Nacre
