// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A field with functions of a tip goes to a refined mesh: on a plate it is what
// it was around the tip, and everywhere at the new nodes.

#include "cut_shell.h"
#include <nacre/discretization/shell_values.h>

using namespace CutShells;

namespace
{
  const std::vector<CutCurve> crack = {line("crack", {{-.1, .43}, {.63, .48}})};

  CutShell
  cracked_plate(const Element &element, const KinematicsModel model)
  {
    return CutShell(surface_text("u, v, 0", 6, 6),
                    element,
                    crack,
                    {MembraneStrain::tied,
                     EdgeForm::rotation_jump,
                     model,
                     TangentType::consistent},
                    {},
                    CutTips::branch_functions);
  }

  /** @p u at a point of a part, functions of tips included. */
  Vector3
  value_in(const Discretization &discretization,
           const TrilinosVector &u,
           const CellPart       &part,
           const Point<2>       &unit)
  {
    ShellCellValues values(discretization,
                           Quadrature<2>(unit),
                           false,
                           ShellCellValues::Points::given);
    values.reinit_frames(part);
    std::vector<types::global_dof_index> dofs;
    discretization.get_dof_indices(part, dofs);
    Vector3 result;
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += values.shapes().value(0, a) * u(dofs[values.dof(a, c)]);
    for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
      result += u(dofs[values.tip_dof(k)]) * values.tip_function(0, k).value;
    return result;
  }

  void
  test_refinement(const Element &element, const KinematicsModel model)
  {
    const CutShell before = cracked_plate(element, model);
    const auto    &old    = *before.discretization;
    const auto     u      = random_field(old, 1.);
    CutShell       after  = cracked_plate(element, model);
    const auto     v =
      after.refine(Point<3>(.63, .48, 0.), element, crack, {&u}).front();
    const auto &now = *after.discretization;

    unsigned int n_at_tip = 0, n_in_ring = 0;
    double       at_tip = 0., at_nodes = 0.;
    const auto   difference =
      [&](const CellPart &part, const Point<2> &unit, const Point<3> &x) {
        const auto place = old.nearest(x);
        return (value_in(old, u, place.part, place.unit) -
                value_in(now, v, part, unit))
          .norm();
      };
    for (const CellPart &part : now.owned_parts())
      {
        const auto nodes = now.node_positions(part);
        const auto unit  = part.inner_point();
        if (part.enrichment() != nullptr &&
            part.enrichment()->shares[0].is_near)
          {
            ++n_at_tip;
            at_tip =
              std::max(at_tip, difference(part, unit, now.point_inside(part)));
          }
        else if (!part.is_cut() &&
                 old.nearest(now.point_inside(part)).part.enrichment() !=
                   nullptr)
          {
            ++n_in_ring;
            for (unsigned int a = 0; a < nodes.size(); ++a)
              at_nodes =
                std::max(at_nodes,
                         difference(part,
                                    now.scalar_fe().unit_support_point(a),
                                    nodes[a]));
          }
      }
    const auto name = label(element) + ", " + name_of(model);
    check_above(name + ": parts at the tip", n_at_tip, 8);
    check_below(name + ": the same around the tip", at_tip, 1e-7);
    check_above(name + ": cells around them", n_in_ring, 30);
    check_below(name + ": the same at nodes", at_nodes, 1e-7);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_refinement({ElementType::lagrange, 2}, KinematicsModel::linear);
  test_refinement({ElementType::lagrange, 3}, KinematicsModel::finite);
  return n_failures > 0;
}
