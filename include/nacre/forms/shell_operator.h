// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_shell_operator_h
#define nacre_forms_shell_operator_h

#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/load_terms.h>
#include <nacre/forms/mass_terms.h>
#include <nacre/forms/shell_actions.h>
#include <nacre/forms/step_start.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <optional>

namespace Nacre
{
  class BoundaryConditions;
  class Expression;
  class Loads;
  struct EdgeConditions;
  struct ShellModel;

  /**
   * The discrete shell: the one loop over cells, interior edges and boundary
   * edges that assembles the tangent, the residual and the energies of any
   * Kinematics and the virtual work of the loads. It holds no time: functions
   * that loads or prescribed rotations matter to take ShellActions, or take
   * both at t = 0 with the factor 1, as linear analyses do.
   */
  class ShellOperator
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /** Both must live as long. Throws as LoadTerms does; collective. */
    ShellOperator(const Discretization &discretization,
                  const ShellModel     &model);

    /**
     * The same of the parts of a model that it needs, for a mesh that is no
     * Midsurface's.
     * @param load_factor of prescribed displacements over the time, by which
     *   they turn edges; null: they don't
     */
    ShellOperator(const Discretization        &discretization,
                  const SectionLaw            &section,
                  const BoundaryConditions    &boundary_conditions,
                  const Loads                 &loads,
                  const KinematicsOptions     &kinematics_options,
                  const std::optional<double> &eta,
                  const Expression            *load_factor = nullptr);

    /** The loads and the prescribed rotations at @p instant; collective. */
    ShellActions
    actions(const Instant &instant) const
    {
      return {instant, prescribed_rotations(instant)};
    }

    const EdgePenalty &
    penalty() const
    {
      return penalty_;
    }

    /** Set up the pattern of @p matrix, neighbours of cells included. */
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
             const ShellActions              &actions,
             const AffineConstraints<double> &constraints,
             Matrix                          &matrix,
             Vector                          &right_hand_side,
             const Inertia                   *inertia = nullptr) const;

    Energies
    assemble(const Vector                    &u,
             const AffineConstraints<double> &constraints,
             Matrix                          &matrix,
             Vector                          &right_hand_side) const
    {
      return assemble(u,
                      actions(Instant()),
                      constraints,
                      matrix,
                      right_hand_side);
    }

    /**
     * The residual F(u) - f (force) at the ghosted displacement @p u, without
     * any constraint; its virtual work on a displacement of an edge is the
     * reaction. Returns the strain energy (force times length).
     */
    Energies
    residual(const Vector       &u,
             const ShellActions &actions,
             Vector             &result,
             const Inertia      *inertia = nullptr) const;

    Energies
    residual(const Vector &u, Vector &result) const
    {
      return residual(u, actions(Instant()), result);
    }

    /** Parts of the strain energy at the ghosted displacement @p u. */
    Energies
    energies(const Vector &u, const ShellActions &actions) const;

    Energies
    energies(const Vector &u) const
    {
      return energies(u, actions(Instant()));
    }

    /**
     * The nodes' forces (force) of all loads at the ghosted displacement @p u
     * and at @p instant; collective.
     * @param u_start ghosted start of a step of which u is the mean, or null
     */
    void
    loads(const Vector  &u,
          const Vector  *u_start,
          Vector        &result,
          const Instant &instant = Instant()) const;

    /**
     * The prescribed rotations of this rank's edges at @p instant. Throws where
     * an expression isn't finite, on all ranks; collective.
     */
    PrescribedRotations
    prescribed_rotations(const Instant &instant) const;

    /**
     * Work (force times length) of the supports that prescribe rotations, from
     * @p start to the ghosted @p u_end with the rotations @p end; collective.
     */
    double
    rotation_work(const StepStart           &start,
                  const Vector              &u_end,
                  const PrescribedRotations &end) const;

    /**
     * The virtual work of the rotation conditions of the edge @p id on a
     * rigid rotation about the three axes: the part of the reaction moment
     * that the nodes' forces don't carry (force times length). The rotation is
     * that of the undeformed surface in linear kinematics, else of the
     * deformed one.
     */
    Tensor<1, spacedim>
    rotation_reaction(const types::boundary_id   id,
                      const Vector              &u,
                      const PrescribedRotations &rotations) const;

    /**
     * Whether all neighbouring cells are oriented alike, which a pressure
     * needs; collective.
     */
    bool
    is_consistently_oriented() const;

    /** Where, and by how much, a deformed edge departs from its rotation. */
    struct RotationGap
    {
      /** Between the normals, 0 to pi (rad). */
      double angle = 0.;
      /** On the undeformed surface (length). */
      Point<spacedim> position;
    };

    /**
     * The largest angle between the normal of the deformed edge and that of its
     * prescribed rotation, one of @p rotations, at the ghosted displacement
     * @p u; collective, the same on all ranks.
     */
    RotationGap
    largest_rotation_gap(const Vector              &u,
                         const PrescribedRotations &rotations) const;

  private:
    struct ScratchData;
    struct FaceCopy;
    struct CopyData;

    using Copier = std::function<void(const CopyData &)>;
    using Cell   = DoFHandler<dim, spacedim>::active_cell_iterator;

    /** What forces depend on. */
    struct State
    {
      /** Ghosted displacement, null for zero. */
      const Vector       *u;
      const ShellActions &actions;
      /** Null: none. */
      const Inertia *inertia;

      /** Of a step with energy-momentum forces, or null. */
      const StepStart *
      start() const
      {
        return inertia != nullptr ? inertia->start : nullptr;
      }
    };

    /** assemble() at @p state; the energy of this rank's cells. */
    Energies
    assemble_at(const State                     &state,
                const AffineConstraints<double> &constraints,
                Matrix                          &matrix,
                Vector                          &right_hand_side) const;

    /** The loop. */
    void
    loop(const State  &state,
         const bool    wants_tangent,
         const Copier &copier) const;

    void
    cell_worker(const Cell  &cell,
                const State &state,
                ScratchData &scratch,
                CopyData    &copy) const;

    void
    boundary_worker(const Cell        &cell,
                    const unsigned int face,
                    const State       &state,
                    ScratchData       &scratch,
                    CopyData          &copy) const;

    /** Call @p work(cell, face, conditions) where a rotation is prescribed. */
    void
    for_each_rotation(
      const std::function<
        void(const Cell &, const unsigned int, const EdgeConditions &)> &work)
      const;

    const Discretization       &discretization_;
    const SectionLaw           &section_;
    const BoundaryConditions   &boundary_conditions_;
    const Loads                &loads_;
    LoadTerms                   load_terms_;
    EdgePenalty                 penalty_;
    std::unique_ptr<Kinematics> kinematics_;
    /** Whether to assemble the symmetric part of the tangent. */
    const bool symmetrizes_;
    /** Whether moments take the deformed positions. */
    const bool        has_deformed_levers_;
    const Expression *load_factor_;
  };
} // namespace Nacre

#endif
