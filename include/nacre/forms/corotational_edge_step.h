// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_corotational_edge_step_h
#define nacre_forms_corotational_edge_step_h

#include <nacre/forms/corotational_edge.h>

namespace Nacre
{
  /**
   * Energy-momentum forces of the rotation-jump form over a step, at one point
   * of an edge: the differences of theta = n . lambda and
   * m_nn = n . mu + const, n = R t0, as linear functions of the change of the
   * positions (StepDifferences), with the means of both ends:
   *
   *   Delta(theta) = Delta(n) . lambda_m + n_m . Delta(lambda).
   *
   * Interior edges: n = c_b b + c_t t in the edge's frame, where b is the unit
   * vector orthogonal to the edge e = dx/ds and to the sum T of both normals,
   * and t the one orthogonal to e and b.
   *
   * Prescribed rotation: R takes the prescribed conormal p_b to b and the
   * prescribed normal p_t to t = n, both orthogonal to e; that it is, but for
   * these, the smallest rotation says p_b . t = p_t . b. Where p_b and p_t
   * change in the step, so does n, and the support does work.
   */
  class CorotationalEdgeStep
  {
  public:
    using Vector = Tensor<1, spacedim>;

    /**
     * @param start, end the point @p q at both ends, with the rotations
     *   @p rotation_start and @p rotation_end prescribed there
     */
    void
    reinit(const ShellEdgeValues               &edge,
           const unsigned int                   q,
           const CorotationalEdgePoint<double> &start,
           const CorotationalEdgePoint<double> &end,
           const PrescribedRotation            &rotation_start,
           const PrescribedRotation            &rotation_end);

    /** Add the force of each node of the @p side. */
    void
    add_force(const ShellEdgeValues &edge,
              const unsigned int     q,
              const unsigned int     side,
              NodeVectors<double>   &force) const;

    /** Work of the prescribed rotation (force times length). */
    double
    rotation_work() const
    {
      return rotation_work_;
    }

  private:
    struct Side
    {
      JumpSide linear;
      /** n_m. */
      Vector normal;
      /** Work conjugates of theta and m_nn. */
      double rotation_force;
      double moment_force;
      /** rotation_force lambda_m + moment_force mu_m: that of n. */
      Vector normal_force;
      /** Those of phi,alpha. */
      std::array<Vector, 2> basis_forces;
    };

    void
    turn_with_mean_normal(const ShellEdgeValues               &edge,
                          const unsigned int                   q,
                          const CorotationalEdgePoint<double> &start,
                          const CorotationalEdgePoint<double> &end);

    void
    turn_as_prescribed(const ShellEdgeValues                   &edge,
                       const unsigned int                       q,
                       const CorotationalEdgePoint<double>     &start,
                       const CorotationalEdgePoint<double>     &end,
                       const std::array<PrescribedRotation, 2> &rotations);

    unsigned int        n_sides_ = 0;
    std::array<Side, 2> sides_;
    /** Work conjugate of e. */
    Vector edge_force_;
    double rotation_work_ = 0.;
  };
} // namespace Nacre

#endif
