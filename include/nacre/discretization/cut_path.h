// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_path_h
#define nacre_discretization_cut_path_h

#include <nacre/base/types.h>
#include <nacre/problem/cuts.h>

#include <deal.II/distributed/tria_base.h>

#include <deal.II/grid/reference_cell.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace Nacre
{
  /** The maps of the points of cells, with which cuts are traced. */
  struct CellMaps
  {
    using Cell = Triangulation<dim, spacedim>::cell_iterator;
    using Map =
      std::function<Point<spacedim>(const Cell &, const Point<dim> &)>;

    ReferenceCell reference_cell;
    /** To space (length). */
    Map position;
    /** To the chart (u, v, 0); empty if the surface has none. */
    Map chart = {};
    /** Of u and v, 0 where the chart isn't closed. */
    std::array<double, 2> periods{{0., 0.}};
  };

  /** The maps of @p surface, which must live as long as they do. */
  CellMaps
  make_cell_maps(const Midsurface    &surface,
                 const ReferenceCell &reference_cell);

  /**
   * The piece of a cut between two of its points: where the surface meets the
   * plane of the chord and of the direction `up`, the mean normal of the
   * surface at both ends. In the chart, `up` is the third axis.
   */
  struct CutLeg
  {
    Point<spacedim>     begin;
    double              length;
    Tensor<1, spacedim> along;
    Tensor<1, spacedim> up;
    /** The plane's unit normal, up x along. */
    Tensor<1, spacedim> side;

    /** Signed distance from the plane. */
    double
    offset(const Point<spacedim> &x) const
    {
      return (x - begin) * side;
    }

    /** Position along the chord: 0 at its begin, 1 at its end. */
    double
    part(const Point<spacedim> &x) const
    {
      return (x - begin) * along / length;
    }

    /** Not so for what the plane meets on the far side of a shell. */
    bool
    is_near(const Point<spacedim> &x) const
    {
      return std::abs((x - begin) * up) <= 0.5 * length;
    }
  };

  /** A cut in the coordinates in which it is straight between its points. */
  struct CutPath
  {
    bool is_in_chart = false;
    bool is_closed   = false;
    /** Points in space lie on the surface, or in its tangent planes beyond. */
    std::vector<Point<spacedim>> points;
    /** From each point to the next. */
    std::vector<CutLeg> legs;
  };

  /**
   * The paths of the curves of @p cuts. Points in space take the nearest point
   * of the surface; beyond its boundary they keep their distance along the
   * tangent plane there. Throws for points off the surface and where normals
   * turn by more than 90 degrees between two points. The same on all ranks;
   * collective.
   */
  std::vector<CutPath>
  make_cut_paths(const parallel::TriangulationBase<dim, spacedim> &mesh,
                 const CellMaps                                   &maps,
                 const Cuts                                       &cuts);
} // namespace Nacre

#endif
