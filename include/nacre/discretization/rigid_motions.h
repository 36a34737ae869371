// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_rigid_motions_h
#define nacre_discretization_rigid_motions_h

#include <nacre/base/types.h>

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * The six rigid motions u = tau + omega x (X - centre) / length of a body,
   * and which of them a set of supports leaves free.
   */
  class RigidMotions
  {
  public:
    using Vector3 = Tensor<1, spacedim>;

    /** @param centre of the body @param length its size, to scale rotations */
    RigidMotions(const Point<spacedim> &centre, const double length);

    /** Hold the displacement along the unit vector @p direction at a point. */
    void
    hold_displacement(const Point<spacedim> &point, const Vector3 &direction);

    /** Hold the rotation about the unit vector @p axis. */
    void
    hold_rotation(const Vector3 &axis);

    /** Hold what @p motions of any rank hold, too. Collective. */
    void
    add_of_all_ranks(const RigidMotions &motions, const MPI_Comm communicator);

    /**
     * The motions that nothing holds, in words: "translation along (1, 0, 0)",
     * "rotation about (0, 0, 1) through (5, 0, 0)"; as many pure translations
     * as possible.
     */
    std::vector<std::string>
    free_motions() const;

  private:
    /** (tau, omega) */
    using Motion = std::array<Vector3, 2>;

    void
    hold(const Motion &motion);

    /** A basis of the free motions. */
    std::vector<Motion>
    null_space() const;

    /** Combine @p motions so that few of them rotate. */
    static void
    reduce(std::vector<Motion> &motions);

    const Point<spacedim> centre_;
    const double          length_;
    /** Sum of m (x) m over the motions m held, 6 x 6. */
    FullMatrix<double> held_;
  };
} // namespace Nacre

#endif
