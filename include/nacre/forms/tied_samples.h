// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_tied_samples_h
#define nacre_forms_tied_samples_h

#include <nacre/forms/node_vectors.h>

namespace Nacre
{
  /**
   * The coefficients e of a tied membrane strain, which are its samples or sums
   * of them, and the forces that do work on it. The strain at a point q of a
   * cell or an edge is T_q e (MembraneTying::weights); forces n[q] there are
   * f = sum_q T_q^T n[q] of the coefficients, and resultants n_k^ab of the
   * tying points k.
   */
  template <typename Number>
  class TiedSamples
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    /** The strain (length^2) at the point @p q, interpolated. */
    Voigt<Number>
    tied_strain(const MembraneTying &tying, const unsigned int q) const
    {
      Voigt<Number> strain;
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[s, weight] : tying.weights(q, v))
          strain[v] += weight * strains_[s];
      return strain;
    }

    /** Begin with no forces, for add_point_force(). */
    void
    clear_forces()
    {
      forces_.assign(strains_.size(), 0.);
    }

    /**
     * Add the membrane force @p n at the point @p q, area and weight included,
     * to those of the coefficients; set_resultants() follows the last one.
     */
    void
    add_point_force(const MembraneTying &tying,
                    const unsigned int   q,
                    const Voigt<Number> &n)
    {
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[s, weight] : tying.weights(q, v))
          forces_[s] += weight * n[v];
    }

    /**
     * From the forces of the coefficients to those of the samples and of the
     * tying points.
     */
    void
    set_resultants(const MembraneTying &tying)
    {
      const auto &samples = tying.samples();
      sample_forces_      = forces_;
      tying.spread(sample_forces_);
      resultants_.assign(tying.points().size(), Voigt<Number>());
      for (unsigned int s = 0; s < samples.size(); ++s)
        for (unsigned int v = 0; v < 3; ++v)
          resultants_[samples[s].point][v] +=
            samples[s].direction[v] * sample_forces_[s];
    }

    /** Work conjugate of the strain of the sample @p s. */
    const Number &
    sample_force(const unsigned int s) const
    {
      return sample_forces_[s];
    }

    /** Work conjugates n_k^ab of the strains of the tying point @p k, Voigt. */
    const Voigt<Number> &
    resultant(const unsigned int k) const
    {
      return resultants_[k];
    }

  protected:
    /** Take those of @p strain at the tying points. */
    void
    set_strains(const MembraneTying              &tying,
                const std::vector<Voigt<Number>> &strain)
    {
      const auto &samples = tying.samples();
      strains_.assign(samples.size(), 0.);
      for (unsigned int s = 0; s < samples.size(); ++s)
        for (unsigned int v = 0; v < 3; ++v)
          strains_[s] += samples[s].direction[v] * strain[samples[s].point][v];
      tying.sum(strains_);
    }

    /** Take the means of two states. */
    void
    set_mean_strains(const TiedSamples &start, const TiedSamples &end)
    {
      strains_.resize(start.strains_.size());
      for (unsigned int s = 0; s < strains_.size(); ++s)
        strains_[s] = 0.5 * (start.strains_[s] + end.strains_[s]);
    }

    /**
     * Add the nodes' forces of the tying point @p k, whose virtual strain is
     * a_(alpha . v,beta): n_k^ab a_a . v,b.
     */
    void
    add_force_at(const unsigned int           k,
                 const std::array<Vector, 2> &a,
                 const ShapeTable            &tying_shapes,
                 NodeVectors<Number>         &force) const
    {
      const auto  &n   = resultants_[k];
      const Vector g_1 = n[0] * a[0] + n[2] * a[1];
      const Vector g_2 = n[1] * a[1] + n[2] * a[0];
      for (unsigned int node = 0; node < force.size(); ++node)
        {
          const auto &dN = tying_shapes.gradient(k, node);
          force[node] += dN[0] * g_1 + dN[1] * g_2;
        }
    }

    /** By coefficient. */
    std::vector<Number> strains_;
    std::vector<Number> forces_;
    /** By sample. */
    std::vector<Number> sample_forces_;
    /** By tying point. */
    std::vector<Voigt<Number>> resultants_;
  };
} // namespace Nacre

#endif
