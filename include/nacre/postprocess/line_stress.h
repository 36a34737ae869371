// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_line_stress_h
#define nacre_postprocess_line_stress_h

#include <nacre/postprocess/point_results.h>

#include <array>
#include <optional>
#include <vector>

namespace Nacre
{
  /**
   * A line along the surface: the points nearest to those of a straight one
   * in the tangent plane of a point.
   */
  struct SurfaceLine
  {
    Point<spacedim> origin;
    /** @name Of length 1, perpendicular to each other */
    //@{
    Tensor<1, spacedim> direction;
    Tensor<1, spacedim> normal;
    //@}
    double length;
  };

  /** How far a line goes along the surface. */
  struct LineEnd
  {
    /** From the origin (length). */
    double distance;
    /** What ends it; none: the line is that long. */
    bool at_edge = false, at_cut = false;

    bool
    is_free() const
    {
      return !at_edge && !at_cut;
    }
  };

  /**
   * Where lines first meet an edge of the surface or a cut. Lines may begin on
   * one. Collective.
   * @param ignored a cut that doesn't matter
   */
  std::vector<LineEnd>
  find_line_ends(const Discretization             &discretization,
                 const std::vector<SurfaceLine>   &lines,
                 const std::optional<unsigned int> ignored = {});

  /** Throws unless @p stress, or a sum of some, is finite (force/length^2). */
  void
  check_stress(const double stress);

  /**
   * The mean of the stress over a line, in the axes m = t0 x direction and c,
   * the direction: m . S m, m . S c, c . S c (force/length^2).
   */
  struct LineStress
  {
    double across = 0., shear = 0., along = 0.;
  };

  /**
   * The mean stresses of lines, by Face,
   *
   *   1/l int_0^l m . S m dr                                 (force/length^2),
   *
   * and the like, which may have a singularity r^-1/2 at the line's origin. Of
   * points on edges between cells the mean of the cells' values is taken;
   * points off the surface are left out. Collective.
   */
  std::vector<std::array<LineStress, n_faces>>
  mean_stresses(const ShellState &state, const std::vector<SurfaceLine> &lines);
} // namespace Nacre

#endif
