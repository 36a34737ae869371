// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_term_h
#define nacre_forms_term_h

#include <nacre/forms/kinematics.h>
#include <nacre/forms/shell_actions.h>

#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

namespace Nacre
{
  /** The displacement (length) on the dofs of a cell or an edge. */
  struct LocalState
  {
    /** Where forces are taken; empty for zero. */
    dealii::Vector<double> u;
    /** @name Ends of a step with energy-momentum forces; else empty */
    //@{
    dealii::Vector<double>     u_start;
    dealii::Vector<double>     u_end;
    const PrescribedRotations *rotations_start = nullptr;
    //@}

    bool
    is_step() const
    {
      return u_start.size() > 0;
    }
  };

  /** A cell, or a part of one, as terms see it. */
  class TermCell
  {
  public:
    TermCell(const CellPart                             &part,
             const std::vector<types::global_dof_index> &dofs,
             const LocalState                           &state,
             const ShellActions                         &actions,
             Kinematics                                 &kinematics)
      : part(part)
      , dofs(dofs)
      , state(state)
      , actions(actions)
      , kinematics_(kinematics)
    {}

    const CellPart                             &part;
    const std::vector<types::global_dof_index> &dofs;
    const LocalState                           &state;
    const ShellActions                         &actions;

    /** Frames at the full rule. */
    const ShellCellValues &
    values()
    {
      if (!has_values_)
        kinematics_.reinit_cell_values(part);
      has_values_ = true;
      return kinematics_.cell_values();
    }

    /** To add the terms of the cell, whose values they compute. */
    Kinematics &
    kinematics()
    {
      has_values_ = true;
      return kinematics_;
    }

  private:
    Kinematics &kinematics_;
    bool        has_values_ = false;
  };

  /** An edge as terms see it: points with one or two sides. */
  struct TermEdge
  {
    const ShellEdgeValues &values;
    /** eta^e (1/length) of EdgePenalty. */
    double              penalty;
    const LocalState   &state;
    const ShellActions &actions;
    Kinematics         &kinematics;
    /** Of a boundary edge. */
    types::boundary_id boundary_id;
    /** EdgePiece::place() of a boundary edge, key of PrescribedRotations. */
    std::pair<unsigned int, unsigned int> place;
  };

  /**
   * A part of the shell's virtual work: what a cell, an edge between two cells,
   * a boundary edge, a lip of a cut or a point adds to the residual F(u) - f
   * (force), to its derivative (force/length) and to the energy. A load adds
   * -f.
   *
   * Terms hold no state of the shell and no time. Assembly sums up those of
   * make_terms().
   */
  class Term
  {
  public:
    virtual ~Term() = default;

    /**
     * Whether it is the virtual work of a load, which is proportional to the
     * factor of its Instant, so that the value at the factor 1 is the
     * derivative with respect to the factor.
     */
    virtual bool
    is_load() const
    {
      return false;
    }

    virtual void
    add_on_cell(TermCell & /*cell*/, LocalTerms & /*terms*/) const
    {}

    virtual bool
    acts_between_cells() const
    {
      return false;
    }

    virtual void
    add_between_cells(const TermEdge & /*edge*/, LocalTerms & /*terms*/) const
    {}

    /** Whether it adds to the boundary edge @p id at @p place. */
    virtual bool
    acts_on_boundary(const types::boundary_id /*id*/,
                     const std::pair<unsigned int, unsigned int> & /*place*/,
                     const ShellActions & /*actions*/) const
    {
      return false;
    }

    virtual void
    add_on_boundary(const TermEdge & /*edge*/, LocalTerms & /*terms*/) const
    {}

    virtual bool
    acts_on_lips() const
    {
      return false;
    }

    /** @param edge the lip's points, with one side */
    virtual void
    add_on_lip(const TermEdge & /*edge*/,
               const CutLip & /*lip*/,
               LocalTerms & /*terms*/) const
    {}

    /**
     * Add the forces of points to the right-hand side, f - F(u); the
     * constraints are eliminated. Collective.
     */
    virtual void
    add_point_forces(const AffineConstraints<double> & /*constraints*/,
                     const ShellActions & /*actions*/,
                     TrilinosWrappers::MPI::Vector & /*right_hand_side*/) const
    {}
  };

  using Terms = std::vector<std::unique_ptr<const Term>>;
} // namespace Nacre

#endif
