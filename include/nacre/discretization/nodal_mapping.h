// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_nodal_mapping_h
#define nacre_discretization_nodal_mapping_h

#include <nacre/base/types.h>

#include <deal.II/fe/mapping_fe.h>

#include <functional>
#include <memory>
#include <vector>

namespace Nacre
{
  /**
   * The isoparametric map (18) of any nodal element: phi0 = sum_a N^a X0^a
   * with the nodes' positions from a callback.
   */
  class NodalMapping : public MappingFE<dim, spacedim>
  {
  public:
    using cell_iterator = Triangulation<dim, spacedim>::cell_iterator;
    /** Positions (length) of the element's nodes on a cell. */
    using Positions =
      std::function<std::vector<Point<spacedim>>(const cell_iterator &)>;

    NodalMapping(const FiniteElement<dim, spacedim> &fe,
                 const Positions                    &positions)
      : MappingFE<dim, spacedim>(fe)
      , positions_(positions)
    {}

    NodalMapping(const NodalMapping &other) = default;

    /** The nodes need not lie at the mesh's vertices. */
    bool
    preserves_vertex_locations() const override
    {
      return false;
    }

    std::unique_ptr<Mapping<dim, spacedim>>
    clone() const override
    {
      return std::make_unique<NodalMapping>(*this);
    }

  protected:
    std::vector<Point<spacedim>>
    compute_mapping_support_points(const cell_iterator &cell) const override
    {
      return positions_(cell);
    }

  private:
    const Positions positions_;
  };
} // namespace Nacre

#endif
