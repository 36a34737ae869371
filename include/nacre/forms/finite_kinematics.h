// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_kinematics_h
#define nacre_forms_finite_kinematics_h

#include <nacre/forms/finite_cell_terms.h>
#include <nacre/forms/finite_edge_terms.h>

namespace Nacre
{
  /**
   * Exact finite rotations: one energy of Green strains, changes of curvature
   * and of the angles at edges, with its exact gradient and symmetric Hessian;
   * doc/formulation.md (N.21). Strains and rotations of any size.
   *
   * With StrainMeasure::linear the same chain has the strains and the jumps of
   * small displacements, for laws that aren't linear: the energy of
   * LinearKinematics with w in place of 1/2 eps : n + 1/2 rho : m. It knows no
   * energy-momentum steps, which are for linear laws.
   */
  class FiniteKinematics : public Kinematics
  {
  public:
    /**
     * @param measure of the strains and the angles
     * @param tangent_type consistent: the exact Hessian; symmetric: the same
     *   but for edges far from their prescribed rotation, which Newton's method
     *   then reaches from further away (FiniteEdgePoint::hessian()); stress:
     *   the part of the Hessian that is linear in the forces and moments
     * @param states of the section; null: all are at rest. The Hessian leaves
     *   out the change of the section's tangent at edges (FiniteEdgePoint).
     */
    FiniteKinematics(const Discretization &discretization,
                     const SectionLaw     &section,
                     const StrainMeasure   measure,
                     const MembraneStrain  membrane_strain,
                     const TangentType     tangent_type,
                     SectionStates *const  states = nullptr)
      : cell_terms_(discretization,
                    section,
                    measure,
                    membrane_strain,
                    tangent_type,
                    states)
      , edge_terms_(section, measure, tangent_type, states)
    {}

    std::unique_ptr<Kinematics>
    clone() const override
    {
      return std::make_unique<FiniteKinematics>(*this);
    }

    void
    set_instant(const Instant &instant) override
    {
      cell_terms_.set_instant(instant);
      edge_terms_.set_instant(instant);
    }

    void
    add_cell_terms(const CellPart       &part,
                   const Vector<double> &u,
                   LocalTerms           &terms) override
    {
      cell_terms_.add(part, u, terms);
    }

    const ShellCellValues &
    cell_values() const override
    {
      return cell_terms_.values();
    }

    void
    reinit_cell_values(const CellPart &part) override
    {
      cell_terms_.reinit_frames(part);
    }

    void
    add_edge_terms(const ShellEdgeValues &edge,
                   const double           penalty,
                   const Vector<double>  &u,
                   LocalTerms            &terms) override
    {
      const std::vector<PrescribedRotation> none(edge.n_points());
      edge_terms_.add(edge, penalty, none, u, terms);
    }

    void
    add_rotation_terms(const ShellEdgeValues                 &edge,
                       const double                           penalty,
                       const std::vector<PrescribedRotation> &rotation,
                       const Vector<double>                  &u,
                       LocalTerms                            &terms) override
    {
      edge_terms_.add(edge, penalty, rotation, u, terms);
    }

    double
    rotation_gap(const ShellEdgeValues    &edge,
                 const unsigned int        q,
                 const PrescribedRotation &rotation,
                 const Vector<double>     &u) override
    {
      return edge_terms_.rotation_gap(edge, q, rotation, u);
    }

    void
    add_moment_terms(const ShellEdgeValues     &edge,
                     const std::vector<double> &moment,
                     const Vector<double>      &u,
                     LocalTerms                &terms) override
    {
      edge_terms_.add_moment(edge, moment, u, terms);
    }

    void
    add_cell_step_terms(const CellPart       &part,
                        const Vector<double> &u_start,
                        const Vector<double> &u_end,
                        LocalTerms           &terms) override
    {
      cell_terms_.add_step(part, u_start, u_end, terms);
    }

    void
    add_edge_step_terms(const ShellEdgeValues &edge,
                        const double           penalty,
                        const Vector<double>  &u_start,
                        const Vector<double>  &u_end,
                        LocalTerms            &terms) override
    {
      const std::vector<PrescribedRotation> none(edge.n_points());
      add_rotation_step_terms(edge, penalty, none, none, u_start, u_end, terms);
    }

    void
    add_rotation_step_terms(
      const ShellEdgeValues                 &edge,
      const double                           penalty,
      const std::vector<PrescribedRotation> &rotation_start,
      const std::vector<PrescribedRotation> &rotation_end,
      const Vector<double>                  &u_start,
      const Vector<double>                  &u_end,
      LocalTerms                            &terms) override
    {
      edge_terms_.add_step(edge,
                           penalty,
                           {{&rotation_start, &rotation_end}},
                           {{&u_start, &u_end}},
                           terms);
    }

  private:
    FiniteCellTerms cell_terms_;
    FiniteEdgeTerms edge_terms_;
  };
} // namespace Nacre

#endif
