// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shell_components_h
#define nacre_discretization_shell_components_h

#include <nacre/discretization/discretization.h>

#include <vector>

namespace Nacre
{
  /**
   * The components of a shell: parts of cells belong to one component if they
   * share a node at a vertex, directly or by other parts. Cuts and meshes of
   * several surfaces make more than one.
   */
  class ShellComponents
  {
  public:
    /** Collective. */
    explicit ShellComponents(const Discretization &discretization);

    /** How many there are, the same on all ranks. */
    unsigned int
    size() const
    {
      return points_.size();
    }

    /** The number of the component of one of this rank's parts. */
    unsigned int
    of(const CellPart &part) const
    {
      return components_[part.index()];
    }

    /** A point of a component (length), the same on all ranks. */
    const Point<spacedim> &
    point(const unsigned int component) const
    {
      return points_[component];
    }

    /**
     * The components of nodes, given by their first dofs, all of which all
     * ranks give; collective.
     */
    std::vector<unsigned int>
    of_nodes(const std::vector<types::global_dof_index> &first_dofs) const;

  private:
    /** Numbers of this rank's parts and ghosts, joined on this rank alone. */
    std::vector<unsigned int>
    join_on_rank() const;

    /** Pairs of numbers of two ranks, offsets included, that are one. */
    std::vector<std::pair<unsigned int, unsigned int>>
    links_to_ghosts(const std::vector<unsigned int> &local,
                    const unsigned int               offset) const;

    const Discretization        &discretization_;
    std::vector<unsigned int>    components_; // by CellPart::index()
    std::vector<Point<spacedim>> points_;
  };
} // namespace Nacre

#endif
