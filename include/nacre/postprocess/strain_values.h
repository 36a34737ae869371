// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_strain_values_h
#define nacre_postprocess_strain_values_h

#include <nacre/discretization/shell_values.h>
#include <nacre/forms/section_states.h>
#include <nacre/postprocess/shell_state.h>

#include <deal.II/lac/vector.h>

#include <optional>

namespace Nacre
{
  /**
   * The strains of a displacement at any points of one cell after the other,
   * as results take them: tied membrane strains where recovers_tied_strain()
   * says so; for large rotations the strains that no rotation changes,
   * 1/2 (phi,a . phi,b - phi0,a . phi0,b) and -(phi,ab . t) + phi0,ab . t0,
   * which are those of the co-rotational form as long as they are small.
   */
  class StrainValues
  {
  public:
    /**
     * @param state must live as long
     * @param points in the reference cell
     * @param spread whether the points are spread over parts that
     *   has_blocks(), as points_on_part() does
     */
    StrainValues(const ShellState      &state,
                 const Quadrature<dim> &points,
                 const bool             spread = false);

    /** Points on a lip, as PartEnrichment::evaluate() takes it. */
    StrainValues(const ShellState      &state,
                 const Quadrature<dim> &points,
                 const Tensor<1, dim>  &lip)
      : StrainValues(state, points)
    {
      values_->use_lip(lip);
    }

    void
    reinit(const CellPart &part);

    /** Frames and positions of the undeformed surface. */
    const ShellCellValues &
    values() const
    {
      return *values_;
    }

    /** Covariant (e11, e22, 2 e12) (length^2). */
    Voigt<>
    membrane(const unsigned int q) const
    {
      return component(membrane_, q);
    }

    /** Covariant (r11, r22, 2 r12) (length). */
    Voigt<>
    bending(const unsigned int q) const
    {
      return component(bending_, q);
    }

    /** What the section remembers: that of the nearest point of the form. */
    SectionState
    section_state(const unsigned int q) const
    {
      return section_states_ == nullptr || section_states_->has_none() ?
               SectionState() :
               section_states_->nearest(part_,
                                        values_->quadrature().get_points()[q]);
    }

    /** The displacement (length). */
    Tensor<1, spacedim>
    displacement(const unsigned int q) const;

    /** What of it tip functions are. */
    FieldDerivatives
    tip_displacement(const unsigned int q) const;

    /** t - t0 of the unit normals, or Delta t (17) in linear kinematics (1). */
    Tensor<1, spacedim>
    normal_change(const unsigned int q) const;

    /**
     * The rotation vector that turns t0 into t by the shortest way: of the
     * length of the angle along t0 x t; t0 x Delta t in linear kinematics
     * (rad).
     */
    Tensor<1, spacedim>
    rotation(const unsigned int q) const;

  private:
    static Voigt<>
    component(const Vector<double> &strains, const unsigned int q)
    {
      return Voigt<>({strains[3 * q], strains[3 * q + 1], strains[3 * q + 2]});
    }

    /** phi,1, phi,2 at the point @p q of a table. */
    std::array<Tensor<1, spacedim>, dim>
    deformed_basis(const SurfaceFrame<> &frame,
                   const ShapeTable     &shapes,
                   const unsigned int    q) const;

    /** Make room for other points. */
    void
    set_points(const Quadrature<dim> &points);

    void
    fill_finite_strains();

    const MembraneStrain                 membrane_strain_;
    const bool                           is_linear_;
    const Quadrature<dim>                points_;
    const bool                           spread_;
    bool                                 is_spread_ = false;
    const Discretization                &discretization_;
    const TrilinosWrappers::MPI::Vector &displacement_;
    const SectionStates *const           section_states_;
    CellPart                             part_;
    std::vector<types::global_dof_index> dofs_;
    std::optional<ShellCellValues>       values_;
    Vector<double>                       u_;
    /** [3 point + component] */
    Vector<double> membrane_;
    Vector<double> bending_;
  };
} // namespace Nacre

#endif
