// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_edge_step_h
#define nacre_forms_finite_edge_step_h

#include <nacre/forms/finite_edge.h>

namespace Nacre
{
  /**
   * Energy-momentum forces of FiniteEdgePoint's energy over a step, at one
   * point of an edge: with the means of both ends (index m)
   *
   *   Delta(W) = (eta^e D theta_m - M_m) Delta(theta) - theta_m Delta(M),
   *   Delta(lambda m_nn) = lambda_m Delta(m_nn) + m_m Delta(lambda),
   *
   * M = {lambda m_nn}, and every difference is a linear function of the change
   * of the positions that annuls infinitesimal rigid motions of the mean ones
   * (StepDifferences):
   *
   * - Delta(theta) = (delta/2) / sin(delta/2) (cos(alpha_m) Delta(y) -
   *   sin(alpha_m) Delta(x)), delta = Delta(alpha), of the cosine
   *   x = t^- . t^+ and the sine y = -nu^- . t^+ of alpha;
   * - m_nn = -(Y . t) + c : E + const; Delta(E) is dE at the mean positions;
   * - lambda = nu . p, p = phi,a nu0^a;
   * - nu is the unit vector orthogonal to the edge e = dx/ds and to t.
   *
   * Prescribed rotation: t^+ is t_bar, with the difference of
   * CorotationalEdgeStep. Where the rotation changes in the step, the support
   * does work.
   */
  class FiniteEdgeStep
  {
  public:
    using Vector = Tensor<1, spacedim>;

    /**
     * @param start, end the point @p q at both ends, with the rotations
     *   @p rotations prescribed there
     */
    void
    reinit(const ShellEdgeValues                   &edge,
           const unsigned int                       q,
           const FiniteEdgePoint<double>           &start,
           const FiniteEdgePoint<double>           &end,
           const std::array<PrescribedRotation, 2> &rotations);

    /** Add the force of each node of the @p side. */
    void
    add_force(const ShellEdgeValues &edge,
              const unsigned int     q,
              const unsigned int     side,
              NodeVectors<double>   &force) const;

    /**
     * Work conjugate of E of the side @p s at the mean positions, for sections
     * that couple membrane and bending: TiedGreenStrain::take_means().
     */
    const Voigt<> &
    membrane_force(const unsigned int s) const
    {
      return sides_[s].membrane_force;
    }

    /** Work of the prescribed rotation (force times length). */
    double
    rotation_work() const
    {
      return rotation_work_;
    }

  private:
    struct Side
    {
      /** Row of y = h^ab v,ab, and its work conjugate. */
      std::vector<double> moment_row;
      Vector              moment_force;
      Voigt<>             membrane_force;
      /** Work conjugates of phi,alpha. */
      std::array<Vector, 2> basis_forces;
      /** Of t, nu, p and e. */
      Vector normal_force;
      Vector conormal_force;
      Vector stretch_force;
      Vector edge_force;
    };

    /** Forces of Delta(theta). */
    void
    add_angle_forces(const FiniteEdgePoint<double>           &start,
                     const FiniteEdgePoint<double>           &end,
                     const ShellEdgeValues                   &edge,
                     const unsigned int                       q,
                     const std::array<PrescribedRotation, 2> &rotations);

    /** Forces of Delta(lambda m_nn) of the side @p s. */
    void
    add_moment_forces(const FiniteEdgePoint<double> &start,
                      const FiniteEdgePoint<double> &end,
                      const ShellEdgeValues         &edge,
                      const unsigned int             q,
                      const unsigned int             s);

    /** What the force @p force_t of t_bar does to the edge; sets the work. */
    void
    turn_as_prescribed(const FiniteEdgePoint<double>           &start,
                       const FiniteEdgePoint<double>           &end,
                       const ShellEdgeValues                   &edge,
                       const unsigned int                       q,
                       const std::array<PrescribedRotation, 2> &rotations,
                       const Vector                            &force_t);

    /** basis_forces from all others of the side @p s. */
    void
    set_basis_forces(const FiniteEdgePoint<double> &start,
                     const FiniteEdgePoint<double> &end,
                     const ShellEdgeValues         &edge,
                     const unsigned int             q,
                     const unsigned int             s);

    std::array<Side, 2> sides_;
    double              rotation_work_ = 0.;
  };
} // namespace Nacre

#endif
