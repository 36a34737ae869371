// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_postprocess_crack_extension_h
#define nacre_postprocess_crack_extension_h

#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/williams_fields.h>

#include <array>
#include <string>

namespace Nacre
{
  /** The end of a crack. */
  struct CrackTip
  {
    /**
     * On the undeformed mid-surface, in a region of it (length): where the
     * lips end.
     */
    SectionPoint position;
    /** e_1 tangent to the surface, ahead; e_2 = t0 x e_1; e_3 = t0. */
    std::array<Tensor<1, 3>, 3> axes;
    /** The longest edge that ends at the tip, or near to it (length). */
    double cell_size;
    /**
     * How far the end of a cut is ahead, which the mesh holds closed up to
     * there (length).
     */
    double closed = 0.;
    /** Whether displacements have the singular fields there. */
    bool has_functions = false;
  };

  /**
   * How far points move with a tip that advances: by the whole advance up to
   * the distance inner from the tip, not from the distance outer on (length).
   * Distances are those of space.
   */
  struct CrackPlateau
  {
    double inner;
    double outer;
  };

  /** Derivatives of a vector along the coordinates of the reference cell. */
  struct VectorDerivatives
  {
    std::array<Tensor<1, 3>, 2> first;
    /** 11, 22, 12. */
    std::array<Tensor<1, 3>, 3> second;
  };

  /** The mid-surface at a point, as far as a moving point feels it. */
  struct SurfacePatch
  {
    SectionPoint      position;
    VectorDerivatives derivatives;
    /** 111, 112, 122, 222. */
    std::array<Tensor<1, 3>, 4> third;
  };

  /**
   * The velocity q of the points of the surface per advance of a tip:
   * contravariant components on the reference cell and their derivatives, such
   * that the coordinates x, y along the tip's e_1 and e_2 change by
   *
   *   x,g q^g = eta(r),  y,g q^g = 0
   *
   * with the plateau eta = 1 - t^5 (126 - 420 t + 540 t^2 - 315 t^3 + 70 t^4),
   * t = (r - inner)/(outer - inner), which has four continuous derivatives:
   * curvatures hold two of them, and quadrature and polynomials feel the third
   * and fourth.
   *
   * A crack in the plane y = 0 moves along itself.
   */
  struct CrackExtension
  {
    CrackExtension(const CrackTip     &tip,
                   const CrackPlateau &plateau,
                   const SurfacePatch &surface);

    /** q^g. */
    Tensor<1, 2> q;
    /** q^g,a as [g][a]. */
    Tensor<2, 2> gradient;
    /** q^g,11, q^g,22, q^g,12 as [v][g]. */
    std::array<Tensor<1, 2>, 3> hessian;
  };

  /** Derivatives of a field that a point carries along: u,g q^g. */
  Tensor<1, 3>
  carried(const VectorDerivatives &u, const CrackExtension &extension);

  /**
   * A Williams field, whose components are those along the axes of @p tip, at
   * a point of the surface. @p side is positive on the side of e_2 and negative
   * on the other: where the crack bends, theta goes on beyond half a turn.
   */
  Tensor<1, 3>
  williams_value(const WilliamsField &field,
                 const CrackTip      &tip,
                 const double         side,
                 const Point<3>      &point);

  /** Its derivatives. */
  VectorDerivatives
  williams_derivatives(const WilliamsField &field,
                       const CrackTip      &tip,
                       const double         side,
                       const SurfacePatch  &surface);

  /** Covariant (e11, e22, 2 e12) (length^2): (3), or the Green strain. */
  Voigt<>
  membrane_strain(const SurfaceFrame<>    &frame,
                  const VectorDerivatives &u,
                  const bool               is_linear);

  /**
   * What the derivatives of a vector of space become at the advance s if points
   * carry it along:
   *
   *   u,a -> u,a - s u,g q^g,a,
   *   u,ab -> u,ab - s (u,gb q^g,a + u,ga q^g,b + u,g q^g,ab).
   */
  VectorDerivatives
  moved(const VectorDerivatives &u,
        const CrackExtension    &extension,
        const double             s);

  /** The surface at the advance s. */
  struct MovedPoint
  {
    MovedPoint(const SurfacePatch   &surface,
               const CrackExtension &extension,
               const double          s);

    /**
     * What the section answers to the displacement @p u there.
     * @param tying as in energy_change()
     */
    SectionResponse
    response(const SectionAt         &section,
             const bool               is_linear,
             const VectorDerivatives &u,
             const Voigt<>           &tying) const;

    SurfaceFrame<> frame;
    SectionPoint   point;
    /** Of the parameters' area. */
    double determinant;
  };

  /**
   * df/ds at s = 0 of a function that varies over @p length, by differences of
   * fourth order.
   */
  template <typename Function>
  double
  change_with_advance(const Function &f, const double length)
  {
    // The error is of the fourth order in step/length, round-off of the order
    // length/step.
    const double step = 1e-3 * length;
    return (8. * (f(step) - f(-step)) - f(2. * step) + f(-2. * step)) /
           (12. * step);
  }

  /**
   * d/ds of the stored energy per area of the reference cell at s = 0, as the
   * parameters move, xi -> xi + s q(xi), with the displacement carried along as
   * a vector of space, see moved():
   *
   *   W(s) j0(s) det(1 + s dq),
   *
   * and the surface, hence the section, taken at xi + s q.
   *
   * @param is_linear linear strains, or those of finite rotations
   * @param tying what a tied membrane strain has more than that of u; it stays
   * @param length over which q varies
   */
  double
  energy_change(const SectionAt         &section,
                const bool               is_linear,
                const SurfacePatch      &surface,
                const CrackExtension    &extension,
                const VectorDerivatives &u,
                const Voigt<>           &tying,
                const double             length);
} // namespace Nacre

#endif
