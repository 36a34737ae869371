// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_williams_fields_h
#define nacre_mechanics_williams_fields_h

#include <nacre/base/types.h>

#include <array>
#include <cmath>
#include <vector>

namespace Nacre
{
  /**
   * A sum of r^a (c cos b theta + s sin b theta). Its derivatives along x =
   * r cos theta and y = r sin theta are of the same kind: with z = x + i y
   *
   *   r^a e^(i b theta) = z^m zbar^n,  m = (a + b)/2, n = (a - b)/2,
   *   d/dx = d/dz + d/dzbar,  d/dy = i (d/dz - d/dzbar).
   */
  class PolarSeries
  {
  public:
    void
    add(const double exponent,
        const double frequency,
        const double cosine,
        const double sine)
    {
      if (cosine != 0. || sine != 0.)
        terms_.push_back({exponent, frequency, cosine, sine});
    }

    PolarSeries
    along_x() const;

    PolarSeries
    along_y() const;

    PolarSeries
    scaled(const double factor) const;

    /** The same with r over @p length in place of r. */
    PolarSeries
    stretched(const double length) const;

    /** The largest exponent a of r; without terms 0. */
    double
    degree() const;

    void
    add(const PolarSeries &other)
    {
      terms_.insert(terms_.end(), other.terms_.begin(), other.terms_.end());
    }

    /** The value; @p theta may be any angle, beyond half a turn too. */
    template <typename Number>
    Number
    operator()(const Number &r, const Number &theta) const
    {
      using std::cos;
      using std::pow;
      using std::sin;
      Number sum = 0.;
      for (const auto &term : terms_)
        {
          const Number angle = term.frequency * theta;
          sum += pow(r, term.exponent) *
                 (term.cosine * cos(angle) + term.sine * sin(angle));
        }
      return sum;
    }

  private:
    struct Term
    {
      double exponent, frequency, cosine, sine;
    };

    std::vector<Term> terms_;
  };

  /** What the fields at a crack's tip depend on. */
  struct ElasticPlate
  {
    /** E (force/length^2). */
    double youngs_modulus;
    double poissons_ratio;
    /** h (length). */
    double thickness;

    /** D = E h^3 / (12 (1 - nu^2)) (force length). */
    double
    bending_stiffness() const
    {
      return youngs_modulus * thickness * thickness * thickness /
             (12. * (1. - poissons_ratio * poissons_ratio));
    }
  };

  /** How a crack in a plate is loaded, and its stress intensity factor. */
  enum class CrackMode
  {
    /** K_I: the lips open in the plane. */
    opening,
    /** K_II: they slide along the crack. */
    sliding,
    /** K_M: moments m_22, positive if they open the face on the side of t0. */
    bending,
    /** K_T: twisting moments and shear forces. */
    twisting
  };

  /**
   * A displacement field around the tip of a straight crack in an elastic
   * plate without loads, whose lips theta = +-pi are free: components along
   * e_1, ahead of the tip, e_2 and e_3 = e_1 x e_2, the plate's normal;
   * functions of the distance r from the tip and of the angle theta from e_1
   * to e_2, which may go on beyond +-pi on the sheet of either lip.
   *
   * Williams, J. Appl. Mech. 24 (1957) 109 and 28 (1961) 78.
   */
  class WilliamsField
  {
  public:
    /** Components u, v, w. */
    explicit WilliamsField(const std::array<PolarSeries, 3> &displacement);

    /** The same with r over @p length in place of r. */
    WilliamsField
    stretched(const double length) const;

    /** The largest exponent of r. */
    double
    degree() const;

    template <typename Number>
    Tensor<1, 3, Number>
    value(const Number &r, const Number &theta) const
    {
      return evaluate(values_, r, theta);
    }

    /** The derivatives along e_1 and e_2. */
    template <typename Number>
    std::array<Tensor<1, 3, Number>, 2>
    gradient(const Number &r, const Number &theta) const
    {
      return {
        {evaluate(gradients_[0], r, theta), evaluate(gradients_[1], r, theta)}};
    }

    /** The second derivatives 11, 22, 12. */
    template <typename Number>
    std::array<Tensor<1, 3, Number>, 3>
    hessian(const Number &r, const Number &theta) const
    {
      return {{evaluate(hessians_[0], r, theta),
               evaluate(hessians_[1], r, theta),
               evaluate(hessians_[2], r, theta)}};
    }

  private:
    using Components = std::array<PolarSeries, 3>;

    template <typename Number>
    static Tensor<1, 3, Number>
    evaluate(const Components &components, const Number &r, const Number &theta)
    {
      Tensor<1, 3, Number> u;
      for (unsigned int c = 0; c < 3; ++c)
        u[c] = components[c](r, theta);
      return u;
    }

    Components                values_;
    std::array<Components, 2> gradients_;
    std::array<Components, 3> hessians_;
  };

  /**
   * The membrane field r^(n/2), n = 1, 2, ..., of plane stress times
   * 2 mu = E/(1 + nu):
   *
   *   2 mu u = r^(n/2) [(kappa + n/2 + (-1)^n) cos(n theta/2)
   *                     - n/2 cos((n/2 - 2) theta)]
   *   2 mu v = r^(n/2) [(kappa - n/2 - (-1)^n) sin(n theta/2)
   *                     + n/2 sin((n/2 - 2) theta)]
   *
   * with kappa = (3 - nu)/(1 + nu) if it is @p symmetric, and
   *
   *   2 mu u = r^(n/2) [(kappa + n/2 - (-1)^n) sin(n theta/2)
   *                     - n/2 sin((n/2 - 2) theta)]
   *   2 mu v = -r^(n/2) [(kappa - n/2 + (-1)^n) cos(n theta/2)
   *                      + n/2 cos((n/2 - 2) theta)]
   *
   * if it isn't.
   */
  WilliamsField
  membrane_williams_field(const unsigned int  n,
                          const bool          symmetric,
                          const ElasticPlate &plate);

  /**
   * The bending field, lambda = n/2, n = 1, 2, ...,
   *
   *   w = r^(lambda + 1) [f((lambda + 1) theta) + B f((lambda - 1) theta)],
   *
   * f the cosine if it is @p symmetric, else the sine. B follows from the free
   * lips: of the moment m_nn and of Kirchhoff's force V, which for f(b theta)
   * are in proportion to
   *
   *   m: -b^2 + (lambda + 1)(1 + nu lambda),
   *   V: b [b^2 - (lambda + 1)^2 - (1 - nu) lambda (lambda - 1)],
   *
   * one vanishes at theta = +-pi by itself.
   */
  WilliamsField
  bending_williams_field(const unsigned int  n,
                         const bool          symmetric,
                         const ElasticPlate &plate);

  /** Its w. */
  PolarSeries
  bending_williams_series(const unsigned int n,
                          const bool         symmetric,
                          const double       poissons_ratio);

  /**
   * The field n = 1 of a mode whose intensity is 1: ahead of the tip
   *
   *   opening:  sigma_22 = K_I / sqrt(2 pi r)   (K_I: force/length^(3/2))
   *   sliding:  sigma_12 = K_II / sqrt(2 pi r)
   *   bending:  m_22 = K_M / sqrt(2 pi r)       (K_M: force length^(1/2))
   *   twisting: m_12 = (1 + nu)/(3 + nu) K_T / sqrt(2 pi r),
   *
   * with membrane forces sigma h, and m the moment per length, positive if it
   * stretches the face on the side of e_3.
   */
  WilliamsField
  unit_williams_field(const CrackMode mode, const ElasticPlate &plate);

  /**
   * The energy release rate (force) of the intensity 1 of a mode: of any
   *
   *   G = (K_I^2 + K_II^2) h/E + (K_M^2 + K_T^2)/(D (1 - nu)(3 + nu)),
   *
   * per length of the crack. The second part is that of Hui and Zehnder, Int.
   * J. Fracture 61 (1993) 211, in other letters.
   */
  double
  unit_release_rate(const CrackMode mode, const ElasticPlate &plate);
} // namespace Nacre

#endif
