// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_edge_side_h
#define nacre_forms_finite_edge_side_h

#include <nacre/forms/node_vectors.h>

#include <cmath>
#include <type_traits>

namespace Nacre
{
  /**
   * The angle (rad) in (-pi, pi] whose sine and cosine are @p y and @p x times
   * a positive factor: atan2, for complex steps as well.
   */
  template <typename Number>
  Number
  angle_of(const Number &y, const Number &x)
  {
    using std::atan;
    using std::real;
    if constexpr (std::is_same<Number, double>::value)
      return std::atan2(y, x);
    else if (std::abs(real(x)) > std::abs(real(y)))
      return atan(y / x) +
             (real(x) > 0. ? 0. : std::copysign(numbers::PI, real(y)));
    else
      return std::copysign(numbers::PI_2, real(y)) - atan(x / y);
  }

  /** One side of a FiniteEdgePoint, which has the meaning of the symbols. */
  template <typename Number>
  struct FiniteEdgeSide
  {
    using Vector = Tensor<1, spacedim, Number>;

    /** The deformed frame of the side, and lambda. */
    void
    deform(const SurfaceFrame<>        &frame,
           const std::array<Vector, 2> &du,
           const double                 sigma)
    {
      deformed       = make_surface_frame<Number>(frame.a_cov[0] + du[0],
                                            frame.a_cov[1] + du[1],
                                            {});
      const Vector e = tau[0] * deformed.a_cov[0] + tau[1] * deformed.a_cov[1];
      using std::sqrt;
      length   = sqrt(Number(e * e));
      tangent  = e / length;
      normal   = sigma * deformed.t0;
      conormal = cross_product_3d(normal, tangent);
      lambda   = deformed.j0 / (frame.j0 * length);
    }

    /** What @p gradient by v_e, v_n and y makes of a displacement. */
    Number
    variation(const std::array<Vector, 3> &gradient,
              const NodeVectors<Number>   &u) const
    {
      Number sum = 0.;
      for (unsigned int a = 0; a < u.size(); ++a)
        for (unsigned int k = 0; k < 3; ++k)
          sum += rows[k][a] * (gradient[k] * u[a]);
      return sum;
    }

    /** Rows of v_e, v_n and y: scalars that multiply the nodes' v. */
    std::array<std::vector<Number>, 3> rows;
    /** Components of the undeformed unit tangent d0. */
    std::array<double, 2> tau;
    /** Y0 . t0 with sigma (force); of linear laws. */
    double initial_moment;
    /** c with sigma: only set for sections that couple. */
    Voigt<> coupling;
    /** Factor of the angle of t in alpha, and of lambda m_nn in the mean. */
    double jump_factor;
    double mean_factor;

    SurfaceFrame<Number> deformed;
    /** sigma t, the deformed conormal nu, and the unit tangent d. */
    Vector normal;
    Vector conormal;
    Vector tangent;
    /** |e| and lambda (1). */
    Number length;
    Number lambda;
    /** m_nn with sigma (force). */
    Number moment;
    Vector Y;
  };
} // namespace Nacre

#endif
