// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_linear_kinematics_h
#define nacre_forms_linear_kinematics_h

#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/rotation_jump.h>

#include <optional>

namespace Nacre
{
  /**
   * Small displacements: cell terms (32)-(33) and, for sections that couple
   * membrane and bending, int eps(v):B:rho(u) + rho(v):B^T:eps(u) dA; edges in
   * rotation-jump form,
   *
   * a^e(u,v) = int eta^e D [[theta(u)]] [[theta(v)]]       penalty
   *              - {m_nn(v)} [[theta(u)]]                  symmetry
   *              - [[theta(v)]] {m_nn(u)} ds               consistency
   */
  class LinearKinematics : public Kinematics
  {
  public:
    LinearKinematics(const Discretization &discretization,
                     const SectionLaw     &section,
                     const MembraneStrain  membrane_strain);

    std::unique_ptr<Kinematics>
    clone() const override;

    void
    set_instant(const Instant &instant) override
    {
      instant_ = instant;
    }

    void
    add_cell_terms(const CellPart       &part,
                   const Vector<double> &u,
                   LocalTerms           &terms) override;

    const ShellCellValues &
    cell_values() const override
    {
      return full_values_;
    }

    void
    reinit_cell_values(const CellPart &part) override
    {
      full_values_.reinit_frames(part);
    }

    void
    add_edge_terms(const ShellEdgeValues &edge,
                   const double           penalty,
                   const Vector<double>  &u,
                   LocalTerms            &terms) override;

    void
    add_rotation_terms(const ShellEdgeValues                 &edge,
                       const double                           penalty,
                       const std::vector<PrescribedRotation> &rotation,
                       const Vector<double>                  &u,
                       LocalTerms                            &terms) override;

    void
    add_moment_terms(const ShellEdgeValues     &edge,
                     const std::vector<double> &moment,
                     const Vector<double>      &u,
                     LocalTerms                &terms) override;

  protected:
    const Discretization &discretization_;
    const SectionLaw     &section_;
    const MembraneStrain  membrane_strain_;
    Instant               instant_;

  private:
    /**
     * int strain(v) : stiffness : strain(u), stiffness including the
     * quadrature weights, one matrix a point.
     */
    double
    add_strain_terms(const FullMatrix<double>         &rows,
                     const std::vector<VoigtMatrix<>> &stiffness,
                     const Vector<double>             &u,
                     LocalTerms                       &terms);

    /**
     * int eps(v):B:rho(u) + rho(v):B^T:eps(u) dA with stiffness_, if it is
     * coupled; a half of its energy counts as membrane, the other as bending
     * energy, (n:eps)/2 and (m:rho)/2.
     */
    void
    add_coupling_terms(const ShellCellValues &values,
                       const Vector<double>  &u,
                       LocalTerms            &terms);

    /**
     * -int n0 : eps(v) + m0 : rho(v) dA of the section's initial strains.
     * @param shares of these points in both energies
     */
    void
    add_initial_terms(const ShellCellValues       &values,
                      const std::array<double, 2> &shares,
                      const Vector<double>        &u,
                      LocalTerms                  &terms) const;

    /** Rows whose product is the tangent of the point of jump_. */
    void
    fill_edge_rows(const unsigned int q, const EdgeFluxes &fluxes);

    void
    add_edge_residual(const EdgeFluxes     &fluxes,
                      const double          rotation,
                      const double          initial_moment,
                      const Vector<double> &u,
                      LocalTerms           &terms) const;

    ShellCellValues full_values_;
    /** p x p points, for reduced integration only. */
    std::optional<ShellCellValues> reduced_values_;

    CellStiffness      stiffness_;
    FullMatrix<double> stress_rows_;
    RotationJump       jump_;
    FullMatrix<double> test_rows_;
    FullMatrix<double> trial_rows_;
  };
} // namespace Nacre

#endif
