// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_tip_frame_h
#define nacre_discretization_tip_frame_h

#include <nacre/discretization/cell_part.h>
#include <nacre/discretization/cut_trace.h>
#include <nacre/discretization/tip_functions.h>

#include <deal.II/fe/fe.h>

#include <vector>

namespace Nacre
{
  /** phi0 and its first derivatives (length) of the nodes @p nodes (length). */
  FieldDerivatives
  surface_at(const FiniteElement<dim, spacedim> &fe,
             const std::vector<Point<spacedim>> &nodes,
             const Point<dim>                   &unit);

  /** The tip's place and axes on the @p surface there. */
  TipFunctions::Tip
  tip_frame(const CutTrace::Tip &tip, const FieldDerivatives &surface);

  /**
   * The reference cell's direction of length 1 backward along the crack, from
   * the @p surface at the tip.
   */
  Tensor<1, dim>
  backward_from_tip(const TipFunctions::Tip &frame,
                    const FieldDerivatives  &surface);

  /** Whether the tip lies inside of the part, not on its outline. */
  bool
  holds_tip(const CutTrace::Tip &tip, const CellPart &part);
} // namespace Nacre

#endif
