// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/field_at_point.h>
#include <nacre/discretization/field_projection.h>
#include <nacre/discretization/part_quadrature.h>

namespace Nacre
{
  namespace
  {
    std::vector<std::vector<double>>
    local_values(
      const Discretization                                     &discretization,
      const CellPart                                           &part,
      const std::vector<const TrilinosWrappers::MPI::Vector *> &fields,
      std::vector<types::global_dof_index>                     &dofs)
    {
      discretization.get_dof_indices(part, dofs);
      std::vector<std::vector<double>> values;
      for (const auto *const field : fields)
        {
          values.emplace_back();
          for (const auto i : dofs)
            values.back().push_back((*field)(i));
        }
      return values;
    }

    /** Around the tip of before, which only nodes' functions of now meet. */
    Quadrature<dim>
    rule_for_both(const CellPart    &before,
                  const CellPart    &now,
                  const unsigned int degree)
    {
      for (const CellPart *const part : {&before, &now})
        if (part->enrichment() != nullptr)
          return enriched_quadrature(*part, degree);
      return part_quadrature(now.outline(), degree);
    }
  } // namespace

  FieldProjection::FieldProjection(const Discretization &discretization,
                                   const std::vector<const Vector *> &fields)
    : parts_(discretization.triangulation().n_active_cells())
  {
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization.owned_parts())
      {
        PartFields of_part{outline_of(part),
                           nullptr,
                           local_values(discretization, part, fields, dofs)};
        if (part.data != nullptr)
          of_part.enrichment = part.data->enrichment;
        parts_[part.cell->active_cell_index()].push_back(std::move(of_part));
      }
  }

  std::vector<FieldProjection::Vector>
  FieldProjection::missing(const Discretization              &discretization,
                           const std::vector<const Vector *> &fields,
                           const SectionLaw                  &section) const
  {
    std::vector<Vector>  result(fields.size(),
                               Vector(discretization.locally_owned_dofs(),
                                      discretization.communicator()));
    std::vector<Outline> outlines;
    for (const CellPart &part : discretization.owned_parts())
      {
        const auto &candidates = parts_[part.cell->active_cell_index()];
        // Where all was removed: a sliver, which follows another part.
        if (candidates.empty())
          continue;
        outlines.clear();
        for (const PartFields &candidate : candidates)
          outlines.push_back(candidate.outline);
        const PartFields &before =
          candidates[nearest_outline(outlines, part.inner_point()).first];
        // Cells far from cuts and tips are what they were.
        if (part.data != nullptr || before.enrichment != nullptr)
          add_on_part(discretization, fields, section, part, before, result);
      }
    for (Vector &b : result)
      b.compress(VectorOperation::add);
    return result;
  }

  void
  FieldProjection::add_on_part(const Discretization &discretization,
                               const std::vector<const Vector *> &fields,
                               const SectionLaw                  &section,
                               const CellPart                    &part,
                               const PartFields                  &before,
                               std::vector<Vector>               &result) const
  {
    // The part as it is now with the functions of before.
    PartData data;
    if (part.data != nullptr)
      data = *part.data;
    data.enrichment = before.enrichment;
    const CellPart as_before(part.cell, &data);
    const auto rule = rule_for_both(as_before, part, discretization.degree());
    using Points    = ShellCellValues::Points;
    ShellCellValues values(discretization, rule, false, Points::given);
    ShellCellValues values_before(discretization, rule, false, Points::given);
    values.reinit_frames(part);
    values_before.reinit_frames(as_before);

    std::vector<types::global_dof_index> dofs;
    const auto now = local_values(discretization, part, fields, dofs);
    dealii::Vector<double> local(dofs.size());
    for (unsigned int k = 0; k < fields.size(); ++k)
      {
        local = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const auto   x = values.point(q);
            const double dm =
              section.density(x) * section.thickness(x) * values.JxW(q);
            const auto lost =
              field_at_point(values_before, q, before.values[k]) -
              field_at_point(values, q, now[k]);
            add_force_at_point(values, q, dm * lost, local);
          }
        result[k].add(dofs, std::vector<double>(local.begin(), local.end()));
      }
  }
} // namespace Nacre
