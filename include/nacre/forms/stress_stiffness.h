// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_stress_stiffness_h
#define nacre_forms_stress_stiffness_h

#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/problem/kinematics_options.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>

namespace Nacre
{
  /**
   * The geometric stiffness of membrane forces n^ab (covariant basis,
   * force/length^3) on the undeformed surface,
   *
   *   G(u, v) = int n^ab u,a . v,b dA,
   *
   * with all three components of the displacements: the second variation
   * 1/2 (u,a . v,b + u,b . v,a) of the Green strain times its work conjugate.
   * Where membrane strains are tied, so is that variation. Positive forces are
   * tension, which stiffens.
   */
  class StressStiffness
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;
    /** n^ab at the point q of the cell that the values are of, Voigt. */
    using Forces =
      std::function<Voigt<>(const ShellCellValues &, const unsigned int q)>;

    StressStiffness(const Discretization &discretization,
                    const SectionLaw     &section,
                    const MembraneStrain  membrane_strain);

    /**
     * Add G of the given @p forces, with the constraints eliminated, to the
     * @p matrix, which has to be compressed afterwards. A force that throws
     * must do so on all ranks' cells or none; collective.
     */
    void
    add(const Forces                    &forces,
        const AffineConstraints<double> &constraints,
        Matrix                          &matrix) const;

    /**
     * The same of the forces A eps(u) + B rho(u) of the ghosted @p u, less
     * those of the section's initial strains at @p instant.
     */
    void
    add(const Vector                    &u,
        const AffineConstraints<double> &constraints,
        Matrix                          &matrix,
        const Instant                   &instant = {0., 0.}) const;

  private:
    using Cell = DoFHandler<dim, spacedim>::active_cell_iterator;
    /** Forces at the point q; @p dofs are the cell's. */
    using CellForces =
      std::function<Voigt<>(const ShellCellValues                      &values,
                            const unsigned int                          q,
                            const std::vector<types::global_dof_index> &dofs)>;

    void
    loop(const CellForces                &forces,
         const AffineConstraints<double> &constraints,
         Matrix                          &matrix) const;

    const Discretization &discretization_;
    const SectionLaw     &section_;
    const MembraneStrain  membrane_strain_;
  };
} // namespace Nacre

#endif
