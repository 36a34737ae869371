// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_edge_turns_h
#define nacre_forms_edge_turns_h

#include <nacre/discretization/shell_edge_values.h>

#include <vector>

namespace Nacre
{
  class Expression;
  struct EdgeConditions;

  /**
   * How prescribed displacements have turned an edge whose rotation is
   * prescribed as well: at each point of the edge the rotation Q that follows
   * its direction d(s) from s = 0 to the time t without spinning about it,
   * dQ/ds Q^T = (d x dd/ds) x. The displacement itself tells where an edge
   * points, not how it got there: opposite directions are joined by rotations
   * about any axis, and only the motion knows which.
   *
   * It depends on the prescribed expressions alone, not on the steps of a path.
   * Where the edge stays within a plane Q is the rotation about the plane's
   * normal, by any number of turns.
   *
   * Throws where an expression isn't finite, maybe on some ranks only; does not
   * communicate.
   * @param edge a boundary edge
   * @param load_factor factor of the prescribed displacements over the time
   * @return Q at the points of the edge
   */
  std::vector<Tensor<2, spacedim>>
  follow_edge_turns(const Discretization  &discretization,
                    const ShellEdgeValues &edge,
                    const EdgeConditions  &conditions,
                    const Expression      &load_factor,
                    const double           time);
} // namespace Nacre

#endif
