// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_kinematics_options_h
#define nacre_problem_kinematics_options_h

#include <nacre/base/selection.h>

namespace Nacre
{
  /** How the membrane strain of a cell is integrated. */
  enum class MembraneStrain
  {
    /** Tied at Gauss points: free of locking, no spurious modes. */
    tied,
    /** At all points of the full rule: locks. */
    full,
    /**
     * Lagrange cells: at p x p points, blended with full integration by
     * f = min(1, h^2 / |K|) against spurious modes. 8-node cells and
     * triangles: the bending strain too is integrated with 2 x 2, 3 points.
     */
    reduced
  };

  const Selection<MembraneStrain> &selection(MembraneStrain);

  /**
   * Whether results take the tied membrane strain: for all but `full`. A form
   * of reduced integration sees the membrane strain at its few points only; in
   * between the strain of the displacements holds parts without a meaning,
   * which grow against the others like the inverse of the thickness.
   */
  bool
  recovers_tied_strain(const MembraneStrain membrane_strain);

  /** The frame in which rotations and moments of an edge are measured. */
  enum class EdgeForm
  {
    /** Each cell's own: the scalar form, independent of creases. */
    rotation_jump,
    /** That of the averaged normal: the report's form (14), (34)-(45). */
    averaged_normal
  };

  const Selection<EdgeForm> &selection(EdgeForm);

  /** How strains follow from displacements. */
  enum class KinematicsModel
  {
    /** Small displacements. */
    linear,
    /** Small strains in frames that turn with the material. */
    corotational,
    /** Green strains: rotations and strains of any size. */
    finite
  };

  const Selection<KinematicsModel> &selection(KinematicsModel);

  /**
   * The matrix of a linearisation of nonlinear internal forces and following
   * loads.
   */
  enum class TangentType
  {
    /** Rotations held: not the derivative, but symmetric, (47). */
    frozen,
    /** The symmetric part of the derivative, for symmetric solvers. */
    symmetric,
    /**
     * The derivative itself: unsymmetric by 1e-4 to 1e-3, since the
     * co-rotational bending forces are no exact gradient. The solvers of
     * LinearSolver read one triangle and can't take it; it serves comparisons.
     */
    consistent,
    /**
     * Of finite rotations only, and no parameter's value: the part of the
     * Hessian that the forces and moments of the state make, times the second
     * variations of the strains; without that of the section's stiffness.
     */
    stress
  };

  const Selection<TangentType> &selection(TangentType);

  /** Which Kinematics make_kinematics() makes. */
  struct KinematicsOptions
  {
    KinematicsOptions(
      const MembraneStrain  membrane_strain = MembraneStrain::tied,
      const EdgeForm        edge_form       = EdgeForm::rotation_jump,
      const KinematicsModel model           = KinematicsModel::linear,
      const TangentType     tangent         = TangentType::symmetric)
      : membrane_strain(membrane_strain)
      , edge_form(edge_form)
      , model(model)
      , tangent(tangent)
    {}

    MembraneStrain  membrane_strain;
    EdgeForm        edge_form;
    KinematicsModel model;
    TangentType     tangent;
  };
} // namespace Nacre

#endif
