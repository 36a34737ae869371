// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cell_polygon_h
#define nacre_discretization_cell_polygon_h

#include <nacre/base/types.h>

#include <vector>

namespace Nacre
{
  /** A polyline through a reference cell, along which it is cut. */
  struct CutChain
  {
    /** At least two; a closed chain ends with its first point. */
    std::vector<Point<dim>> points;
    /** Number of the cut. */
    unsigned int cut;
  };
} // namespace Nacre

#endif
