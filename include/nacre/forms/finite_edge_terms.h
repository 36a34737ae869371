// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_edge_terms_h
#define nacre_forms_finite_edge_terms_h

#include <nacre/forms/finite_edge_step.h>

namespace Nacre
{
  /**
   * Energy, force and tangent of an edge with exact finite rotations, in
   * numbers of the dofs: the chain from FiniteEdgePoint to the matrix,
   *
   *   K = sum_q X_q + X_q^T + sum over sides and kinds k, l of
   *       R_k[a] K_kl R_l[b],
   *
   * X_q = dtheta (1/2 eta^e D dtheta - d{lambda m_nn}) of all dofs, R_k the
   * scalar rows of v_e, v_n and y, and K_kl FiniteEdgePoint::hessian().
   *
   * Sections that couple membrane and bending add the share of the tied strain
   * E in m_nn: its rows M_q = c : dE belong to d{lambda m_nn} in X_q, and with
   * g = FiniteEdgePoint::moment_force() there is, for each side,
   *
   *   g dlambda M_q + (g dlambda M_q)^T + g lambda c : d2E.
   *
   * TangentType::stress leaves out X_q, StrainMeasure::linear all but X_q.
   */
  class FiniteEdgeTerms
  {
  public:
    /**
     * @param measure, tangent_type of FiniteKinematics
     * @param states of the section; null: all are at rest
     */
    FiniteEdgeTerms(const SectionLaw   &section,
                    const StrainMeasure measure,
                    const TangentType   tangent_type,
                    SectionStates      *states);

    /** Of initial strains. */
    void
    set_instant(const Instant &instant)
    {
      point_.set_instant(instant);
      for (auto &point : ends_point_)
        point.set_instant(instant);
    }

    /**
     * Add the terms at the displacement @p u of the edge's dofs; zero if empty.
     * @param rotation not used for interior edges
     */
    void
    add(const ShellEdgeValues                 &edge,
        const double                           penalty,
        const std::vector<PrescribedRotation> &rotation,
        const Vector<double>                  &u,
        LocalTerms                            &terms);

    /** Kinematics::add_rotation_step_terms(), rotations [end][q]. */
    void
    add_step(
      const ShellEdgeValues                                        &edge,
      const double                                                  penalty,
      const std::array<const std::vector<PrescribedRotation> *, 2> &rotations,
      const std::array<const Vector<double> *, 2>                  &u,
      LocalTerms                                                   &terms);

    /** |theta| (rad) at the point @p q of a boundary edge; linear: 0. */
    double
    rotation_gap(const ShellEdgeValues    &edge,
                 const unsigned int        q,
                 const PrescribedRotation &rotation,
                 const Vector<double>     &u);

    /**
     * The load -int m t . dv/dnu ds0 of FollowingMoment, minus as a residual,
     * and its derivative; linear: that of the undeformed edge.
     */
    void
    add_moment(const ShellEdgeValues     &edge,
               const std::vector<double> &moment,
               const Vector<double>      &u,
               LocalTerms                &terms);

  private:
    /** The membrane strains of all sides at u_; with coupling only. */
    void
    evaluate_membrane(const ShellEdgeValues &edge);

    /** What reinit() of a point takes. */
    const std::array<TiedGreenStrain<double>, 2> *
    strains_or_none(const std::array<TiedGreenStrain<double>, 2> &strains) const
    {
      return section_.is_coupled() ? &strains : nullptr;
    }

    /** Add the force of what all points do to the membrane strains. */
    void
    add_membrane_residual(const ShellEdgeValues &edge, LocalTerms &terms);

    /** Room for the rows of all points. */
    void
    reinit_rows(const ShellEdgeValues &edge);

    /** What E adds to the rows of X at the point @p q of point_. */
    void
    add_membrane_rows(const ShellEdgeValues &edge,
                      const unsigned int     side,
                      const unsigned int     q);

    /** g lambda c : d2E of all points of a side. */
    void
    add_membrane_tangent(const ShellEdgeValues &edge,
                         const unsigned int     side,
                         LocalTerms            &terms);

    /** The rows of the sides and of X at the point @p q of point_. */
    void
    fill_rows(const ShellEdgeValues &edge, const unsigned int q);

    void
    add_side_tangent(const ShellEdgeValues &edge,
                     const unsigned int     side,
                     LocalTerms            &terms);

    void
    add_jump_tangent(LocalTerms &terms);

    /** The products of the rows of all points. */
    void
    add_tangent(const ShellEdgeValues &edge, LocalTerms &terms);

    /** Add force_ to the residual of the side @p s. */
    void
    add_residual(const ShellEdgeValues &edge,
                 const unsigned int     s,
                 LocalTerms            &terms) const;

    const SectionLaw                  &section_;
    const StrainMeasure                measure_;
    const bool                         limits_gap_;
    const bool                         is_stress_only_;
    SectionStates                     *states_;
    FiniteEdgePoint<double>            point_;
    std::array<NodeVectors<double>, 2> u_;
    NodeVectors<double>                force_;
    /** [end of the step]. */
    std::array<FiniteEdgePoint<double>, 2>            ends_point_;
    std::array<std::array<NodeVectors<double>, 2>, 2> ends_u_;
    FiniteEdgeStep                                    step_;
    /** @name Of sections that couple membrane and bending only */
    //@{
    std::array<TiedGreenStrain<double>, 2>                membrane_;
    std::array<std::array<TiedGreenStrain<double>, 2>, 2> ends_membrane_;
    std::array<TiedStrainTangent, 2>                      membrane_tangents_;
    /** M_q of a side by node and component. */
    std::vector<double> membrane_row_;
    //@}
    /** [3 q + k][a]: R_k, and [3 q + k][c n + 3 b + d]: sum_l K_kl R_l. */
    std::array<FullMatrix<double>, 2> side_rows_;
    std::array<FullMatrix<double>, 2> side_derivative_rows_;
    /**
     * [q][i]: dtheta, and what it multiplies in X; with coupling then [n_points
     * (1 + side) + q][i]: dlambda / lambda, and g lambda M_q.
     */
    FullMatrix<double> jump_rows_;
    FullMatrix<double> trial_rows_;
    FullMatrix<double> product_;
  };
} // namespace Nacre

#endif
