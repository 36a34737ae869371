// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_dofs_h
#define nacre_discretization_tip_dofs_h

#include <nacre/discretization/cell_parts.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <functional>
#include <vector>

namespace Nacre
{
  /**
   * What the functions of all tips have in common: dofs of their own. They
   * belong to the rank that owns the cell in which the tip lies, and are the
   * last ones of that rank.
   */
  class TipDofs
  {
  public:
    using Dof = types::global_dof_index;

    virtual ~TipDofs() = default;

    /** Of this rank's tips. */
    unsigned int
    n_owned_functions() const;

    /**
     * Set PartData::enrichment and append the functions' dofs to those of the
     * parts; collective.
     * @param ends of the ranges of the dofs that ranks own, which the
     *   functions' dofs end
     */
    virtual void
    complete(const std::vector<Dof> &ends, CellParts &parts) = 0;

    /** Of the functions of the tip @p t, of whatever rank. */
    Dof
    first_dof(const unsigned int t) const
    {
      return ranges_[t].first;
    }

    /** The dofs of all functions, of all ranks. */
    const IndexSet &
    dofs() const
    {
      return dofs_;
    }

  protected:
    TipDofs(const MPI_Comm communicator, const unsigned int n_tips)
      : communicator_(communicator)
      , ranges_(n_tips)
    {}

    /** The functions of a tip, known to all ranks. */
    struct Range
    {
      /** The rank that owns the tip's cell. */
      unsigned int owner       = numbers::invalid_unsigned_int;
      unsigned int n_functions = 0;
      Dof          first       = 0;
    };

    /** Set Range::first, and dofs(); @p ends as for complete(). */
    void
    number(const std::vector<Dof> &ends);

    const MPI_Comm     communicator_;
    std::vector<Range> ranges_; // by tip

  private:
    IndexSet dofs_;
  };
} // namespace Nacre

#endif
