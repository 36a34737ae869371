// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_stress_criterion_h
#define nacre_simulation_stress_criterion_h

#include <nacre/postprocess/crack_tip.h>
#include <nacre/postprocess/line_stress.h>
#include <nacre/problem/cuts.h>
#include <nacre/problem/growth.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /** The tension across a line ahead of a tip. */
  struct AveragedHoopStress
  {
    /** Of the line, from ahead to t0 x ahead (rad). */
    double angle = 0.;
    /** The mean stress (force/length^2). */
    double value = 0.;
  };

  /**
   * The hoop stress at the faces and in the middle of the shell, averaged over
   * a distance d from the tip,
   *
   *   s(theta) = max over z = 0, +-h/2 of 1/d int_0^d s_tt(r, theta, z) dr,
   *
   * where it is largest, |theta| <= 90 degrees: the line method (Novozhilov
   * 1969; Taylor, The Theory of Critical Distances, 2007). The line ends at an
   * edge or a cut. Collective.
   * @param cut the tip's own
   * @param distance d (length)
   * @param angle none: all of them
   * @param tip its name, for messages
   */
  AveragedHoopStress
  averaged_hoop_stress(const ShellState           &state,
                       const CrackTip             &crack,
                       const unsigned int          cut,
                       const double                distance,
                       const std::optional<double> angle,
                       const std::string          &tip);

  /** A place away from tips where a crack may start. */
  struct CrackStart
  {
    Point<spacedim> position;
    /** @name Of length 1 */
    //@{
    /** Along the crack, perpendicular to the largest tension. */
    Tensor<1, spacedim> direction;
    Tensor<1, spacedim> normal;
    //@}
    /** How far the crack advances on each side (length). */
    double step = 0.;
    /** d (length). */
    double distance = 0.;
    /** The largest principal stress there (force/length^2). */
    double stress = 0.;
    /** Where the line of the crack ends behind and ahead of the position. */
    std::array<LineEnd, 2> ends = {};
    /** The averaged stress over the strength (1). */
    double drive = 0.;
    /** By which the mean tension would turn the crack, about normal (rad). */
    double turn = 0.;
  };

  /**
   * The places where the tension is largest, the largest first. It is the
   * stress in the principal direction of a point, at the faces and in the
   * middle of the shell, averaged over a line of length d perpendicular to
   * that. The point is the line's middle, but the line doesn't leave the
   * surface and crosses no cut: it begins at an edge that is near. The largest
   * are improved by moves across the crack and by turns to the mean stress.
   * Places within 2 d of a tip are left out, and of places within d + step of
   * each other all but the first. Collective.
   * @param n_most how many places at most; all are within Growth::tolerance
   */
  std::vector<CrackStart>
  find_crack_starts(const ShellState  &state,
                    const Growth      &growth,
                    const unsigned int n_most);

  /** The cut of a crack that starts. */
  struct CutStart
  {
    CutCurve curve;
    /** Whether its ends are tips. */
    bool has_begin, has_end;
  };

  /**
   * A cut of a step to both sides of a place, or from an edge or a cut inwards
   * if that lies within d. It doesn't end less than a quarter of a step from an
   * edge or a cut, but there. It is named "started N" after the others.
   * Collective.
   * @param cuts those of @p discretization
   */
  CutStart
  make_cut(const Discretization &discretization,
           const CrackStart     &place,
           const Cuts           &cuts);
} // namespace Nacre

#endif
