// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_linear_kinematics_h
#define nacre_forms_linear_kinematics_h

#include <nacre/forms/hinge_form.h>
#include <nacre/forms/kinematics.h>

namespace Nacre
{
  /**
   * Small displacements: cell terms (32)-(33), edges in hinge form,
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
    add_cell_terms(const Triangulation<dim, spacedim>::cell_iterator &cell,
                   const Vector<double>                              &u,
                   LocalTerms &terms) override;

    const ShellCellValues &
    cell_values() const override
    {
      return full_values_;
    }

    void
    add_edge_terms(const ShellEdgeValues &edge,
                   const double           penalty,
                   const Vector<double>  &u,
                   LocalTerms            &terms) override;

    void
    add_rotation_terms(const ShellEdgeValues     &edge,
                       const double               penalty,
                       const std::vector<double> &rotation,
                       const Vector<double>      &u,
                       LocalTerms                &terms) override;

  protected:
    const Discretization &discretization_;
    const SectionLaw     &section_;
    const MembraneStrain  membrane_strain_;

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

    /** Stiffness times weights at the points of @p values. */
    void
    weigh(const ShellCellValues &values, const double factor);

    /** f of MembraneStrain::reduced on the cell of full_values_. */
    double
    full_integration_share() const;

    /**
     * Factors of the three terms at an edge point, quadrature weight included:
     * penalty [[theta(u)]] [[theta(v)]] + symmetry {m_nn(v)} [[theta(u)]] +
     * consistency [[theta(v)]] {m_nn(u)}.
     */
    struct Fluxes
    {
      double penalty;
      double symmetry;
      double consistency;
    };

    /** Those of the point @p q, to which hinge_ is set. */
    Fluxes
    fluxes(const ShellEdgeValues &edge,
           const unsigned int     q,
           const double           penalty) const;

    /** Rows whose product is the tangent of the point of hinge_. */
    void
    fill_edge_rows(const unsigned int q, const Fluxes &fluxes);

    void
    add_edge_residual(const Fluxes         &fluxes,
                      const double          rotation,
                      const Vector<double> &u,
                      LocalTerms           &terms) const;

    ShellCellValues full_values_;
    /** p x p points, for reduced integration only. */
    std::unique_ptr<ShellCellValues> reduced_values_;

    std::vector<VoigtMatrix<>> membrane_stiffness_;
    std::vector<VoigtMatrix<>> bending_stiffness_;
    FullMatrix<double>         stress_rows_;
    HingePoint                 hinge_;
    FullMatrix<double>         test_rows_;
    FullMatrix<double>         trial_rows_;
  };
} // namespace Nacre

#endif
