// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_edges_h
#define nacre_postprocess_crack_edges_h

#include <nacre/discretization/shell_edge_values.h>
#include <nacre/postprocess/crack_points.h>
#include <nacre/problem/loads.h>

#include <array>

namespace Nacre
{
  /** A side of an edge between two cells, at a point that moves with a tip. */
  struct CrackEdgeSide
  {
    /**
     * Of the point @p q of the side @p side of an edge.
     * @param points edge.unit_points(side) of that side's part
     */
    CrackEdgeSide(const CrackTip        &tip,
                  const CrackPlateau    &plateau,
                  const ShellEdgeValues &edge,
                  const unsigned int     side,
                  const unsigned int     q,
                  const CrackPoints     &points);

    /**
     * Of the point @p q of a lip.
     * @param tangent, outward as below
     */
    CrackEdgeSide(const CrackTip       &tip,
                  const CrackPlateau   &plateau,
                  const CrackPoints    &points,
                  const unsigned int    q,
                  const Tensor<1, dim> &tangent,
                  const double          outward);

    SurfacePatch      surface;
    CrackExtension    extension;
    VectorDerivatives u;
    /** What a tied membrane strain has more than that of u. */
    Voigt<> tying;
    /** Components of the edge's unit tangent d, one vector on both sides. */
    Tensor<1, dim> tangent;
    /** The conormal is nu = outward d x t0. */
    double outward;
    /** -1: the cell has the opposite orientation of the side 0; (N.14). */
    double sigma;
  };

  /**
   * d/ds at s = 0 of the energy of an edge between two cells, per length of the
   * undeformed edge (force), as its points move and both sides carry their
   * displacements along, see energy_change():
   *
   *   W(s) = [1/2 eta^e D theta^2 - {lambda m_nn} theta] |d + s d.dq|,
   *
   * in linear kinematics with the jump theta = [[theta(u)]] and lambda = 1,
   * (N.12); else with the angle theta and the stretch lambda of (N.21),
   * (N.24), (N.25). The penalty eta^e stays.
   *
   * @param penalty eta^e (1/length)
   * @param length over which q varies
   */
  double
  edge_energy_change(const SectionAt                    &section,
                     const bool                          is_linear,
                     const std::array<CrackEdgeSide, 2> &sides,
                     const double                        penalty,
                     const double                        length);

  /**
   * The same of the interaction with a field X, whose rotations and moments are
   * those of linear kinematics, see interaction_change():
   *
   *   W(s) = [(eta^e D theta - {lambda m_nn}) theta(X)
   *           - {lambda m_nn(X)} theta] |d + s d.dq|.
   *
   * @param X derivatives (1) on both sides
   */
  double
  edge_interaction_change(const SectionAt                        &section,
                          const bool                              is_linear,
                          const std::array<CrackEdgeSide, 2>     &sides,
                          const std::array<VectorDerivatives, 2> &X,
                          const double                            penalty,
                          const double                            length);

  /**
   * d/ds at s = 0 of the work of a dead load of a lip, per length of the
   * undeformed lip (force), as its points move and carry the displacement u
   * along:
   *
   *   [(f - p nu) . u - m theta(u)] |d + s d.dq|,
   *
   * with the load's f, p and m at the moved point and theta of (N.11), the
   * rotation of linear kinematics.
   *
   * @param u (length); side.u are its derivatives
   * @param length over which q varies
   */
  double
  lip_work_change(const LineLoad            &load,
                  const Instant             &instant,
                  const CrackEdgeSide       &side,
                  const Tensor<1, spacedim> &u,
                  const double               length);
} // namespace Nacre

#endif
