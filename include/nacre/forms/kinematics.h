// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_kinematics_h
#define nacre_forms_kinematics_h

#include <nacre/discretization/shell_edge_values.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/forms/prescribed_rotation.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/problem/kinematics_options.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace Nacre
{
  class SectionStates;

  /** Parts of the stored energy (force times length). */
  struct Energies
  {
    /** Of nonlinear sections: all but 1/2 kappa : m. */
    double membrane = 0.;
    double bending  = 0.;
    /** Penalty and consistency terms of interior and boundary edges. */
    double edge = 0.;
    /** Of an elastic foundation. */
    double foundation = 0.;

    double
    total() const
    {
      return membrane + bending + edge + foundation;
    }

    Energies &
    operator+=(const Energies &other);
  };

  /** The rule of the bending energy, and of the loads. */
  Quadrature<dim>
  cell_quadrature(const Element &element, const MembraneStrain membrane_strain);

  /** Whether the membrane strain is integrated by two rules. */
  bool
  blends_integration(const Element       &element,
                     const MembraneStrain membrane_strain);

  /** reduced for 8-node cells, tied for all others. */
  MembraneStrain
  default_membrane_strain(const ElementType element);

  /** What the terms of a cell or an edge contribute, on local dofs. */
  struct LocalTerms
  {
    /** Whether to fill the tangent. */
    bool               wants_tangent = true;
    FullMatrix<double> tangent;
    /** Internal forces at the current displacement. */
    Vector<double> residual;
    Energies       energies;
    /**
     * Work of prescribed rotations in a step (force times length), of
     * add_rotation_step_terms() only.
     */
    double rotation_work = 0.;

    /** Set to zero for @p n_dofs dofs. */
    void
    reinit(const unsigned int n_dofs);
  };

  /**
   * The local terms of the shell's virtual work and their derivative at the
   * current displacement: linear, co-rotational and finite-rotation
   * kinematics are alternatives of this interface.
   */
  class Kinematics
  {
  public:
    virtual ~Kinematics() = default;

    /** Take the section's initial strains at @p instant from now on. */
    virtual void
    set_instant(const Instant & /*instant*/)
    {}

    /** A copy with scratch data of its own. */
    virtual std::unique_ptr<Kinematics>
    clone() const = 0;

    /**
     * Membrane and bending terms of @p cell, (32)-(33), at the displacement
     * @p u of the cell's dofs; adds to @p terms. Afterwards cell_values() are
     * those of the cell.
     */
    virtual void
    add_cell_terms(const CellPart       &part,
                   const Vector<double> &u,
                   LocalTerms           &terms) = 0;

    /** Frames at the full rule of the last cell. */
    virtual const ShellCellValues &
    cell_values() const = 0;

    /** Make @p cell the last cell, without any terms. */
    virtual void
    reinit_cell_values(const CellPart &part) = 0;

    /**
     * Terms of an interior edge, at the displacement @p u of the edge's dofs.
     * @param penalty eta^e = eta / h^e (1/length)
     */
    virtual void
    add_edge_terms(const ShellEdgeValues &edge,
                   const double           penalty,
                   const Vector<double>  &u,
                   LocalTerms            &terms) = 0;

    /**
     * Terms of a boundary edge with the prescribed rotation @p rotation[q];
     * data terms included.
     */
    virtual void
    add_rotation_terms(const ShellEdgeValues                 &edge,
                       const double                           penalty,
                       const std::vector<PrescribedRotation> &rotation,
                       const Vector<double>                  &u,
                       LocalTerms                            &terms) = 0;

    /**
     * The angle (rad) between the deformed normal and that of the prescribed
     * rotation at the point @p q of a boundary edge; 0 where displacements are
     * so small that nothing turns.
     */
    virtual double
    rotation_gap(const ShellEdgeValues & /*edge*/,
                 const unsigned int /*q*/,
                 const PrescribedRotation & /*rotation*/,
                 const Vector<double> & /*u*/)
    {
      return 0.;
    }

    /**
     * Terms of the bending moment @p moment[q] per length (force) on a
     * boundary edge: the load l(v) = -int m theta(v) ds, theta(v) the rotation
     * about the edge at the displacement @p u.
     */
    virtual void
    add_moment_terms(const ShellEdgeValues     &edge,
                     const std::vector<double> &moment,
                     const Vector<double>      &u,
                     LocalTerms                &terms) = 0;

    /**
     * @name Energy-momentum forces of a step from @p u_start to @p u_end
     *
     * Mean forces whose work on u_end - u_start is the change of the strain
     * energy, less rotation_work, and which have no moment at the mean
     * positions. The tangent is, nearly, their derivative with respect to the
     * mean displacement; energies are not set. For energies that are quadratic
     * in the displacement these are the forces at the mean displacement, as
     * here.
     */
    //@{
    virtual void
    add_cell_step_terms(const CellPart       &part,
                        const Vector<double> &u_start,
                        const Vector<double> &u_end,
                        LocalTerms           &terms);

    virtual void
    add_edge_step_terms(const ShellEdgeValues &edge,
                        const double           penalty,
                        const Vector<double>  &u_start,
                        const Vector<double>  &u_end,
                        LocalTerms            &terms);

    /** Rotations at both ends. */
    virtual void
    add_rotation_step_terms(
      const ShellEdgeValues                 &edge,
      const double                           penalty,
      const std::vector<PrescribedRotation> &rotation_start,
      const std::vector<PrescribedRotation> &rotation_end,
      const Vector<double>                  &u_start,
      const Vector<double>                  &u_end,
      LocalTerms                            &terms);
    //@}
  };

  /**
   * The alternative that @p options name; throws where it has no terms for the
   * section.
   * @param states of the section, which must live as long; null: at rest
   */
  std::unique_ptr<Kinematics>
  make_kinematics(const Discretization    &discretization,
                  const SectionLaw        &section,
                  const KinematicsOptions &options,
                  SectionStates           *states = nullptr);
} // namespace Nacre

#endif
