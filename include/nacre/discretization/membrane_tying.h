// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_membrane_tying_h
#define nacre_discretization_membrane_tying_h

#include <nacre/problem/element.h>

#include <array>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Tied membrane strains, the cure of membrane locking: covariant components
   * (e11, e22, 2 e12) are sampled at few points of the cell and interpolated
   * to the quadrature points. All of it lives on the reference cell: the same
   * numbers serve every cell, and any strain measure.
   *
   * Quadrilaterals (MITC9 for p = 2): e11 is sampled at p Gauss points along
   * xi1 times p + 1 along xi2, e22 the other way round, e12 at p x p points.
   *
   * Triangles (Regge): the linear tensor field with the strain's
   * tangential-tangential components at two Gauss points of each edge, which
   * are its moments against 1 and t, and the strain's mean components.
   */
  class MembraneTying
  {
  public:
    /** What is sampled: direction . (e11, e22, 2 e12) at a point. */
    struct Sample
    {
      unsigned int          point;
      std::array<double, 3> direction;
    };

    /** Sample and its weight. */
    using Weights = std::vector<std::pair<unsigned int, double>>;

    /** @param targets where the strain is wanted, in the reference cell */
    MembraneTying(const Element                 &element,
                  const std::vector<Point<dim>> &targets);

    /** Not tied: all components are sampled at the targets themselves. */
    static MembraneTying
    untied(const std::vector<Point<dim>> &targets);

    /** The sampling points in the reference cell. */
    const std::vector<Point<dim>> &
    points() const
    {
      return points_;
    }

    const std::vector<Sample> &
    samples() const
    {
      return samples_;
    }

    /** Of the Voigt component @p v at the target @p q. */
    const Weights &
    weights(const unsigned int q, const unsigned int v) const
    {
      return weights_[3 * q + v];
    }

  private:
    MembraneTying() = default;

    void
    tie_quadrilateral(const unsigned int             degree,
                      const std::vector<Point<dim>> &targets);

    void
    tie_triangle(const std::vector<Point<dim>> &targets);

    std::vector<Point<dim>> points_;
    std::vector<Sample>     samples_;
    std::vector<Weights>    weights_; // [3 target + component]
  };
} // namespace Nacre

#endif
