// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_tied_green_strain_h
#define nacre_forms_tied_green_strain_h

#include <nacre/forms/tied_samples.h>
#include <nacre/mechanics/green_strain.h>
#include <nacre/mechanics/strain_measure.h>

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
   * k the tying points and n_k what T^T makes of the forces n_q. Of
   * StrainMeasure::linear E is eps, and phi,a that of the undeformed surface.
   *
   * The values that give the tying points are ShellCellValues or the side of an
   * edge, EdgeSideTying. Templated on the scalar, so that tests can take
   * complex steps.
   */
  template <typename Number>
  class TiedGreenStrain : public TiedSamples<Number>
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    explicit TiedGreenStrain(const StrainMeasure measure = StrainMeasure::green)
      : measure_(measure)
    {}

    /** The strains e after the displacement @p u of the nodes; no forces. */
    template <typename Values>
    void
    reinit(const Values &values, const NodeVectors<Number> &u)
    {
      const auto &tying     = values.tying();
      const bool  is_linear = measure_ == StrainMeasure::linear;
      tangents_.resize(tying.points().size());
      std::vector<Voigt<Number>> strains(tying.points().size());
      for (unsigned int k = 0; k < strains.size(); ++k)
        {
          const auto &frame = values.tying_frame(k);
          const auto  du = displacement_gradient(values.tying_shapes(), k, u);
          strains[k] = is_linear ? ShellStrain::membrane(frame, du[0], du[1]) :
                                   GreenStrain::membrane(frame, du);
          for (unsigned int alpha = 0; alpha < 2; ++alpha)
            {
              tangents_[k][alpha] = frame.a_cov[alpha];
              if (!is_linear)
                tangents_[k][alpha] += du[alpha];
            }
        }
      this->set_strains(tying, strains);
      this->clear_forces();
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
      for (unsigned int k = 0; k < tangents_.size(); ++k)
        for (unsigned int alpha = 0; alpha < 2; ++alpha)
          tangents_[k][alpha] =
            0.5 * (start.tangents_[k][alpha] + end.tangents_[k][alpha]);
      this->set_mean_strains(start, end);
      this->clear_forces();
    }

    /** Add the force of each node. */
    void
    add_force(const ShapeTable &tying_shapes, NodeVectors<Number> &force) const
    {
      for (unsigned int k = 0; k < tangents_.size(); ++k)
        this->add_force_at(k, tangents_[k], tying_shapes, force);
    }

    StrainMeasure
    measure() const
    {
      return measure_;
    }

    /** The variations' basis phi,1, phi,2 at the tying point @p k. */
    const std::array<Vector, 2> &
    tangents(const unsigned int k) const
    {
      return tangents_[k];
    }

  private:
    StrainMeasure measure_;
    /** By tying point. */
    std::vector<std::array<Vector, 2>> tangents_;
  };

  /**
   * What a TiedGreenStrain contributes to tangents: the rows of the
   * coefficients, and the stiffness of the forces,
   *
   *   sum_q n_q . d2E_q(v, w) = sum_k n_k^ab v,a . w,b.
   */
  class TiedStrainTangent
  {
  public:
    /**
     * Fill the rows [coefficient][i] of de.
     * @param dof its column i of a node and a component
     */
    template <typename Dof>
    void
    fill_rows(const MembraneTying           &tying,
              const ShapeTable              &tying_shapes,
              const TiedGreenStrain<double> &strain,
              const Dof                     &dof)
    {
      const auto        &samples = tying.samples();
      const unsigned int n_nodes = tying_shapes.n_nodes();
      rows_.reinit(samples.size(), spacedim * n_nodes, true);
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
                rows_(s, dof(a, c)) = dN[0] * g_1[c] + dN[1] * g_2[c];
            }
        }
      tying.sum_rows(rows_);
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
    FullMatrix<double> rows_;
    /** [2 k + alpha][a]: N,alpha, and n^alpha beta N,beta. */
    FullMatrix<double> gradient_rows_;
    FullMatrix<double> force_rows_;
    FullMatrix<double> stiffness_;
  };
} // namespace Nacre

#endif
