// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_part_tying_h
#define nacre_discretization_part_tying_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/membrane_tying.h>

#include <deal.II/base/quadrature.h>

#include <vector>

namespace Nacre
{
  /**
   * MembraneTying::projected() over a part of a divided cell.
   * @param rule of the part, part_quadrature()
   * @param targets where the strain is wanted, in the reference cell: on the
   *   part or on its boundary
   */
  MembraneTying
  part_tying(const Discretization          &discretization,
             const CellPart                &part,
             const Quadrature<dim>         &rule,
             const std::vector<Point<dim>> &targets);
} // namespace Nacre

#endif
