// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_events_h
#define nacre_discretization_cut_events_h

#include <nacre/discretization/cut_crossings.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace Nacre
{
  /** A point of a cut in a cell: of its own, or on the boundary. */
  struct CutEvent
  {
    double     along;
    Point<dim> unit;
    /** The faces on which it lies, a bit each. */
    unsigned int faces = 0;
    /** Whether it is the first, the last point of an open cut. */
    bool is_begin = false;
    bool is_end   = false;
    /** Whether it has been moved onto a face. */
    bool is_moved = false;
  };

  using CutRun = std::vector<CutEvent>;

  /** Whether both are one point of a cell's boundary. */
  inline bool
  are_one_place(const CutEvent &a, const CutEvent &b)
  {
    return a.faces != 0 && a.faces == b.faces && a.unit == b.unit;
  }

  /** The geometry of a reference cell's faces. */
  class CutFaces
  {
  public:
    explicit CutFaces(const ReferenceCell &cell)
    {
      for (unsigned int f = 0; f < cell.n_faces(); ++f)
        ends_.push_back(
          {{cell.template vertex<dim>(cell.face_to_cell_vertices(f, 0, 1)),
            cell.template vertex<dim>(cell.face_to_cell_vertices(f, 1, 1))}});
    }

    unsigned int
    size() const
    {
      return ends_.size();
    }

    /** The part of the face at the foot of @p x. */
    double
    parameter(const unsigned int f, const Point<dim> &x) const
    {
      const Tensor<1, dim> e = ends_[f][1] - ends_[f][0];
      return (x - ends_[f][0]) * e / (e * e);
    }

    /** Distance in lengths of the face. */
    double
    distance(const unsigned int f, const Point<dim> &x) const
    {
      const Tensor<1, dim> e = ends_[f][1] - ends_[f][0];
      const Tensor<1, dim> d = x - ends_[f][0];
      return std::abs(e[0] * d[1] - e[1] * d[0]) / (e * e);
    }

    Point<dim>
    point(const unsigned int f, const double s) const
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = (1. - s) * ends_[f][0][d] + s * ends_[f][1][d];
      return x;
    }

    /** The faces of the point @p s of the face @p f, two at its ends. */
    unsigned int
    mask(const unsigned int f, const double s) const
    {
      unsigned int result = 1u << f;
      if (s == 0. || s == 1.)
        for (unsigned int g = 0; g < size(); ++g)
          for (unsigned int i = 0; i < 2; ++i)
            if (ends_[g][i] == ends_[f][s == 0. ? 0 : 1])
              result |= 1u << g;
      return result;
    }

  private:
    std::vector<std::array<Point<dim>, 2>> ends_;
  };

  /**
   * The runs of the cuts in a cell, with the numbers of the paths: what happens
   * along a cut while it stays in the cell. A closed cut that stays there
   * altogether ends with its first event.
   */
  std::vector<std::pair<unsigned int, CutRun>>
  cut_runs(const CutCrossings         &crossings,
           const std::vector<CutPath> &paths,
           const CutFaces             &faces,
           const CellMaps::Cell       &cell);

  /**
   * Where a cut comes from a face, or goes to it, a point of its own within the
   * distance @p snap from the face moves onto the face: else a sliver would be
   * beside a cut that runs along an edge but for round-off. What then goes
   * there and back is left out.
   */
  void
  snap_points(CutRun &run, const CutFaces &faces, const double snap);
} // namespace Nacre

#endif
