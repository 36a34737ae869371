// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/abaqus_deck.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace Nacre::Abaqus
{
  namespace
  {
    /** Coordinates that are left out are zero. */
    Tensor<1, 3>
    point(const std::vector<double> &values, const unsigned int index)
    {
      Tensor<1, 3> result;
      for (unsigned int c = 0; c < 3; ++c)
        if (3 * index + c < values.size())
          result[c] = values[3 * index + c];
      return result;
    }

    /** Shorter than the round-off of the points that it was made of? */
    bool
    vanishes(const Tensor<1, 3> &vector, const double scale)
    {
      return !(vector.norm() >
               16. * std::numeric_limits<double>::epsilon() * scale);
    }
  } // namespace


  Point<3>
  RigidMotion::operator()(const Point<3> &x) const
  {
    return Point<3>(rotation * Tensor<1, 3>(x) + shift);
  }


  bool
  local_system(const std::vector<double> &values, RigidMotion &motion)
  {
    motion       = {};
    motion.shift = point(values, 0);
    if (values.size() <= 3)
      return true;
    const double scale = std::max(
      {motion.shift.norm(), point(values, 1).norm(), point(values, 2).norm()});
    Tensor<1, 3> x = point(values, 1) - motion.shift;
    Tensor<1, 3> z;
    if (values.size() <= 6)
      {
        // The z axis stays, the x axis is projected.
        x[2] = 0.;
        z[2] = 1.;
      }
    else
      {
        z = cross_product_3d(x, point(values, 2) - motion.shift);
        if (vanishes(z, scale * x.norm()))
          return false;
        z /= z.norm();
      }
    if (vanishes(x, scale))
      return false;
    x /= x.norm();
    const Tensor<1, 3> y = cross_product_3d(z, x);
    for (unsigned int c = 0; c < 3; ++c)
      {
        motion.rotation[c][0] = x[c];
        motion.rotation[c][1] = y[c];
        motion.rotation[c][2] = z[c];
      }
    return true;
  }


  bool
  instance_motion(const std::vector<double> &translation,
                  const std::vector<double> &turn,
                  RigidMotion               &motion)
  {
    motion       = {};
    motion.shift = point(translation, 0);
    if (turn.empty())
      return true;
    const Tensor<1, 3> a = point(turn, 0), b = point(turn, 1);
    Tensor<1, 3>       n = b - a;
    if (vanishes(n, std::max(a.norm(), b.norm())))
      return false;
    n /= n.norm();
    const double angle = turn.size() > 6 ? turn[6] * numbers::PI / 180. : 0.;
    const double c = std::cos(angle), s = std::sin(angle);
    // Rodrigues' formula.
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        motion.rotation[i][j] = (i == j ? c : 0.) + (1. - c) * n[i] * n[j];
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
        motion.rotation[j][k] -= s * n[i];
        motion.rotation[k][j] += s * n[i];
      }
    motion.shift = motion.rotation * (motion.shift - a) + a;
    return true;
  }
} // namespace Nacre::Abaqus
