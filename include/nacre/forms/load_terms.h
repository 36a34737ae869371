// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_load_terms_h
#define nacre_forms_load_terms_h

#include <nacre/base/instant.h>
#include <nacre/forms/kinematics.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace Nacre
{
  class Loads;

  /** The virtual work l(v) of the loads (N.19), cell by cell. */
  class LoadTerms
  {
  public:
    /**
     * Throws if a point force lies off the mesh or on both lips of a slit;
     * collective.
     */
    LoadTerms(const Discretization &discretization,
              const SectionLaw     &section,
              const Loads          &loads);

    /** Whether a load acts on the boundary edges @p id. */
    bool
    act_on(const types::boundary_id id) const;

    /**
     * Subtract force per area, weight and pressure at the displacement @p u of
     * the cell's dofs from the residual.
     * @param u_start the start of a step of which u is the mean, or empty
     */
    void
    subtract_on_cell(const ShellCellValues        &values,
                     const dealii::Vector<double> &u,
                     const dealii::Vector<double> &u_start,
                     const Instant                &instant,
                     LocalTerms                   &terms) const;

    /** Subtract forces and moments per length of a boundary edge. */
    void
    subtract_on_edge(const types::boundary_id      id,
                     const ShellEdgeValues        &edge,
                     const dealii::Vector<double> &u,
                     const Instant                &instant,
                     Kinematics                   &kinematics,
                     LocalTerms                   &terms) const;

    /** Add the virtual work of point forces times @p factor. */
    void
    add_point_forces(const AffineConstraints<double> &constraints,
                     const double                     factor,
                     const Instant                   &instant,
                     TrilinosWrappers::MPI::Vector   &vector) const;

  private:
    void
    subtract_surface_loads(const ShellCellValues  &values,
                           const Instant          &instant,
                           dealii::Vector<double> &residual) const;

    /**
     * Pressure along the deformed normal on the deformed area: the force per
     * reference area is p phi,1 x phi,2; with its derivative. If @p u_start
     * isn't empty, the mean over the straight way of a step from there, of
     * which @p u is the mean: its work is the pressure times the volume that
     * the surface sweeps.
     */
    void
    subtract_following_pressure(const ShellCellValues        &values,
                                const dealii::Vector<double> &u,
                                const dealii::Vector<double> &u_start,
                                const Instant                &instant,
                                LocalTerms                   &terms) const;

    const Discretization     &discretization_;
    const SectionLaw         &section_;
    const Loads              &loads_;
    std::vector<SurfacePoint> force_points_;
  };
} // namespace Nacre

#endif
