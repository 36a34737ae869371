// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_membrane_tying_h
#define nacre_discretization_membrane_tying_h

#include <nacre/problem/element.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

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
   *
   * What the strain is interpolated from are its coefficients: the samples, or,
   * where the strain is projected, sums of them. The functions that turn
   * samples into coefficients and back do nothing where both are the same.
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

    /** Samples, or coefficients, and their weights. */
    using Weights = std::vector<std::pair<unsigned int, double>>;

    /** @param targets where the strain is wanted, in the reference cell */
    MembraneTying(const Element                 &element,
                  const std::vector<Point<dim>> &targets);

    /** Not tied: all components are sampled at the targets themselves. */
    static MembraneTying
    untied(const std::vector<Point<dim>> &targets);

    /**
     * On a part of a cell that is cut: the L2 projection over the part of each
     * component onto the polynomials of the tied strain. These are Q_(p-1,p)
     * of e11, Q_(p,p-1) of e22, Q_(p-1,p-1) of 2 e12 on quadrilaterals, and
     * linear ones of each component on triangles. Interpolation from the whole
     * cell's points would not be consistent on a part. All components are
     * sampled at the rule's points x_k; the coefficients are
     *
     *   c_vj = sum_k phi_j(x_k) w_k e_v(x_k), sum_k w_k phi_i phi_j = delta,
     *
     * and e_v(target) = sum_j phi_j(target) c_vj.
     *
     * Polynomials that depend on the others at the points to 1e-11 are left
     * out.
     *
     * @param part         rule of the part, such as part_quadrature()
     * @param area_weights w_k > 0: the rule's weights times the area element
     * @param targets      where the strain is wanted, in the reference cell
     */
    static MembraneTying
    projected(const Element                 &element,
              const Quadrature<dim>         &part,
              const std::vector<double>     &area_weights,
              const std::vector<Point<dim>> &targets);

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

    unsigned int
    n_coefficients() const
    {
      return sums_.empty() ? samples_.size() : sums_.size();
    }

    /** From the samples' strains to the coefficients. */
    template <typename Number>
    void
    sum(std::vector<Number> &values) const
    {
      if (sums_.empty())
        return;
      std::vector<Number> sums(sums_.size(), Number(0.));
      for (unsigned int j = 0; j < sums.size(); ++j)
        for (const auto &[s, weight] : sums_[j])
          sums[j] += weight * values[s];
      values = std::move(sums);
    }

    /** The same of the rows of a matrix. */
    void
    sum_rows(FullMatrix<double> &rows) const;

    /** From the coefficients' forces to those of the samples: the transpose. */
    template <typename Number>
    void
    spread(std::vector<Number> &values) const
    {
      if (sums_.empty())
        return;
      std::vector<Number> shares(samples_.size(), Number(0.));
      for (unsigned int j = 0; j < sums_.size(); ++j)
        for (const auto &[s, weight] : sums_[j])
          shares[s] += weight * values[j];
      values = std::move(shares);
    }

    /** The same of the rows of a matrix. */
    void
    spread_rows(FullMatrix<double> &rows) const;

    /**
     * The coefficients that the Voigt component @p v at the target @p q
     * consists of.
     */
    const Weights &
    weights(const unsigned int q, const unsigned int v) const
    {
      return weights_[3 * q + v];
    }

  private:
    MembraneTying() = default;

    /**
     * Add the coefficients of the component @p v: values [function](point) of
     * orthonormal functions.
     */
    void
    add_functions(const unsigned int                 v,
                  const std::vector<double>         &area_weights,
                  const std::vector<Vector<double>> &at_points,
                  const std::vector<Vector<double>> &at_targets);

    void
    tie_quadrilateral(const unsigned int             degree,
                      const std::vector<Point<dim>> &targets);

    void
    tie_triangle(const std::vector<Point<dim>> &targets);

    std::vector<Point<dim>> points_;
    std::vector<Sample>     samples_;
    /** [coefficient]; empty: each sample is one. */
    std::vector<Weights> sums_;
    std::vector<Weights> weights_; // [3 target + component]
  };

  /** @p row, of rows.n() numbers, is the sum of weight times row of @p rows. */
  void
  combine(const FullMatrix<double>     &rows,
          const MembraneTying::Weights &weights,
          double                       *row);
} // namespace Nacre

#endif
