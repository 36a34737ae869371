// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_corotational_kinematics_h
#define nacre_forms_corotational_kinematics_h

#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/corotational_cell.h>
#include <nacre/forms/corotational_edge.h>
#include <nacre/forms/corotational_edge_step.h>
#include <nacre/forms/kinematics.h>

#include <optional>

namespace Nacre
{
  /**
   * Large rotations, small strains, (46)-(48): the linear forms act on
   * R^T x - X0, with the polar rotation R at every cell point and the edge
   * frame's rotation at every edge point,
   *
   * f = sum w R B^T D B (R^T x - X0).
   *
   * The frozen tangent (47) is R B^T D B R^T; the consistent tangent is the
   * exact derivative of f, dR/du of cells and edges included. Since f depends
   * on the nodes only through derivatives at points, f_a = sum_r N_r[a] g_r
   * with scalar rows N_r of shape functions (N,1 and N,2 at tying points, the
   * bending strain's at the others), its derivative is the dense product of the
   * rows N_r[a] and dg_r[c][j], which takes no more operations than the linear
   * B^T D B.
   */
  class CorotationalKinematics : public Kinematics
  {
  public:
    CorotationalKinematics(const Discretization &discretization,
                           const SectionLaw     &section,
                           const MembraneStrain  membrane_strain,
                           const TangentType     tangent_type);

    std::unique_ptr<Kinematics>
    clone() const override;

    void
    set_instant(const Instant &instant) override
    {
      instant_ = instant;
      for (CorotationalEdgePoint<double> *const point :
           {&edge_point_, &ends_edge_point_[0], &ends_edge_point_[1]})
        point->set_instant(instant);
    }

    void
    add_cell_terms(const CellPart       &part,
                   const Vector<double> &u,
                   LocalTerms           &terms) override;

    const ShellCellValues &
    cell_values() const override
    {
      return full_points_.values;
    }

    void
    reinit_cell_values(const CellPart &part) override
    {
      full_points_.values.reinit_frames(part);
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

    double
    rotation_gap(const ShellEdgeValues    &edge,
                 const unsigned int        q,
                 const PrescribedRotation &rotation,
                 const Vector<double>     &u) override;

    void
    add_moment_terms(const ShellEdgeValues     &edge,
                     const std::vector<double> &moment,
                     const Vector<double>      &u,
                     LocalTerms                &terms) override;

    /**
     * Forces B*^T s, StepDifferences. Their tangent is B*^T D B* and the
     * stiffness of the mean stresses s at the mean positions, which is
     * symmetric but for that stiffness; the derivative has B at the end of the
     * step in place of the second B*.
     */
    void
    add_cell_step_terms(const CellPart       &part,
                        const Vector<double> &u_start,
                        const Vector<double> &u_end,
                        LocalTerms           &terms) override;

    void
    add_edge_step_terms(const ShellEdgeValues &edge,
                        const double           penalty,
                        const Vector<double>  &u_start,
                        const Vector<double>  &u_end,
                        LocalTerms            &terms) override;

    void
    add_rotation_step_terms(
      const ShellEdgeValues                 &edge,
      const double                           penalty,
      const std::vector<PrescribedRotation> &rotation_start,
      const std::vector<PrescribedRotation> &rotation_end,
      const Vector<double>                  &u_start,
      const Vector<double>                  &u_end,
      LocalTerms                            &terms) override;

  private:
    /** The points of one rule and the rows of the tangent that they need. */
    struct CellPoints
    {
      CellPoints(const Discretization  &discretization,
                 const Quadrature<dim> &quadrature,
                 const bool             tied);

      /** Set the numbers of rows; they depend on the tying points. */
      void
      number_membrane_rows();

      ShellCellValues values;
      CellStiffness   stiffness;
      /** By initial strains; may be empty. */
      std::vector<InitialForces> held;
      /** M of CorotationalMembrane. */
      FullMatrix<double> membrane_stiffness;
      /**
       * [2 k + alpha]: row of N,alpha at the tying point k, counted from the
       * first membrane row, or invalid if no sample there needs it.
       */
      std::vector<unsigned int> membrane_rows;
      unsigned int              n_membrane_rows = 0;
    };

    /** The terms at u_; if in_step_, of the step of which u_ is the mean. */
    /** Of full_points_, of which the rest of add_cell() is. */
    void
    reinit_frames(const CellPart &part);

    void
    add_cell(const CellPart &part, LocalTerms &terms);

    /** Strains and stresses of membrane and bending, unless in_step_. */
    void
    evaluate_strains(CellPoints &points);

    /**
     * Energies of initial strains beside half the work of the stresses on the
     * strains, 1/2 e . M . (e - 2 e0) + 1/2 e0 . M . e0.
     */
    void
    add_initial_energies(const CellPoints &points, Energies &energies) const;

    /** Residual and energy of the membrane strain, and rows of the tangent. */
    void
    add_membrane_terms(CellPoints        &points,
                       const unsigned int first_row,
                       LocalTerms        &terms);

    void
    add_bending_terms(CellPoints        &points,
                      const unsigned int first_row,
                      LocalTerms        &terms);

    /** membrane_ and force_ of a step, and both vectors of the samples. */
    void
    add_membrane_step_force(const CellPoints &points);

    /** bending_ and force_ of a step. */
    void
    add_bending_step_force(const CellPoints &points);

    /**
     * Set force_vectors_ and strain_vectors_: those of which v,1 and v,2 make
     * the virtual strain of a sample and the strain's derivative.
     */
    void
    set_sample_vectors(const CellPoints &points);

    /** Set sample_rows_: derivative of each sample's strain. */
    void
    fill_sample_rows(const CellPoints &points);

    void
    fill_membrane_rows(const CellPoints &points, const unsigned int first_row);

    void
    fill_bending_rows(const CellPoints &points, const unsigned int first_row);

    /**
     * Set eps_rows_ and rho_rows_, the derivatives of the strains at the
     * points, for sections that couple them.
     */
    void
    fill_strain_rows(const CellPoints &points);

    /** Add the derivatives of B rho to those of the samples' forces. */
    void
    add_coupling_to_force_rows(const CellPoints &points);

    /** Add the derivatives of B^T eps to those of the moments. */
    void
    add_coupling_to_bending_rows(const CellPoints  &points,
                                 const unsigned int first_row);

    /** terms.tangent += product of the rows, in the cell's order of dofs. */
    void
    add_cell_tangent(LocalTerms &terms);

    /** @name The membrane strain in m_nn, for sections with coupling */
    //@{
    /** Set edge_membrane_, in a step those of its ends, too. */
    void
    evaluate_edge_membrane(const ShellEdgeValues &edge);

    /** The vectors of a sample's difference in a step, StepDifferences. */
    std::array<Tensor<1, spacedim>, 2>
    edge_step_vectors(const ShellEdgeValues       &edge,
                      const unsigned int           side,
                      const MembraneTying::Sample &sample) const;

    /** Set membrane_force_row_ and membrane_moment_row_ of a side. */
    void
    fill_edge_membrane_rows(const ShellEdgeValues &edge,
                            const unsigned int     side,
                            const unsigned int     q,
                            const Voigt<>         &B_nu);

    /** Add the row's force; @p moment_force is conjugate to m_nn. */
    void
    add_edge_membrane_force(const ShellEdgeValues &edge,
                            const unsigned int     side,
                            const double           moment_force,
                            LocalTerms            &terms) const;

    /** Add the derivatives of its part of m_nn to mean_row_. */
    void
    add_membrane_to_mean_row(const ShellEdgeValues &edge);

    /** The tangent of the point of edge_point_, but for how the row turns. */
    void
    add_edge_membrane_tangent(const ShellEdgeValues &edge,
                              const unsigned int     side,
                              const unsigned int     q,
                              LocalTerms            &terms);

    /** How the forces of all points turn. */
    void
    add_edge_turn_tangent(const ShellEdgeValues &edge,
                          const unsigned int     side,
                          LocalTerms            &terms);
    //@}

    /** Set omega_, jump_row_, mean_row_ of the point of edge_point_. */
    void
    fill_edge_derivatives(const ShellEdgeValues &edge, const unsigned int q);

    /** Residual of the point of ends_edge_point_ and edge_step_. */
    void
    add_edge_step_forces(const ShellEdgeValues &edge,
                         const unsigned int     q,
                         LocalTerms            &terms);

    /** Rows of the tangent of the point of edge_point_, on all sides. */
    void
    add_edge_point_rows(const ShellEdgeValues &edge,
                        const unsigned int     q,
                        LocalTerms            &terms);

    /** The two rows of the side @p s at the point @p q. */
    void
    fill_edge_rows(const unsigned int s, const unsigned int q);

    /** Room for the rows of an edge's tangent. */
    void
    reinit_edge_rows(const ShellEdgeValues &edge);

    /** Add force_ to the residual of the side @p s. */
    void
    add_edge_residual(const ShellEdgeValues &edge,
                      const unsigned int     s,
                      LocalTerms            &terms) const;

    void
    add_edge_tangent(const ShellEdgeValues &edge,
                     const unsigned int     side,
                     LocalTerms            &terms);

    /** Whether the tangent contains the rotations' derivatives. */
    bool
    is_consistent() const
    {
      return tangent_type_ != TangentType::frozen;
    }

    const Discretization &discretization_;
    const SectionLaw     &section_;
    const MembraneStrain  membrane_strain_;
    const TangentType     tangent_type_;
    Instant               instant_;
    CellPoints            full_points_;
    /** p x p points, for reduced integration only. */
    std::optional<CellPoints> reduced_points_;

    CorotationalMembrane<double>                    membrane_;
    CorotationalBending<double>                     bending_;
    NodeVectors<double>                             u_;
    NodeVectors<double>                             force_;
    std::vector<std::array<Tensor<1, spacedim>, 2>> force_vectors_;
    std::vector<std::array<Tensor<1, spacedim>, 2>> strain_vectors_;

    /** @name Ends of a step */
    //@{
    bool                                        in_step_ = false;
    std::array<NodeVectors<double>, 2>          ends_u_;
    std::array<CorotationalMembrane<double>, 2> ends_membrane_;
    std::array<CorotationalBending<double>, 2>  ends_bending_;
    //@}
    /** [sample][3 b + d]: derivatives of the strains and of their forces. */
    FullMatrix<double> sample_rows_;
    FullMatrix<double> force_rows_;
    /** [3 q + v][3 b + d], for coupled sections only. */
    FullMatrix<double> eps_rows_;
    FullMatrix<double> rho_rows_;
    /** Shape functions N_r [r][a], and dg_r [r][c n_dofs + j]. */
    FullMatrix<double> shape_rows_;
    FullMatrix<double> derivative_rows_;
    /** Their product, [a][c n_dofs + j]. */
    FullMatrix<double> product_;

    /**
     * The part of m_nn that sections with coupling take from the membrane
     * strain, on each side: the strains, and at the current point the force of
     * a unit of m_nn and the derivative of m_nn, [3 a + c].
     */
    std::array<CorotationalMembrane<double>, 2> edge_membrane_;
    /** [end of the step][side]. */
    std::array<std::array<CorotationalMembrane<double>, 2>, 2>
                                       ends_edge_membrane_;
    std::array<std::vector<double>, 2> membrane_force_row_;
    std::array<std::vector<double>, 2> membrane_moment_row_;

    CorotationalEdgePoint<double>      edge_point_;
    std::array<NodeVectors<double>, 2> edge_u_;
    /** [end of the step]. */
    std::array<CorotationalEdgePoint<double>, 2>      ends_edge_point_;
    std::array<std::array<NodeVectors<double>, 2>, 2> ends_edge_u_;
    CorotationalEdgeStep                              edge_step_;
    /** Derivatives [c n_dofs + j] of the edge's rotation vector. */
    std::vector<double> omega_;
    /** Derivatives of [[theta]] and {m_nn}. */
    std::vector<double>               jump_row_;
    std::vector<double>               mean_row_;
    std::array<FullMatrix<double>, 2> edge_shape_rows_;
    std::array<FullMatrix<double>, 2> edge_derivative_rows_;
  };
} // namespace Nacre

#endif
