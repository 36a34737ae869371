// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_assembly_h
#define nacre_forms_assembly_h

#include <nacre/forms/mass_terms.h>
#include <nacre/forms/rotation_conditions.h>
#include <nacre/forms/section_states.h>
#include <nacre/forms/shell_terms.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace Nacre
{
  /**
   * The discrete shell: a sum of terms, and the one loop over cells, interior
   * edges and boundary edges that assembles their tangent, residual and
   * energies. It holds no time: functions that loads or prescribed rotations
   * matter to take ShellActions, or take both at t = 0 with the factor 1, as
   * linear analyses do. Of a section with memory it has the states at the start
   * of a step, which whoever accepts the step replaces by those at its end.
   */
  class Assembly
  {
  public:
    using Vector = TrilinosWrappers::MPI::Vector;
    using Matrix = TrilinosWrappers::SparseMatrix;

    /**
     * The discretisation and what @p parts refer to must live as long. Throws
     * as make_terms() does; collective.
     */
    Assembly(const Discretization &discretization,
             const ShellParts     &parts,
             const TermSelection   selection = TermSelection::all);

    /** The loads and the prescribed rotations at @p instant; collective. */
    ShellActions
    actions(const Instant &instant) const
    {
      return {instant, rotation_conditions_.evaluate(instant)};
    }

    const EdgePenalty &
    penalty() const
    {
      return penalty_;
    }

    const RotationConditions &
    rotation_conditions() const
    {
      return rotation_conditions_;
    }

    /** Of the section: of all points, at the start of a step. */
    SectionStates &
    section_states() const
    {
      return *section_states_;
    }

    /**
     * Make those the states at the end of a step at the ghosted displacement
     * @p u; collective. Nothing is done for sections without memory.
     */
    void
    update_section_states(const Vector &u, const ShellActions &actions) const;

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
     * @param start of a step of which u is the mean, or null
     */
    void
    loads(const Vector    &u,
          Vector          &result,
          const Instant   &instant = Instant(),
          const StepStart *start   = nullptr) const;

  private:
    class Worker;
    struct FaceCopy;
    struct PartCopy;
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
      const Inertia *inertia = nullptr;
      /** Of a step with energy-momentum forces, or null. */
      const StepStart *start = nullptr;
    };

    /** assemble() at @p state; the energy of this rank's cells. */
    Energies
    assemble_at(const State                     &state,
                const AffineConstraints<double> &constraints,
                Matrix                          &matrix,
                Vector                          &right_hand_side) const;

    using TermPointers = std::vector<const Term *>;

    /** The sum of the residuals of @p terms; this rank's energy. */
    Energies
    sum_residuals(const TermPointers &terms,
                  const State        &state,
                  Vector             &result) const;

    /** All terms, inertia included. */
    TermPointers
    terms_at(const State &state) const;

    /** The loop. */
    void
    loop(const TermPointers &terms,
         const State        &state,
         const bool          wants_tangent,
         const Copier       &copier) const;

    const Discretization &discretization_;
    EdgePenalty           penalty_;
    /** Kinematics refer to it. */
    const std::unique_ptr<SectionStates> section_states_;
    /** Each loop has a copy. */
    const std::unique_ptr<const Kinematics> kinematics_;
    const RotationConditions                rotation_conditions_;
    const Terms                             terms_;
    /** Whether to assemble the symmetric part of the tangent. */
    const bool symmetrizes_;
  };
} // namespace Nacre

#endif
