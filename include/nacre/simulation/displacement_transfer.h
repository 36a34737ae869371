// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_displacement_transfer_h
#define nacre_simulation_displacement_transfer_h

#include <nacre/discretization/discretization.h>

#include <deal.II/distributed/solution_transfer.h>

#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace Nacre
{
  /**
   * Carries displacements to the mesh that refinement makes of its own: the
   * same polynomials of the reference cells, on any ranks. New nodes of the
   * geometry lie on the exact surface, so that the deformed surface changes by
   * as much as the undeformed one does.
   *
   * The steps, each collective: the constructor; Discretization's triangulation
   * is released; refine(); another Discretization takes it; field_on().
   */
  class DisplacementTransfer
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Mesh   = parallel::TriangulationBase<dim, spacedim>;

    /**
     * @param fields ghosted, such as displacements (length)
     * @param marked cells to refine, by active cell index; those of this rank
     */
    DisplacementTransfer(const Discretization              &discretization,
                         const std::vector<const Vector *> &fields,
                         const std::vector<bool>           &marked);

    /** Refine the triangulation of the discretisation, now @p mesh. */
    void
    refine(Mesh &mesh);

    /** The field @p k, owned entries, hanging nodes included. */
    Vector
    field_on(const Discretization &discretization, const unsigned int k) const;

  private:
    using Transfer =
      parallel::distributed::SolutionTransfer<dim, Vector, spacedim>;

    /** A vector of dof_handler_ with all values of this rank's cells. */
    Vector
    ghosted_vector() const;

    const std::unique_ptr<FiniteElement<dim, spacedim>> fe_;
    DoFHandler<dim, spacedim>                           dof_handler_;
    const std::vector<bool>                             marked_;
    std::vector<Vector>                                 values_;
    std::unique_ptr<Transfer>                           transfer_;
  };
} // namespace Nacre

#endif
