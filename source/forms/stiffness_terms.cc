// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/stiffness_terms.h>

namespace Nacre
{
  void
  StrainTerm::add_on_cell(TermCell &cell, LocalTerms &terms) const
  {
    const LocalState &state = cell.state;
    if (state.is_step())
      cell.kinematics().add_cell_step_terms(cell.part,
                                            state.u_start,
                                            state.u_end,
                                            terms);
    else
      cell.kinematics().add_cell_terms(cell.part, state.u, terms);
  }

  void
  RotationJumpTerm::add_between_cells(const TermEdge &edge,
                                      LocalTerms     &terms) const
  {
    if (edge.state.is_step())
      edge.kinematics.add_edge_step_terms(edge.values,
                                          edge.penalty,
                                          edge.state.u_start,
                                          edge.state.u_end,
                                          terms);
    else
      edge.kinematics.add_edge_terms(edge.values,
                                     edge.penalty,
                                     edge.state.u,
                                     terms);
  }

  bool
  PrescribedRotationTerm::acts_on_boundary(
    const types::boundary_id,
    const std::pair<unsigned int, unsigned int> &place,
    const ShellActions                          &actions) const
  {
    return actions.rotations.count(place) > 0;
  }

  void
  PrescribedRotationTerm::add_on_boundary(const TermEdge &edge,
                                          LocalTerms     &terms) const
  {
    const auto &rotation = edge.actions.rotations.at(edge.place);
    if (edge.state.is_step())
      edge.kinematics.add_rotation_step_terms(edge.values,
                                              edge.penalty,
                                              edge.state.rotations_start->at(
                                                edge.place),
                                              rotation,
                                              edge.state.u_start,
                                              edge.state.u_end,
                                              terms);
    else
      edge.kinematics.add_rotation_terms(edge.values,
                                         edge.penalty,
                                         rotation,
                                         edge.state.u,
                                         terms);
  }
} // namespace Nacre
