// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/hoop_stress.h>

#include <deal.II/base/numbers.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace Nacre
{
  namespace
  {
    /** A hoop stress a cos t + b cos 3t + c (sin t + sin 3t), t = theta/2. */
    struct AngularStress
    {
      double a, b, c;

      double
      value(const double theta) const
      {
        const double t = 0.5 * theta;
        return a * std::cos(t) + b * std::cos(3. * t) +
               c * (std::sin(t) + std::sin(3. * t));
      }

      /** Its derivative by t. */
      double
      slope(const double theta) const
      {
        const double t = 0.5 * theta;
        return -a * std::sin(t) - 3. * b * std::sin(3. * t) +
               c * (std::cos(t) + 3. * std::cos(3. * t));
      }
    };

    /** Angle and value of the maximum in (-pi, pi). */
    HoopStress
    maximum(const AngularStress &stress)
    {
      // Of the third degree in t: a maximum between two samples is the only
      // one.
      const unsigned int n    = 360;
      const double       step = 2. * numbers::PI / n;
      HoopStress         best;
      for (unsigned int i = 1; i < n; ++i)
        {
          const double theta = step * i - numbers::PI;
          const double value = stress.value(theta);
          if (value > best.intensity)
            best = {theta, value, 0.};
        }
      const auto slope = [&](const double theta) {
        return stress.slope(theta);
      };
      const double left = best.angle - step, right = best.angle + step;
      if (best.intensity > 0. && slope(left) > 0. && slope(right) < 0.)
        {
          const auto bracket = boost::math::tools::bisect(
            slope,
            left,
            right,
            boost::math::tools::eps_tolerance<double>(50));
          best.angle     = 0.5 * (bracket.first + bracket.second);
          best.intensity = stress.value(best.angle);
        }
      return best;
    }
  } // namespace

  HoopStress
  largest_hoop_stress(const std::array<double, 4> &intensities,
                      const ElasticPlate          &plate)
  {
    const auto &[K_I, K_II, K_M, K_T] = intensities;
    const double nu = plate.poissons_ratio, h = plate.thickness;
    const double share   = (5. + 3. * nu) / (12. + 4. * nu);
    const auto   at_face = [&](const double sign) {
      const double bending = sign * 6. / (h * h) * K_M;
      const double twist   = sign * 6. / (h * h) * K_T;
      HoopStress   result  = maximum({0.75 * K_I + share * bending,
                                      0.25 * K_I + (1. - share) * bending,
                                      -0.75 * K_II - share * twist});
      result.height        = 0.5 * sign * h;
      return result;
    };
    const HoopStress upper = at_face(1.), lower = at_face(-1.);
    // Round-off is no difference.
    const auto &largest =
      lower.intensity > (1. + 1e-9) * upper.intensity ? lower : upper;
    return largest.intensity > 0. ? largest : HoopStress();
  }
} // namespace Nacre
