// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/discretization/part_transfer.h>

#include <algorithm>

namespace Nacre
{
  PartTransfer::PartTransfer(const Discretization              &discretization,
                             const std::vector<const Vector *> &fields)
    : parts_(discretization.triangulation().n_active_cells())
  {
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization.relevant_parts())
      {
        discretization.get_dof_indices(part, dofs);
        dofs.resize(discretization.node_dofs().size());
        FormerPart former;
        if (part.is_cut())
          former.polygon = part.polygon();
        for (const Vector *const field : fields)
          {
            former.values.emplace_back();
            for (const auto dof : dofs)
              former.values.back().push_back((*field)(dof));
          }
        parts_[part.cell->active_cell_index()].push_back(std::move(former));
      }
  }

  const PartTransfer::FormerPart &
  PartTransfer::former_part(const Discretization &discretization,
                            const CellPart       &part) const
  {
    const auto &formers = parts_[part.cell->active_cell_index()];
    const auto  inside =
      part.is_cut() ?
         part.polygon().inner_point() :
         discretization.element().reference_cell().barycenter<dim>();
    const auto found =
      std::find_if(formers.begin(),
                   formers.end(),
                   [&](const FormerPart &former) {
                     return !former.polygon ||
                            former.polygon->contains(inside, 0.);
                   });
    AssertThrow(found != formers.end(),
                ExcMessage("Growth/Tips: a part of the cell around (" +
                           Text::number(part.cell->center()[0]) + ", " +
                           Text::number(part.cell->center()[1]) + ", " +
                           Text::number(part.cell->center()[2]) +
                           ") belongs to no part of before; cuts may only "
                           "become longer."));
    return *found;
  }

  PartTransfer::Vector
  PartTransfer::field_on(const Discretization &discretization,
                         const unsigned int    k) const
  {
    Assert(parts_.size() == discretization.triangulation().n_active_cells(),
           ExcInternalError());
    const IndexSet &owned = discretization.locally_owned_dofs();
    Vector          field(owned, discretization.communicator());
    std::vector<types::global_dof_index> dofs;
    // Parts of ghosts, too: the owner of a copy need not have a part of it.
    for (const CellPart &part : discretization.relevant_parts())
      {
        const FormerPart &former = former_part(discretization, part);
        discretization.get_dof_indices(part, dofs);
        for (unsigned int i = 0; i < former.values[k].size(); ++i)
          if (owned.is_element(dofs[i]))
            field(dofs[i]) = former.values[k][i];
      }
    field.compress(VectorOperation::insert);
    discretization.node_constraints().distribute(field);
    return field;
  }
} // namespace Nacre
