// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_stress_polynomials_h
#define nacre_postprocess_stress_polynomials_h

#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/problem/kinematics_options.h>

#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace Nacre
{
  class SectionStates;

  /**
   * The stress resultants of displacements as polynomials of the reference
   * cell, on this rank's cells and their ghosts, or the parts of them: the
   * vectors of space
   *   N^b  = sqrt a (n^ab a_a + m^cd Gamma^b_cd t0)    b = 1, 2
   *   M^ab = sqrt a m^ab t0                            ab = 11, 22, 12
   * of which the internal forces are sqrt a f^b = N^b + M^ab,a. They take the
   * form of the element's functions, through their values at the points of its
   * full rule, and can be differentiated and continued to the edges. Parts that
   * have functions of tips have zeros.
   *
   * In large rotations n and m are those of GreenStrain, a_a, t0 and Gamma are
   * the deformed surface's, and sqrt a stays that of the undeformed one: then
   * sqrt a f^b does the work of the internal forces at the deformed state.
   */
  class StressPolynomials
  {
  public:
    using Vector3      = Tensor<1, spacedim>;
    using Displacement = TrilinosWrappers::MPI::Vector;

    /**
     * @param displacements ghosted (length)
     * @param states of a section with memory; null: at rest
     */
    StressPolynomials(const Discretization                    &discretization,
                      const SectionLaw                        &section,
                      const KinematicsOptions                 &kinematics,
                      const std::vector<const Displacement *> &displacements,
                      SectionStates *const states = nullptr);

    /** Values of a displacement's polynomials on a part: [vector][node]. */
    const Vector3 *
    nodal(const CellPart &part, const unsigned int displacement) const
    {
      return &nodal_[begin(part, displacement)];
    }

    /** sqrt a f^b (force) at the point @p q of a table. */
    static std::array<Vector3, 2>
    forces(const Vector3     *nodal,
           const ShapeTable  &shapes,
           const unsigned int q);

    /** (sqrt a f^b),b (force). */
    static Vector3
    divergence(const Vector3     *nodal,
               const ShapeTable  &shapes,
               const unsigned int q);

    /** sqrt a m^ab x_a y_b t0 for covariant components x, y. */
    static Vector3
    moment(const Vector3               *nodal,
           const ShapeTable            &shapes,
           const unsigned int           q,
           const std::array<double, 2> &x,
           const std::array<double, 2> &y);

  private:
    /** N^1, N^2, M^11, M^22, M^12 */
    static constexpr unsigned int n_vectors = 5;

    std::size_t
    begin(const CellPart &part, const unsigned int displacement) const
    {
      return (std::size_t(part.index()) * n_displacements_ + displacement) *
             n_vectors * n_nodes_;
    }

    const unsigned int   n_displacements_;
    const unsigned int   n_nodes_;
    std::vector<Vector3> nodal_; // [part][displacement][vector][node]
  };
} // namespace Nacre

#endif
