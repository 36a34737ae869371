// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_corotational_cell_h
#define nacre_forms_corotational_cell_h

#include <nacre/forms/cell_stiffness.h>
#include <nacre/forms/tied_samples.h>
#include <nacre/mechanics/corotational_strain.h>
#include <nacre/mechanics/step_differences.h>

#include <deal.II/lac/full_matrix.h>

namespace Nacre
{
  /** The frame after the displacement @p u of the nodes. */
  template <typename Number>
  SurfaceFrame<Number>
  deformed_frame(const SurfaceFrame<>      &frame,
                 const ShapeTable          &shapes,
                 const unsigned int         q,
                 const NodeVectors<Number> &u)
  {
    const auto du    = displacement_gradient(shapes, q, u);
    auto       ddphi = displacement_hessian(shapes, q, u);
    for (unsigned int v = 0; v < 3; ++v)
      ddphi[v] += frame.a_cov_derivatives[v];
    return make_surface_frame<Number>(frame.a_cov[0] + du[0],
                                      frame.a_cov[1] + du[1],
                                      ddphi);
  }

  /**
   * The membrane part of the co-rotational cell, (46)-(48): the membrane
   * strain of R^T phi - phi0 is sampled at the tying points, each with a polar
   * rotation of its own; the energy is 1/2 e . M . e of the coefficients e, to
   * which sections with coupling add half of eps : B : rho.
   *
   * The values that give the tying points are ShellCellValues or the side of an
   * edge, EdgeSideTying.
   *
   * Templated on the scalar, so that tests can take complex steps.
   */
  template <typename Number>
  class CorotationalMembrane : public TiedSamples<Number>
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    /** @param stiffness M (force times length), from membrane_stiffness() */
    void
    reinit(const ShellCellValues     &values,
           const FullMatrix<double>  &stiffness,
           const NodeVectors<Number> &u)
    {
      reinit_strains(values, u);
      set_forces(values.tying(), stiffness);
    }

    /** The strains without the forces. */
    template <typename Values>
    void
    reinit_strains(const Values &values, const NodeVectors<Number> &u)
    {
      const auto &tying = values.tying();
      deformed_.resize(tying.points().size());
      polar_.resize(tying.points().size());
      std::vector<Voigt<Number>> strain(tying.points().size());
      for (unsigned int k = 0; k < strain.size(); ++k)
        {
          const auto &frame = values.tying_frame(k);
          const auto  du = displacement_gradient(values.tying_shapes(), k, u);
          deformed_[k]   = make_surface_frame<Number>(frame.a_cov[0] + du[0],
                                                    frame.a_cov[1] + du[1],
                                                    {});
          polar_[k]      = make_polar_rotation(frame, deformed_[k]);
          strain[k] =
            CorotationalStrain::membrane(frame, deformed_[k], polar_[k]);
        }
      this->set_strains(tying, strain);
    }

    /**
     * The force of a node is N,alpha g_alpha, g_alpha = N^alpha beta q_beta,
     * summed over the tying points: the part of dg_alpha at the point @p k that
     * comes from dq_beta, [alpha][g], to be applied to d(phi,g).
     */
    std::array<std::array<Tensor<2, spacedim, Number>, 2>, 2>
    turn_derivative(const unsigned int k) const
    {
      const auto  &n       = this->resultants_[k];
      const auto  &t       = deformed_[k].t0;
      const Number N[2][2] = {{n[0], n[2]}, {n[2], n[1]}};
      std::array<std::array<Tensor<2, spacedim, Number>, 2>, 2> X;
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        {
          const Vector r =
            N[alpha][0] * polar_[k].q_cov[0] + N[alpha][1] * polar_[k].q_cov[1];
          for (unsigned int g = 0; g < 2; ++g)
            X[alpha][g] =
              (r * deformed_[k].a_con[g]) * outer_product(t, t) +
              outer_product(cross_product_3d(t, r), polar_[k].spin[g]);
        }
      return X;
    }

    /**
     * Take the means of the strains of both ends of a step instead, and the
     * resultants with them; frames and rotations stay.
     */
    void
    take_mean_strains(const ShellCellValues              &values,
                      const FullMatrix<double>           &stiffness,
                      const CorotationalMembrane<Number> &start,
                      const CorotationalMembrane<Number> &end)
    {
      this->set_mean_strains(start, end);
      set_forces(values.tying(), stiffness);
    }

    /** Less the forces that initial strains hold at the points. */
    void
    subtract(const MembraneTying &tying, const std::vector<InitialForces> &held)
    {
      for (unsigned int q = 0; q < held.size(); ++q)
        this->add_point_force(tying,
                              q,
                              Voigt<Number>(-1. * held[q].membrane_force));
      this->set_resultants(tying);
    }

    /** 1/2 e . M . e (force times length). */
    Number
    energy() const
    {
      Number sum = 0.;
      for (unsigned int s = 0; s < this->strains_.size(); ++s)
        sum += 0.5 * this->strains_[s] * this->forces_[s];
      return sum;
    }

    /**
     * Add the internal force of each node, R B^T D B (R^T x - X0), (48).
     */
    void
    add_force(const ShellCellValues &values, NodeVectors<Number> &force) const
    {
      // The virtual strain R phi0,(a . v,b) has R frozen.
      for (unsigned int k = 0; k < polar_.size(); ++k)
        this->add_force_at(k, polar_[k].q_cov, values.tying_shapes(), force);
    }

    /** a_cov = phi,alpha and t0 = t at the tying point @p k. */
    const SurfaceFrame<Number> &
    deformed(const unsigned int k) const
    {
      return deformed_[k];
    }

    const PolarRotation<Number> &
    polar(const unsigned int k) const
    {
      return polar_[k];
    }

    /**
     * The vectors of which v,1 and v,2 make the virtual strain @p direction .
     * (q_1 . v,1, q_2 . v,2, q_1 . v,2 + q_2 . v,1) at the tying point @p k,
     * with the rotation held.
     */
    std::array<Vector, 2>
    sample_vectors(const std::array<double, 3> &direction,
                   const unsigned int           k) const
    {
      return combine(direction, polar_[k].q_cov);
    }

    /** Those of the strain's derivative: dq_alpha = (t . omega) t x q_alpha. */
    std::array<Vector, 2>
    sample_derivatives(const std::array<double, 3> &direction,
                       const unsigned int           k) const
    {
      const auto  &polar  = polar_[k];
      const auto  &phi    = deformed_[k];
      const Vector q_1    = cross_product_3d(phi.t0, polar.q_cov[0]);
      const Vector q_2    = cross_product_3d(phi.t0, polar.q_cov[1]);
      const auto   turned = combine(direction, {{q_1, q_2}});
      const Number spin_strain =
        turned[0] * phi.a_cov[0] + turned[1] * phi.a_cov[1];
      auto vectors = combine(direction, polar.q_cov);
      for (unsigned int g = 0; g < 2; ++g)
        vectors[g] += spin_strain * polar.spin[g];
      return vectors;
    }

  private:
    static std::array<Vector, 2>
    combine(const std::array<double, 3> &direction,
            const std::array<Vector, 2> &q)
    {
      return {{direction[0] * q[0] + direction[2] * q[1],
               direction[1] * q[1] + direction[2] * q[0]}};
    }

    void
    set_forces(const MembraneTying &tying, const FullMatrix<double> &stiffness)
    {
      this->clear_forces();
      for (unsigned int s = 0; s < stiffness.m(); ++s)
        for (unsigned int r = 0; r < stiffness.n(); ++r)
          this->forces_[s] += stiffness(s, r) * this->strains_[r];
      this->set_resultants(tying);
    }

    /** By tying point. */
    std::vector<SurfaceFrame<Number>>  deformed_;
    std::vector<PolarRotation<Number>> polar_;
  };

  /** The tying points of a side of an edge, for CorotationalMembrane. */
  class EdgeSideTying
  {
  public:
    EdgeSideTying(const ShellEdgeValues &edge, const unsigned int side)
      : edge_(edge)
      , side_(side)
    {}

    const MembraneTying &
    tying() const
    {
      return edge_.tying(side_);
    }

    const ShapeTable &
    tying_shapes() const
    {
      return edge_.tying_shapes(side_);
    }

    const SurfaceFrame<> &
    tying_frame(const unsigned int k) const
    {
      return edge_.tying_frames(side_)[k];
    }

  private:
    const ShellEdgeValues &edge_;
    const unsigned int     side_;
  };

  /**
   * The bending part of the co-rotational cell: the strain is the exact change
   * of curvature, its virtual counterpart -(v,ab - Gamma0^g_ab v,g) . t.
   */
  template <typename Number>
  class CorotationalBending
  {
  public:
    /** @param stiffness H_m times area and weight at each point */
    void
    reinit(const ShellCellValues            &values,
           const std::vector<VoigtMatrix<>> &stiffness,
           const NodeVectors<Number>        &u)
    {
      deformed_.resize(values.n_points());
      strains_.resize(values.n_points());
      moments_.resize(values.n_points());
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          deformed_[q] = deformed_frame(values.frame(q), values.shapes(), q, u);
          strains_[q] =
            CorotationalStrain::bending(values.frame(q), deformed_[q]);
          moments_[q] = stiffness[q] * strains_[q];
        }
    }

    /**
     * Add the part B^T eps of the moments, and B rho to the membrane forces of
     * @p membrane, which has the strains eps of the same points.
     * @param coupling B times area and weight at each point
     */
    void
    couple(const MembraneTying              &tying,
           const std::vector<VoigtMatrix<>> &coupling,
           CorotationalMembrane<Number>     &membrane)
    {
      for (unsigned int q = 0; q < moments_.size(); ++q)
        {
          membrane.add_point_force(tying, q, coupling[q] * strains_[q]);
          moments_[q] +=
            transpose(coupling[q]) * membrane.tied_strain(tying, q);
        }
      membrane.set_resultants(tying);
    }

    /** Less the moments that initial strains hold at the points. */
    void
    subtract(const std::vector<InitialForces> &held)
    {
      for (unsigned int q = 0; q < held.size(); ++q)
        moments_[q] -= held[q].moment;
    }

    /**
     * Take the means over a step from @p start to @p end: StepDifferences'
     * frames, strains and moments.
     */
    void
    take_means(const CorotationalBending<Number> &start,
               const CorotationalBending<Number> &end)
    {
      deformed_.resize(start.deformed_.size());
      strains_.resize(deformed_.size());
      moments_.resize(deformed_.size());
      for (unsigned int q = 0; q < deformed_.size(); ++q)
        {
          deformed_[q] =
            StepDifferences::mean_frame(start.deformed_[q], end.deformed_[q]);
          strains_[q] = 0.5 * (start.strains_[q] + end.strains_[q]);
          moments_[q] = 0.5 * (start.moments_[q] + end.moments_[q]);
        }
    }

    /** Force times length. */
    Number
    energy() const
    {
      Number sum = 0.;
      for (unsigned int q = 0; q < strains_.size(); ++q)
        sum += 0.5 * (strains_[q] * moments_[q]);
      return sum;
    }

    /** Add the internal force of each node, (48). */
    void
    add_force(const ShellCellValues &values, NodeVectors<Number> &force) const
    {
      for (unsigned int q = 0; q < moments_.size(); ++q)
        for (unsigned int a = 0; a < force.size(); ++a)
          {
            const Voigt<> strain = ShellStrain::bending_of_shape_function(
              values.frame(q),
              values.shapes().gradient(q, a),
              values.shapes().hessian(q, a));
            force[a] += (strain * moments_[q]) * deformed_[q].t0;
          }
    }

    /** phi,alpha, their derivatives and t0 = t at the point @p q. */
    const SurfaceFrame<Number> &
    deformed(const unsigned int q) const
    {
      return deformed_[q];
    }

    const Voigt<Number> &
    strain(const unsigned int q) const
    {
      return strains_[q];
    }

    /** m^ab times area and weight, Voigt. */
    const Voigt<Number> &
    moment(const unsigned int q) const
    {
      return moments_[q];
    }

  private:
    std::vector<SurfaceFrame<Number>> deformed_;
    std::vector<Voigt<Number>>        strains_;
    std::vector<Voigt<Number>>        moments_;
  };

  /**
   * M of the coefficients: sum_q of their interpolation to the points,
   * times H_n with area and weight there, @p stiffness.
   */
  FullMatrix<double>
  membrane_stiffness(const ShellCellValues            &values,
                     const std::vector<VoigtMatrix<>> &stiffness);
} // namespace Nacre

#endif
