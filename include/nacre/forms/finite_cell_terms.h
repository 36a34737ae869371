// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_cell_terms_h
#define nacre_forms_finite_cell_terms_h

#include <nacre/forms/finite_cell.h>
#include <nacre/forms/kinematics.h>

#include <optional>

namespace Nacre
{
  /**
   * Energy, force and tangent of a cell with exact finite rotations, in numbers
   * of the dofs: the chain from FiniteCell to the matrix.
   *
   * With the rows B_q[6][i] of E and kappa at a point, C_q[6][6] = [A B; B^T D]
   * the tangent of the section at these strains and GreenStrain's second
   * variations, the tangent is
   *
   *   K = sum_q B_q^T C_q B_q + sum_g (z_g q_g^T + q_g z_g^T)
   *       + sum_k N,a n^ab N,b 1
   *
   * where q_g = N,g t and z_g = m^ab (N,ab - Gamma^h_ab N,h) a^g +
   * 1/2 (m : b) a^gh q_h are rows for N e_c. All but the last sum, which is the
   * same for the three components, is X + X^T with X one dense product of eight
   * rows a point: symmetric by construction. TangentType::stress leaves out
   * the first sum, StrainMeasure::linear the others.
   */
  class FiniteCellTerms
  {
  public:
    /** @param states of the section; null: all are at rest */
    FiniteCellTerms(const Discretization &discretization,
                    const SectionLaw     &section,
                    const StrainMeasure   measure,
                    const MembraneStrain  membrane_strain,
                    const TangentType     tangent_type,
                    SectionStates        *states);

    const ShellCellValues &
    values() const
    {
      return full_points_.values;
    }

    /** Of initial strains. */
    void
    set_instant(const Instant &instant)
    {
      instant_ = instant;
    }

    /** Frames of @p cell, without any terms. */
    void
    reinit_frames(const CellPart &part)
    {
      full_points_.values.reinit_frames(part);
    }

    /** Add the terms at the displacement @p u; zero if empty. */
    void
    add(const CellPart &part, const Vector<double> &u, LocalTerms &terms);

    /** Kinematics::add_cell_step_terms(). */
    void
    add_step(const CellPart       &part,
             const Vector<double> &u_start,
             const Vector<double> &u_end,
             LocalTerms           &terms);

  private:
    /** The points of one rule. */
    struct CellPoints
    {
      CellPoints(const Discretization  &discretization,
                 const StrainMeasure    measure,
                 const Quadrature<dim> &quadrature,
                 const bool             tied,
                 const bool             bends);

      ShellCellValues            values;
      std::vector<SectionBlocks> sections;
      FiniteCell<double>         cell;
      /** At the ends of a step. */
      std::array<FiniteCell<double>, 2> ends;
      /** Whether the bending energy is integrated here. */
      const bool bends;
    };

    /** Set cell of both rules from u_, or of the step of ends_u_. */
    void
    evaluate(const CellPart &part,
             CellPoints     &points,
             const double    share,
             const bool      in_step);

    /** What both do at the points of both rules. */
    void
    add_terms(const CellPart &part, const bool in_step, LocalTerms &terms);

    void
    add_tangent(const CellPoints &points, LocalTerms &terms);

    /** The rows of E at all points, from those at the tying points. */
    void
    fill_membrane_rows(const CellPoints &points);

    /** Rows of kappa and q_g, and the z_g of the point @p q. */
    void
    fill_bending_rows(const CellPoints &points, const unsigned int q);

    /** The rows C B / 2 of the point @p q. */
    void
    fill_stress_rows(const CellPoints &points, const unsigned int q);

    /** terms.tangent += X + X^T, and the membrane forces' stiffness. */
    void
    add_products(const CellPoints &points, LocalTerms &terms);

    void
    add_membrane_force_stiffness(const CellPoints &points, LocalTerms &terms);

    const SectionLaw &section_;
    const bool        is_stress_only_;
    SectionStates    *states_;
    Instant           instant_;
    CellPoints        full_points_;
    /** p x p points, for reduced integration only. */
    std::optional<CellPoints> reduced_points_;

    NodeVectors<double>                u_;
    std::array<NodeVectors<double>, 2> ends_u_;
    NodeVectors<double>                force_;
    TiedStrainTangent                  membrane_tangent_;
    /** [8 q + row][i]: E, kappa, q_1, q_2, and what they multiply in X. */
    FullMatrix<double> test_rows_;
    FullMatrix<double> trial_rows_;
    FullMatrix<double> product_;
  };
} // namespace Nacre

#endif
