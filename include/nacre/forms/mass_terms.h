// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_mass_terms_h
#define nacre_forms_mass_terms_h

#include <nacre/forms/term.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <map>
#include <vector>

namespace Nacre
{
  /**
   * The consistent mass of the shell, the same for all three components:
   * M_ab = int rho h N^a N^b dA over the undeformed cells (mass), with the full
   * rule, so that it is regular whatever rule the strains use. The rotational
   * inertia rho h^3/12 is left out, as Kirchhoff-Love theory of thin shells
   * does.
   */
  class MassTerms
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /** Throws where the density is not positive; collective. */
    MassTerms(const Discretization &discretization, const SectionLaw &section);

    /** A mass of 1 per area. */
    explicit MassTerms(const Discretization &discretization);

    /**
     * Add M w of the ghosted vector @p w on a cell with the dofs @p dofs to
     * @p residual and, if it isn't null, @p factor M to @p tangent.
     */
    void
    add_on_cell(const CellPart                             &part,
                const std::vector<types::global_dof_index> &dofs,
                const Vector                               &w,
                const double                                factor,
                dealii::Vector<double>                     &residual,
                FullMatrix<double>                         *tangent) const;

    /** M v of a ghosted vector, without constraints. */
    void
    vmult(Vector &result, const Vector &v) const;

    /**
     * M a = b with the constraints eliminated; @p b without constraints, as a
     * residual is.
     */
    void
    assemble_system(const AffineConstraints<double> &constraints,
                    const Vector                    &ghosted_b,
                    TrilinosWrappers::SparseMatrix  &matrix,
                    Vector                          &right_hand_side) const;

    /** Mass of the whole shell. */
    double
    total() const
    {
      return total_;
    }

    /** Sum of the diagonal of M, all three components (mass). */
    double
    trace() const;

  private:
    /** @param area_density mass per area at a point */
    void
    make_matrices(
      const std::function<double(const SectionPoint &)> &area_density);

    const Discretization           &discretization_;
    std::vector<FullMatrix<double>> cell_matrices_; // by part
    /** Of parts that have functions of tips: [k][i], i any dof of the part. */
    std::map<unsigned int, FullMatrix<double>> tip_rows_;
    double                                     total_ = 0.;
  };

  struct StepStart;

  /**
   * Inertial forces that a time integrator adds to the residual: M w, with the
   * derivative of w with respect to the displacement at which the internal
   * forces are taken.
   */
  class Inertia : public Term
  {
  public:
    /**
     * @param w ghosted: acceleration plus mass damping times velocity
     * @param factor dw/du (1/time^2)
     * @param start if given, the displacement is the mean of a step that begins
     *   there, and the internal forces are the energy-momentum ones of the step
     */
    Inertia(const MassTerms                     &mass,
            const TrilinosWrappers::MPI::Vector &w,
            const double                         factor,
            const StepStart                     *start = nullptr);

    void
    add_on_cell(TermCell &cell, LocalTerms &terms) const override;

    const StepStart *start;

  private:
    const MassTerms                     &mass_;
    const TrilinosWrappers::MPI::Vector &w_;
    const double                         factor_;
  };
} // namespace Nacre

#endif
