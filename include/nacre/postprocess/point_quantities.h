// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_point_quantities_h
#define nacre_postprocess_point_quantities_h

#include <nacre/postprocess/point_results.h>
#include <nacre/postprocess/quantity_phrase.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A stress, force, moment or rotation at a point of the mid-surface: a value
   * of PointResults, not smoothed.
   *
   * - `stress 11, 22, 12 FACE at (point)`: e_i . S e_j at a face of the
   *   section, bottom, middle or top (force/length^2);
   * - `principal stress 1, 2 FACE at (point)`: its eigenvalues, 1 the larger
   *   one; `von Mises stress FACE at (point)` (force/length^2);
   * - `membrane force 11, 22, 12 at (point)`: e_i . N e_j; `principal membrane
   *   force 1, 2 at (point)`: its eigenvalues (force/length);
   * - `moment 11, 22, 12 at (point)`: e_i . M e_j, positive where it stretches
   *   the top; 11 is the moment of stresses along 1; `principal moment 1, 2 at
   *   (point)`: its eigenvalues (force);
   * - `transverse shear 1, 2 at (point)`: e_i . q, see TransverseShear
   *   (force/length);
   * - `rotation x, y, z, (a, b, c) at (point)`: of the normal, about a
   *   direction of space, by the right hand's rule (rad).
   *
   * 1, 2 and the top are those of ShellModel::result_axes; `along DIRECTION`
   * before `at` gives another axis 1, the projection of x, y, z or (a, b, c)
   * onto the surface. On an edge between cells the value is that of the cell of
   * the lowest index.
   */
  struct PointQuantity
  {
    enum class Kind
    {
      stress,
      principal_stress,
      von_mises_stress,
      membrane_force,
      principal_membrane_force,
      moment,
      principal_moment,
      transverse_shear,
      rotation
    };

    Kind kind;
    /** i, j of a component, counted from 0. */
    std::array<unsigned int, 2> component{{0, 0}};
    Face                        face = Face::middle;
    /** Of a rotation (1). */
    Tensor<1, spacedim> direction = {};
    /** The axis 1 is its projection; none: that of the model. */
    std::optional<Tensor<1, spacedim>> axis  = {};
    Point<spacedim>                    point = {};
    /** The parameter, for messages. */
    std::string where = {};
  };

  const Selection<PointQuantity::Kind> &selection(PointQuantity::Kind);

  /** The largest or smallest stress of a shell. */
  struct ExtremeStress
  {
    enum class Kind
    {
      largest_principal,
      smallest_principal,
      largest_von_mises
    };

    Kind kind;
    Face face;
  };

  const Selection<ExtremeStress::Kind> &selection(ExtremeStress::Kind);

  /**
   * The quantity that a @p phrase begins with the name of, or none. Takes the
   * words of it, and throws for those that are not understood.
   */
  std::optional<PointQuantity>
  parse_point_quantity(QuantityPhrase &phrase, const Constants &constants);

  std::optional<ExtremeStress>
  parse_extreme_stress(QuantityPhrase &phrase);

  /** The face that a @p word names; throws for others. */
  Face
  parse_face(const std::string &word, const QuantityPhrase &phrase);

  /**
   * The @p value of the results at a @p point; collective. Throws on all ranks,
   * with @p where, if it isn't on the mid-surface.
   */
  double
  value_at_point(const ShellState                                  &state,
                 const Point<spacedim>                             &point,
                 const std::string                                 &where,
                 const std::function<double(const PointResults &)> &value,
                 const bool with_shear = false);

  /**
   * The largest @p value over the nodes of all cells, each cell by itself;
   * collective.
   */
  double
  largest_value(const ShellState                                  &state,
                const std::function<double(const PointResults &)> &value);

  /**
   * The value; collective. Throws on all ranks if the point isn't on the
   * mid-surface, and where an axis is normal to it.
   */
  double
  evaluate_point_quantity(const ShellState    &state,
                          const PointQuantity &quantity);

  /** What a functional takes of a displacement u at a point. */
  struct PointWeights
  {
    /** Of u (1). */
    Tensor<1, spacedim> value = {};
    /** Of u,1 and u,2 (1/length). */
    std::array<Tensor<1, spacedim>, dim> derivatives = {};
  };

  /**
   * The vector g of v . u + w_1 . u,1 + w_2 . u,2 = g . u at the @p point of
   * the mid-surface; @p weights is called on the rank that has the point, with
   * the values there and the dofs of the part of a cell, and answers v, w.
   * Collective; throws with @p where if there is no such point.
   */
  TrilinosWrappers::MPI::Vector
  point_functional(
    const Discretization  &discretization,
    const Point<spacedim> &point,
    const std::string     &where,
    const std::function<
      PointWeights(const ShellCellValues                      &values,
                   const std::vector<types::global_dof_index> &dofs)> &weights);

  /**
   * An angle at a displacement, up to whole turns (rad), and its gradient
   * (rad/length).
   */
  struct Angle
  {
    double                        value = 0.;
    TrilinosWrappers::MPI::Vector gradient;
  };

  /**
   * The angle about the direction d by which the normal of a @p quantity of the
   * kind rotation has turned at a ghosted @p displacement (length), under
   * kinematics that aren't linear; collective. With the undeformed normal t_0
   * and the deformed tangents phi_1, phi_2
   *
   *   tan(angle) = n . s / n . p,   n = phi_1 x phi_2,
   *   s = d x t_0,   p = t_0 - (d . t_0) d.
   *
   * If the normal has turned about d alone, this is PointResults::rotation . d.
   * Throws on all ranks if d is normal to the undeformed surface, and as
   * evaluate_point_quantity().
   */
  Angle
  evaluate_angle(const Discretization                &discretization,
                 const TrilinosWrappers::MPI::Vector &displacement,
                 const PointQuantity                 &quantity);

  /** Over the nodes of all cells; collective. */
  double
  evaluate_extreme_stress(const ShellState    &state,
                          const ExtremeStress &quantity);
} // namespace Nacre

#endif
