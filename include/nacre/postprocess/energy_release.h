// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_energy_release_h
#define nacre_postprocess_energy_release_h

#include <nacre/postprocess/crack_extension.h>
#include <nacre/postprocess/shell_state.h>
#include <nacre/problem/loads.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  class CrackPoints;
  class ShellEdgeValues;

  /**
   * What a crack releases as its tip advances, by an integral over the cells
   * between two distances from the tip. Per length of the crack's front in the
   * mid-surface:
   *
   *   G = -d/ds [sum int W(s) j0(s) det(1 + s dq) dxi + sum int W^e(s) ds]
   *       - int F . u,g q^g dA + int_lips d/ds [(f . u - m theta(u)) ds],
   *
   * with energy_change() of the cells and edge_energy_change() of the edges
   * between them, CrackExtension's q, the force F per area and the force f and
   * the moment m per length of the lips. The second term is what -d/ds of the
   * potential -int f . u becomes by partial integration; it holds for a
   * pressure that follows, too. In dynamics F holds the forces of inertia: what
   * the kinetic energy changes by is a divergence, without q beyond the
   * plateau.
   */
  class EnergyRelease
  {
  public:
    /**
     * Throws on all ranks if between the tip and the plateau's end there is
     * anything but one smooth sheet with a straight crack: other edges, cuts
     * and tips, the crack's other end, creases, other regions, supports or
     * forces at points, supports at the lips, moments there unless kinematics
     * are linear; and of modes, with a foundation and as check_law() does.
     * Collective.
     */
    EnergyRelease(const SolvedShell  &shell,
                  const CrackTip     &tip,
                  const CrackPlateau &plateau,
                  const std::string  &where);

    /**
     * Throws unless the stored energy is a function of the strains. What a
     * section that remembers takes up depends on its path, and its derivative
     * with respect to the crack's length isn't what a crack releases.
     */
    static void
    check_law(const SectionLaw &section, const std::string &where);

    /** G (force): the energy (force times length) per length. Collective. */
    double
    rate() const;

    /**
     * The intensity, as unit_williams_field() defines it, by the interaction
     * I of the displacement u with a unit field X, g = unit_release_rate(),
     *
     *   K = I/(2 g),  I = [G(u + X) - G(u - X)]/2
     *
     * in linear kinematics. In large rotations of small strains I is that of
     * the Green strains with the linear strains of X, the displacement being
     * taken as seen from the surface around the tip, which turns with it, plus
     * what membrane forces do on the bent surface. Throws unless the section is
     * linear, homogeneous and isotropic. Collective.
     */
    double
    intensity(const CrackMode mode) const;

    struct All
    {
      double rate;
      /** K_I, K_II, K_M, K_T. */
      std::array<double, 4> intensities;
    };

    /** All at once, with the plate() at the tip. Collective. */
    All
    rate_and_intensities(const ElasticPlate &plate) const;

    /**
     * The plate at the tip; none unless the section is linear, homogeneous and
     * isotropic.
     */
    std::optional<ElasticPlate>
    plate() const;

    /** The same, or throws. */
    ElasticPlate
    plate_or_throw() const;

  private:
    /** A point of a lip with a weight. */
    struct LipPoint
    {
      const CrackPoints &points;
      const unsigned int q;
      /** Of the surface's boundary; none: a lip of a cut. */
      const std::optional<types::boundary_id> edge;
      /** What acts on the lip. */
      const LineLoad load;
      /** Along the lip in the reference cell, of length 1 on the surface. */
      Tensor<1, dim> tangent;
      /** As CrackEdgeSide::outward. */
      double outward;
      /** Length element times weight (length). */
      double length;
      /** What a length changes by as q moves it, times the weight (1). */
      double divergence;
      /** The velocity's component out of the lip. */
      double across;
      /** Positive on the side of e_2. */
      double side;
    };

    /**
     * Call @p function for this rank's cells that may be near to the tip, of
     * divided ones for all parts.
     */
    void
    for_each_part(const std::function<void(const CellPart &)> &function) const;

    /** For the same parts, with points that suit each. */
    void
    for_each_points(
      const std::function<void(const CrackPoints &, const CellPart &)>
        &function) const;

    /** For the free sides' points that move. */
    void
    for_each_lip_point(
      const std::function<void(const LipPoint &)> &function) const;

    /** For the edges between cells, or their pieces, that may be near. */
    void
    for_each_edge(
      const std::function<void(const ShellEdgeValues &)> &function) const;

    void
    check_model() const;

    void
    check_cuts() const;

    void
    check_lips() const;

    void
    check_inside() const;

    /** How the surface around the tip has turned; 1 in linear kinematics. */
    Tensor<2, 3>
    mean_rotation() const;

    /**
     * G of the displacement u, and behind it the interaction I with each of the
     * @p fields X, as intensity() has it. Collective.
     */
    std::vector<double>
    release(const std::vector<WilliamsField> &fields) const;

    /** Add what a part releases. */
    void
    add_part(const CrackPoints                &points,
             const CellPart                   &part,
             const std::vector<WilliamsField> &fields,
             std::vector<double>              &sums) const;

    /** Add what an edge between two parts releases. */
    void
    add_edge(const ShellEdgeValues            &edge,
             const std::vector<WilliamsField> &fields,
             std::vector<double>              &sums) const;

    /** Add what the forces at lips release. */
    void
    add_lips(const std::vector<WilliamsField> &fields,
             std::vector<double>              &sums) const;

    const SolvedShell &shell_;
    const CrackTip     tip_;
    const CrackPlateau plateau_;
    const bool         is_linear_;
    const std::string  where_;
    /** R. */
    Tensor<2, 3> rotation_;
  };
} // namespace Nacre

#endif
