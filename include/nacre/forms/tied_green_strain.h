// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_tied_green_strain_h
#define nacre_forms_tied_green_strain_h

#include <nacre/forms/node_vectors.h>
#include <nacre/mechanics/green_strain.h>

#include <deal.II/lac/full_matrix.h>

namespace Nacre
{
  /**
   * The Green strain E of GreenStrain, sampled at the tying points of a cell
   * and interpolated from there, and the forces that do work on it. With the
   * force n[q] at the points q and T the interpolation, E_q = T_q e,
   *
   *   sum_q n_q . dE_q(v) = sum_k n_k^ab phi,a . v,b,
   *
   * k the tying points and n_k what T^T makes of the forces n_q.
   *
   * The values that give the tying points are ShellCellValues or the side of an
   * edge, EdgeSideTying. Templated on the scalar, so that tests can take
   * complex steps.
   */
  template <typename Number>
  class TiedGreenStrain
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    /** The samples e after the displacement @p u of the nodes; no forces. */
    template <typename Values>
    void
    reinit(const Values &values, const NodeVectors<Number> &u)
    {
      const auto &tying = values.tying();
      tangents_.resize(tying.points().size());
      std::vector<Voigt<Number>> strains(tying.points().size());
      for (unsigned int k = 0; k < strains.size(); ++k)
        {
          const auto &frame = values.tying_frame(k);
          const auto  du = displacement_gradient(values.tying_shapes(), k, u);
          strains[k]     = GreenStrain::membrane(frame, du);
          for (unsigned int alpha = 0; alpha < 2; ++alpha)
            tangents_[k][alpha] = frame.a_cov[alpha] + du[alpha];
        }
      const auto &samples = tying.samples();
      samples_.assign(samples.size(), 0.);
      for (unsigned int s = 0; s < samples.size(); ++s)
        for (unsigned int v = 0; v < 3; ++v)
          samples_[s] += samples[s].direction[v] * strains[samples[s].point][v];
      sample_forces_.assign(samples.size(), 0.);
    }

    /**
     * Take the means of both ends of a step: E is quadratic in the
     * displacement, so that its difference is dE at the mean tangents.
     */
    void
    take_means(const TiedGreenStrain<Number> &start,
               const TiedGreenStrain<Number> &end)
    {
      tangents_ = start.tangents_;
      samples_  = start.samples_;
      for (unsigned int k = 0; k < tangents_.size(); ++k)
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          tangents_[k][alpha] =
            0.5 * (start.tangents_[k][alpha] + end.tangents_[k][alpha]);
      for (unsigned int s = 0; s < samples_.size(); ++s)
        samples_[s] = 0.5 * (start.samples_[s] + end.samples_[s]);
      sample_forces_.assign(samples_.size(), 0.);
    }

    /** E (length^2) at the point @p q. */
    Voigt<Number>
    strain(const MembraneTying &tying, const unsigned int q) const
    {
      Voigt<Number> strain;
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[s, weight] : tying.weights(q, v))
          strain[v] += weight * samples_[s];
      return strain;
    }

    /**
     * Add the work conjugate @p n of E at the point @p q, weight included;
     * set_resultants() follows the last one.
     */
    void
    add_point_force(const MembraneTying &tying,
                    const unsigned int   q,
                    const Voigt<Number> &n)
    {
      for (unsigned int v = 0; v < 3; ++v)
        for (const auto &[s, weight] : tying.weights(q, v))
          sample_forces_[s] += weight * n[v];
    }

    /** From the forces of the samples to those of the tying points. */
    void
    set_resultants(const MembraneTying &tying)
    {
      const auto &samples = tying.samples();
      forces_.assign(tying.points().size(), Voigt<Number>());
      for (unsigned int s = 0; s < samples.size(); ++s)
        for (unsigned int v = 0; v < 3; ++v)
          forces_[samples[s].point][v] +=
            samples[s].direction[v] * sample_forces_[s];
    }

    /** Add the force of each node. */
    void
    add_force(const ShapeTable &tying_shapes, NodeVectors<Number> &force) const
    {
      for (unsigned int k = 0; k < tangents_.size(); ++k)
        {
          // n^ab phi,a . v,b
          const auto  &n   = forces_[k];
          const auto  &phi = tangents_[k];
          const Vector g_1 = n[0] * phi[0] + n[2] * phi[1];
          const Vector g_2 = n[1] * phi[1] + n[2] * phi[0];
          for (unsigned int a = 0; a < force.size(); ++a)
            {
              const auto &dN = tying_shapes.gradient(k, a);
              force[a] += dN[0] * g_1 + dN[1] * g_2;
            }
        }
    }

    /** phi,1 and phi,2 at the tying point @p k. */
    const std::array<Vector, 2> &
    tangents(const unsigned int k) const
    {
      return tangents_[k];
    }

    /** n_k^ab at the tying point @p k, Voigt. */
    const Voigt<Number> &
    tying_force(const unsigned int k) const
    {
      return forces_[k];
    }

  private:
    /** By tying point. */
    std::vector<std::array<Vector, 2>> tangents_;
    std::vector<Voigt<Number>>         forces_;
    /** By sample. */
    std::vector<Number> samples_;
    std::vector<Number> sample_forces_;
  };

  /**
   * What a TiedGreenStrain contributes to tangents: the rows of the samples,
   * and the stiffness of the forces,
   *
   *   sum_q n_q . d2E_q(v, w) = sum_k n_k^ab v,a . w,b.
   */
  class TiedStrainTangent
  {
  public:
    /**
     * Fill the rows [sample][i] of de.
     * @param dof its column i of a node and a component
     */
    template <typename Dof>
    void
    fill_sample_rows(const MembraneTying           &tying,
                     const ShapeTable              &tying_shapes,
                     const TiedGreenStrain<double> &strain,
                     const Dof                     &dof)
    {
      const auto        &samples = tying.samples();
      const unsigned int n_nodes = tying_shapes.n_nodes();
      sample_rows_.reinit(samples.size(), spacedim * n_nodes, true);
      for (unsigned int s = 0; s < samples.size(); ++s)
        {
          // direction . dE(N e_c), dE = (A_1 N,1, A_2 N,2, A_1 N,2 + A_2 N,1)
          const auto &[k, direction]  = samples[s];
          const auto               &A = strain.tangents(k);
          const Tensor<1, spacedim> g_1 =
            direction[0] * A[0] + direction[2] * A[1];
          const Tensor<1, spacedim> g_2 =
            direction[2] * A[0] + direction[1] * A[1];
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const auto &dN = tying_shapes.gradient(k, a);
              for (unsigned int c = 0; c < spacedim; ++c)
                sample_rows_(s, dof(a, c)) = dN[0] * g_1[c] + dN[1] * g_2[c];
            }
        }
    }

    /** Add @p factor times dE_v at the point @p q to @p row [i]. */
    void
    add_strain_row(const MembraneTying &tying,
                   const unsigned int   q,
                   const unsigned int   v,
                   const double         factor,
                   double *const        row) const;

    /** The stiffness of a node with another, the same for all components. */
    const FullMatrix<double> &
    force_stiffness(const ShapeTable              &tying_shapes,
                    const TiedGreenStrain<double> &strain);

  private:
    FullMatrix<double> sample_rows_;
    /** [2 k + alpha][a]: N,alpha, and n^alpha beta N,beta. */
    FullMatrix<double> gradient_rows_;
    FullMatrix<double> force_rows_;
    FullMatrix<double> stiffness_;
  };
} // namespace Nacre

#endif
