// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_rotation_conditions_h
#define nacre_forms_rotation_conditions_h

#include <nacre/forms/edge_penalty.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/step_start.h>

#include <functional>

namespace Nacre
{
  class BoundaryConditions;
  class Expression;
  struct EdgeConditions;

  /**
   * The boundary edges whose rotation is prescribed: the rotations at an
   * instant, and what is asked of those edges outside of an assembly.
   * PrescribedRotationTerm has their virtual work.
   */
  class RotationConditions
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;

    /**
     * All must live as long.
     * @param load_factor of prescribed displacements over the time, by which
     *   they turn edges; null: they don't
     */
    RotationConditions(const Discretization     &discretization,
                       const BoundaryConditions &conditions,
                       const Expression         *load_factor,
                       const EdgePenalty        &penalty,
                       const Kinematics         &kinematics);

    /**
     * The rotations of this rank's edges at @p instant. Throws where an
     * expression isn't finite, on all ranks; collective.
     */
    PrescribedRotations
    evaluate(const Instant &instant) const;

    /**
     * Work (force times length) of the supports that prescribe rotations, from
     * @p start to the ghosted @p u_end with the rotations of @p end, and the
     * initial strains at its loads' instant in the whole step; collective.
     */
    double
    work(const StepStart    &start,
         const Vector       &u_end,
         const ShellActions &end) const;

    /**
     * The virtual work of the rotation conditions of the edge @p id on a
     * rigid rotation about the three axes: the part of the reaction moment
     * that the nodes' forces don't carry (force times length).
     * @param has_deformed_levers whether the rotation is that of the deformed
     *   surface, else of the undeformed one, as in linear kinematics
     */
    Tensor<1, spacedim>
    reaction(const types::boundary_id id,
             const Vector            &u,
             const ShellActions      &actions,
             const bool               has_deformed_levers) const;

    /** Where, and by how much, a deformed edge departs from its rotation. */
    struct Gap
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
    Gap
    largest_gap(const Vector &u, const PrescribedRotations &rotations) const;

  private:
    /** An edge whose rotation is prescribed, and its values. */
    struct Edge
    {
      const EdgePiece       &piece;
      const EdgeConditions  &conditions;
      const ShellEdgeValues &values;

      /** The key of PrescribedRotations. */
      std::pair<unsigned int, unsigned int>
      place() const
      {
        return piece.place();
      }

      const CellPart &
      part() const
      {
        return piece.sides[0].part;
      }

      /** Values of @p u at the edge's dofs. */
      dealii::Vector<double>
      extract(const Vector &u) const;
    };

    /** Call @p work for the edges of this rank's parts. */
    void
    for_each(const std::function<void(const Edge &)> &work) const;

    const Discretization     &discretization_;
    const BoundaryConditions &conditions_;
    const Expression         *load_factor_;
    const EdgePenalty        &penalty_;
    const Kinematics         &kinematics_;
  };
} // namespace Nacre

#endif
