// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_reference_assembly_h
#define nacre_forms_reference_assembly_h

#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/shell_terms.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace Nacre
{
  /**
   * The linear form as a textbook writes it, with nothing but deal.II's own
   * tools: FEValues on the cells, FEInterfaceValues on the edges, a loop by
   * MeshWorker::mesh_loop(), AffineConstraints for the constraints. Slower than
   * Assembly several times over, and its measure: both give the same
   * system.
   *
   * For test functions v and trial functions u (formulation.md):
   *
   *   a(u,v) = sum_K int eps(v):H_n:eps(u) + rho(v):H_m:rho(u) dA
   *          + sum_e int eta^e D [[theta(u)]] [[theta(v)]]
   *                      - {m_nn(v)} [[theta(u)]] - [[theta(v)]] {m_nn(u)} ds
   *          + sum_b int 2 eta^e D theta(u) theta(v)
   *                      + m_nn(v) theta(u) + theta(v) m_nn(u) ds
   *   l(v)   = sum_K int f . v dA + loads on edges and at points
   *          + sum_b int (2 eta^e D theta(v) + m_nn(v)) theta_bar ds
   *
   * e are the edges between cells, b those with a prescribed rotation
   * theta_bar.
   */
  class ReferenceAssembly
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /**
     * The discretisation, the penalty and what @p parts refer to must live as
     * long.
     * @param penalty eta^e of the edges
     */
    ReferenceAssembly(const Discretization &discretization,
                      const ShellParts     &parts,
                      const EdgePenalty    &penalty);

    /** Set up the sparsity pattern of @p matrix. */
    void
    reinit_matrix(const AffineConstraints<double> &constraints,
                  Matrix                          &matrix) const;

    /**
     * The linear system K u = f with the constraints eliminated; collective.
     */
    void
    assemble_system(const AffineConstraints<double> &constraints,
                    Matrix                          &matrix,
                    Vector                          &right_hand_side) const;

  private:
    struct ScratchData;
    struct CopyData;
    using Iterator = DoFHandler<dim, spacedim>::active_cell_iterator;

    void
    assemble_cell(const Iterator &cell,
                  ScratchData    &scratch,
                  CopyData       &copy) const;

    void
    assemble_edge(const Iterator    &cell,
                  const unsigned int face,
                  const unsigned int subface,
                  const Iterator    &neighbor,
                  const unsigned int neighbor_face,
                  const unsigned int neighbor_subface,
                  ScratchData       &scratch,
                  CopyData          &copy) const;

    void
    assemble_boundary(const Iterator    &cell,
                      const unsigned int face,
                      ScratchData       &scratch,
                      CopyData          &copy) const;

    void
    add_point_forces(const AffineConstraints<double> &constraints,
                     Vector                          &right_hand_side) const;

    const Discretization &discretization_;
    const ShellParts      parts_;
    const EdgePenalty    &penalty_;
  };
} // namespace Nacre

#endif
