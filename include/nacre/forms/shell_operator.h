// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_shell_operator_h
#define nacre_forms_shell_operator_h

#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/mass_terms.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <optional>

namespace Nacre
{
  class BoundaryConditions;
  class Loads;

  /**
   * The discrete shell: the one loop over cells, interior edges and boundary
   * edges that assembles the tangent, the residual and the energies of any
   * Kinematics and the virtual work of the loads.
   */
  class ShellOperator
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /**
     * Throws if a point force lies off the mesh or on both lips of a slit;
     * collective.
     */
    ShellOperator(const Discretization        &discretization,
                  const SectionLaw            &section,
                  const BoundaryConditions    &boundary_conditions,
                  const Loads                 &loads,
                  const KinematicsOptions     &kinematics_options,
                  const std::optional<double> &eta);

    const EdgePenalty &
    penalty() const
    {
      return penalty_;
    }

    /** Set up the sparsity pattern of @p matrix, neighbours of cells included. */
    void
    reinit_matrix(const AffineConstraints<double> &constraints,
                  Matrix                          &matrix) const;

    /**
     * The linear system K u = f with the constraints eliminated symmetrically.
     */
    void
    assemble_system(const AffineConstraints<double> &constraints,
                    Matrix                          &matrix,
                    Vector                          &right_hand_side) const;

    /**
     * The linearised system K(u) du = f - F(u) at the ghosted displacement
     * @p u: the tangent and the negative residual, with the constraints
     * eliminated. If u fulfils the prescribed displacements, the constraints
     * of du are homogeneous. Returns the strain energy (force times length).
     * @param inertia inertial forces of a time integrator, if any
     */
    Energies
    assemble(const Vector                    &u,
             const AffineConstraints<double> &constraints,
             Matrix                          &matrix,
             Vector                          &right_hand_side,
             const Inertia                   *inertia = nullptr) const;

    /**
     * The residual F(u) - f (force) at the ghosted displacement @p u, without
     * any constraint; its virtual work on a displacement of an edge is the
     * reaction. Returns the strain energy (force times length).
     */
    Energies
    residual(const Vector  &u,
             Vector        &result,
             const Inertia *inertia = nullptr) const;

    /** Parts of the strain energy at the ghosted displacement @p u. */
    Energies
    energies(const Vector &u) const;

    /** The nodes' forces of all loads at the ghosted displacement @p u. */
    void
    loads(const Vector &u, Vector &result) const;

    /**
     * The virtual work of the rotation conditions of the edge @p id on a
     * rigid rotation about the three axes: the part of the reaction moment
     * that the nodes' forces don't carry (force times length). The rotation is
     * that of the undeformed surface in linear kinematics, else of the
     * deformed one.
     */
    Tensor<1, spacedim>
    rotation_reaction(const types::boundary_id id, const Vector &u) const;

    /**
     * Whether all neighbouring cells are oriented alike, which a pressure
     * needs; collective.
     */
    bool
    is_consistently_oriented() const;

  private:
    struct ScratchData;
    struct FaceCopy;
    struct CopyData;

    using Copier = std::function<void(const CopyData &)>;

    /** assemble() at @p u, null for zero; the energy of this rank's cells. */
    Energies
    assemble_at(const Vector                    *u,
                const Inertia                   *inertia,
                const AffineConstraints<double> &constraints,
                Matrix                          &matrix,
                Vector                          &right_hand_side) const;

    /** The loop. @param u ghosted displacement, or null for zero. */
    void
    loop(const Vector  *u,
         const Inertia *inertia,
         const bool     wants_tangent,
         const Copier  &copier) const;

    void
    cell_worker(const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
                const Vector                                          *u,
                const Inertia                                         *inertia,
                ScratchData                                           &scratch,
                CopyData &copy) const;

    void
    boundary_worker(const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
                    const unsigned int                                     face,
                    const Vector                                          *u,
                    ScratchData &scratch,
                    CopyData    &copy) const;

    void
    subtract_surface_loads(const ShellCellValues  &values,
                           dealii::Vector<double> &residual) const;

    /**
     * Pressure along the deformed normal on the deformed area: the force per
     * reference area is p phi,1 x phi,2; with its derivative.
     */
    void
    subtract_following_pressure(const ShellCellValues        &values,
                                const dealii::Vector<double> &u,
                                LocalTerms                   &terms) const;

    void
    add_edge_loads(const types::boundary_id      id,
                   const ShellEdgeValues        &edge,
                   const dealii::Vector<double> &u,
                   Kinematics                   &kinematics,
                   LocalTerms                   &terms) const;

    /** Add the virtual work of point forces times @p factor. */
    void
    add_point_forces(const AffineConstraints<double> &constraints,
                     const double                     factor,
                     Vector                          &vector) const;

    void
    locate_point_forces();

    const Discretization       &discretization_;
    const SectionLaw           &section_;
    const BoundaryConditions   &boundary_conditions_;
    const Loads                &loads_;
    EdgePenalty                 penalty_;
    std::unique_ptr<Kinematics> kinematics_;
    /** Whether to assemble the symmetric part of the tangent. */
    const bool symmetrizes_;
    /** Whether moments take the deformed positions. */
    const bool                has_deformed_levers_;
    std::vector<SurfacePoint> force_points_;
  };
} // namespace Nacre

#endif
