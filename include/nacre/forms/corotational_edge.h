// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_corotational_edge_h
#define nacre_forms_corotational_edge_h

#include <nacre/forms/corotational_cell.h>
#include <nacre/forms/kinematics.h>
#include <nacre/forms/rotation_jump.h>

#include <complex>
#include <utility>

namespace Nacre
{
  /**
   * The conormal @p nu and the normal @p t0 of an edge after the prescribed
   * @p rotation: by its angle about the edge, which moves the conormal towards
   * the normal, then with the turn of the edge.
   */
  std::pair<Tensor<1, spacedim>, Tensor<1, spacedim>>
  prescribed_frame(const Tensor<1, spacedim> &nu,
                   const Tensor<1, spacedim> &t0,
                   const PrescribedRotation  &rotation);

  /**
   * the rotation-jump form in the frame that turns with the edge, at one point:
   * f = R K^e (R^T x - X0), (48) with the linear form's K^e.
   *
   * Interior edges: R = [d, b, t] [d0, b0, t_e]^T with d the unit tangent of
   * the deformed edge, t the normalised mean of the deformed normals (which
   * are orthogonal to d since the displacement is continuous along the edge),
   * b = t x d. Opposite orientation: the normal of K^+ enters with sigma.
   *
   * Prescribed rotation theta_bar: R is the rotation by theta_bar about the
   * edge that moves the conormal towards the normal, followed by the turn Q of
   * the edge under its prescribed displacements (follow_edge_turns(), 1 without
   * any) and by the smallest rotation that takes Q d0 to d. On a clamped edge
   * d = d0 and R is the prescribed rotation; the edge in a symmetry plane turns
   * within the plane, about the plane's normal, and so does R.
   *
   * With R t0 the turned normal of a side, lambda = dx/dnu and
   * mu = -H_m(nu, nu)^ab (x,ab - Gamma0^g_ab x,g) of the deformed positions,
   *
   * theta = R t0 . lambda,   m_nn = R t0 . mu + H_m(nu, nu)^ab phi0,ab . t0.
   *
   * Sections that couple membrane and bending add nu . B^T eps . nu to m_nn,
   * eps the tied strain of CorotationalMembrane, whose rotations are those of
   * the tying points; its share in the forces is not the business of this
   * class.
   */
  template <typename Number>
  class CorotationalEdgePoint
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    struct Side
    {
      /** Rows of theta and m_nn, sigma included. */
      JumpSide linear;
      /** phi,alpha and t0 = t of the side's cell. */
      SurfaceFrame<Number> deformed;
      /** R t0. */
      Vector normal;
      Vector lambda;
      Vector mu;
      /** Factor of theta in [[theta]] and of m_nn in {m_nn}. */
      double jump_factor;
      double mean_factor;
      /** d . omega = spin[g] (t . d(phi,g)) + that of the edge's tangent. */
      std::array<Number, 2> spin;
    };

    /** Of initial strains. */
    void
    set_instant(const Instant &instant)
    {
      instant_ = instant;
    }

    /**
     * Everything at the point @p q, for the displacements @p u of the nodes of
     * each side.
     * @param rotation not used for interior edges
     * @param membrane the strains of each side, for sections with coupling
     */
    void
    reinit(const ShellEdgeValues                             &edge,
           const unsigned int                                 q,
           const SectionLaw                                  &section,
           const double                                       penalty,
           const PrescribedRotation                          &rotation,
           const std::array<NodeVectors<Number>, 2>          &u,
           const std::array<CorotationalMembrane<Number>, 2> &membrane = {})
    {
      n_sides_   = edge.n_sides();
      nu_        = edge.conormal(0, q);
      d0_        = cross_product_3d(nu_, edge.frame(0, q).t0);
      stiffness_ = 0.;
      for (unsigned int s = 0; s < n_sides_; ++s)
        reinit_side(edge, s, q, section, u[s]);

      // d(x)/ds along the edge: phi,alpha times the components of d0.
      const auto  &frame = edge.frame(0, q);
      const Vector e = (d0_ * frame.a_con[0]) * sides_[0].deformed.a_cov[0] +
                       (d0_ * frame.a_con[1]) * sides_[0].deformed.a_cov[1];
      using std::sqrt;
      stretch_ = sqrt(Number(e * e));
      d_       = e / stretch_;
      if (n_sides_ == 2)
        rotate_with_mean_normal(edge, q);
      else
        rotate_as_prescribed(edge.frame(0, q).t0, rotation);

      jump_ = 0.;
      mean_ = 0.;
      for (unsigned int s = 0; s < n_sides_; ++s)
        {
          const Side &side = sides_[s];
          jump_ += side.jump_factor * (side.normal * side.lambda);
          mean_ += side.mean_factor *
                   (side.normal * side.mu + side.linear.curvature_moment);
          if (section.is_coupled())
            mean_ +=
              side.mean_factor * (side.linear.coupling *
                                  membrane[s].tied_strain(edge.tying(s), q));
        }
      mean_ -= mean_initial_moment(edge, q, section, instant_);
      fluxes_ = edge_fluxes(edge, q, stiffness_, penalty);
    }

    unsigned int
    n_sides() const
    {
      return n_sides_;
    }

    const Side &
    side(const unsigned int s) const
    {
      return sides_[s];
    }

    const EdgeFluxes &
    fluxes() const
    {
      return fluxes_;
    }

    /** d, and |dx/ds| of the edge. */
    const Vector &
    tangent() const
    {
      return d_;
    }

    const Number &
    stretch() const
    {
      return stretch_;
    }

    /** t and b = t x d of the deformed edge. */
    const Vector &
    normal() const
    {
      return t_;
    }

    const Vector &
    binormal() const
    {
      return b_;
    }

    /** t_e and b0 of the undeformed edge. */
    const Tensor<1, spacedim> &
    initial_normal() const
    {
      return t_e_;
    }

    const Tensor<1, spacedim> &
    initial_binormal() const
    {
      return b0_;
    }

    /**
     * Take the means of [[theta]] and {m_nn} of both ends of a step instead,
     * and the forces with them; the frames stay.
     */
    void
    take_mean_strains(const CorotationalEdgePoint<Number> &start,
                      const CorotationalEdgePoint<Number> &end)
    {
      jump_ = 0.5 * (start.jump_ + end.jump_);
      mean_ = 0.5 * (start.mean_ + end.mean_);
    }

    /** Undeformed d0. */
    const Tensor<1, spacedim> &
    initial_tangent() const
    {
      return d0_;
    }

    /** d . omega per rate of d, beyond the sides' spin. */
    const Vector &
    tangent_spin() const
    {
      return tangent_spin_;
    }

    /** Work conjugate of theta of the side @p s, weight included. */
    Number
    rotation_force(const unsigned int s) const
    {
      return sides_[s].jump_factor *
             (fluxes_.penalty * jump_ + fluxes_.consistency * mean_);
    }

    /** Work conjugate of m_nn of the side @p s, weight included. */
    Number
    moment_force(const unsigned int s) const
    {
      return sides_[s].mean_factor * fluxes_.symmetry * jump_;
    }

    /** Penalty and consistency energy (force times length). */
    Number
    energy() const
    {
      return 0.5 * fluxes_.penalty * jump_ * jump_ +
             0.5 * (fluxes_.consistency + fluxes_.symmetry) * mean_ * jump_;
    }

    /** Add the internal force of each node of the side @p s. */
    void
    add_force(const unsigned int s, NodeVectors<Number> &force) const
    {
      const auto  &linear = sides_[s].linear;
      const Number f      = rotation_force(s);
      const Number g      = moment_force(s);
      for (unsigned int a = 0; a < force.size(); ++a)
        force[a] +=
          (f * linear.rotation[a] + g * linear.moment[a]) * sides_[s].normal;
    }

    /** R applied to @p v. */
    Vector
    rotate(const Tensor<1, spacedim> &v) const
    {
      return (v * d0_) * d_ + (v * b0_) * b_ + (v * t_e_) * t_;
    }

  private:
    void
    reinit_side(const ShellEdgeValues     &edge,
                const unsigned int         s,
                const unsigned int         q,
                const SectionLaw          &section,
                const NodeVectors<Number> &u)
    {
      Side &side = sides_[s];
      side.linear.reinit(edge, s, q, section);
      const auto &a_cov = edge.frame(s, q).a_cov;
      const auto  du    = displacement_gradient(edge.shapes(s), q, u);
      side.deformed =
        make_surface_frame<Number>(a_cov[0] + du[0], a_cov[1] + du[1], {});
      side.jump_factor = s == 0 ? -1. : 1.; // plus - minus
      side.mean_factor = n_sides_ == 2 ? 0.5 : 1.;
      side.lambda      = edge.sigma(s, q) * edge.conormal(s, q);
      side.mu          = -side.linear.curvature_moment * side.linear.t0;
      for (unsigned int a = 0; a < u.size(); ++a)
        {
          side.lambda += side.linear.rotation[a] * u[a];
          side.mu += side.linear.moment[a] * u[a];
        }
      stiffness_ += (n_sides_ == 2 ? 0.5 : 1.) * side.linear.stiffness;
    }

    void
    rotate_with_mean_normal(const ShellEdgeValues &edge, const unsigned int q)
    {
      const double        sigma = edge.sigma(1, q);
      Tensor<1, spacedim> mean0 =
        sides_[0].linear.t0 + sigma * sides_[1].linear.t0;
      AssertThrow(mean0.norm() > 1e-8,
                  ExcMessage("Discretization/Kinematics: corotational: two "
                             "cells of the undeformed surface are folded onto "
                             "each other; the mean of their normals is zero."));
      t_e_              = mean0 / mean0.norm();
      b0_               = cross_product_3d(t_e_, d0_);
      const Vector mean = sides_[0].deformed.t0 + sigma * sides_[1].deformed.t0;
      using std::sqrt;
      const Number length = sqrt(Number(mean * mean));
      t_                  = mean / length;
      b_                  = cross_product_3d(t_, d_);
      for (unsigned int s = 0; s < 2; ++s)
        {
          // d . omega = -b . dt, dt^s = -phi^g (t^s . d(phi,g))
          for (unsigned int g = 0; g < 2; ++g)
            sides_[s].spin[g] = (s == 0 ? 1. : sigma) *
                                (b_ * sides_[s].deformed.a_con[g]) / length;
          sides_[s].normal = rotate(sides_[s].linear.t0);
        }
      tangent_spin_ = Vector();
    }

    void
    rotate_as_prescribed(const Tensor<1, spacedim> &t0,
                         const PrescribedRotation  &rotation)
    {
      const auto [p_b, p_t] = prescribed_frame(nu_, t0, rotation);
      b0_                   = nu_;
      t_e_                  = t0;
      const auto d          = rotation.turn * d0_;
      // Exactly opposite directions leave the axis open. An edge that has
      // turned by 180 degrees in a symmetry plane did so about its conormal.
      using std::real;
      const bool is_opposite = !(real(1. + d_ * d) > 1e-14);
      const auto axis        = rotation.turn * nu_;
      const auto turned      = [&](const Tensor<1, spacedim> &v) {
        return is_opposite ? 2. * (axis * v) * axis - v : v;
      };
      b_ = EdgeRotation::smallest<Number>(turned(d), d_, turned(p_b));
      t_ = EdgeRotation::smallest<Number>(turned(d), d_, turned(p_t));
      tangent_spin_    = EdgeRotation::smallest_spin(turned(d), d_);
      sides_[0].spin   = {{Number(0.), Number(0.)}};
      sides_[0].normal = t_;
    }

    unsigned int        n_sides_ = 0;
    std::array<Side, 2> sides_;
    EdgeFluxes          fluxes_;
    double              stiffness_ = 0.;
    Number              jump_      = 0.;
    Number              mean_      = 0.;

    /** The edge's frame before and after: R = [d, b, t] [d0, b0, t_e]^T. */
    Tensor<1, spacedim> nu_, d0_, b0_, t_e_;
    Vector              d_, b_, t_;
    Number              stretch_ = 0.;
    Vector              tangent_spin_;
    Instant             instant_;
  };

  /**
   * A bending moment per undeformed length that stays on the deformed edge:
   * l(v) = -int m t . dv/dnu ds0, with t the deformed normal and nu the unit
   * conormal of the deformed edge. The force of a node is g[1] N,1 + g[2] N,2.
   */
  template <typename Number>
  class FollowingMoment
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;

    /** At the point @p q of a boundary edge; @p moment in force. */
    void
    reinit(const ShellEdgeValues     &edge,
           const unsigned int         q,
           const double               moment,
           const NodeVectors<Number> &u)
    {
      const auto &frame = edge.frame(0, q);
      const auto  du    = displacement_gradient(edge.shapes(0), q, u);
      deformed_         = make_surface_frame<Number>(frame.a_cov[0] + du[0],
                                             frame.a_cov[1] + du[1],
                                             {});
      m_                = edge.JxW(q) * moment;
      const auto  d0    = cross_product_3d(edge.conormal(0, q), frame.t0);
      const auto &phi   = deformed_.a_cov;
      tau_              = {{d0 * frame.a_con[0], d0 * frame.a_con[1]}};
      e_                = tau_[0] * phi[0] + tau_[1] * phi[1];
      using std::sqrt;
      // nu = t x e / |e|, with t x phi,1 = j phi^2, t x phi,2 = -j phi^1
      scale_ = 1. / (deformed_.j0 * sqrt(Number(e_ * e_)));
      nu_    = {{-scale_ * (e_ * phi[1]), scale_ * (e_ * phi[0])}};
    }

    /** Add minus the load of each node, as a residual. */
    void
    add_force(const ShellEdgeValues &edge,
              const unsigned int     q,
              NodeVectors<Number>   &force) const
    {
      for (unsigned int a = 0; a < force.size(); ++a)
        {
          const auto &dN = edge.shapes(0).gradient(q, a);
          force[a] += (m_ * (nu_[0] * dN[0] + nu_[1] * dN[1])) * deformed_.t0;
        }
    }

    /** Derivative [alpha][g] of g[alpha], to be applied to d(phi,g). */
    std::array<std::array<Tensor<2, spacedim, Number>, 2>, 2>
    derivative() const
    {
      const auto  &phi     = deformed_.a_cov;
      const auto  &phi_con = deformed_.a_con;
      const auto  &t       = deformed_.t0;
      const Vector stretch = e_ / (e_ * e_);
      std::array<std::array<Tensor<2, spacedim, Number>, 2>, 2> X;
      for (unsigned int g = 0; g < 2; ++g)
        {
          // d(j |e|) / (j |e|)
          const Vector scale = phi_con[g] + tau_[g] * stretch;
          Vector       dnu_1 = (-scale_ * tau_[g]) * phi[1] - nu_[0] * scale;
          Vector       dnu_2 = (scale_ * tau_[g]) * phi[0] - nu_[1] * scale;
          (g == 0 ? dnu_2 : dnu_1) += (g == 0 ? 1. : -1.) * scale_ * e_;
          // dt = -phi^g (t . d(phi,g))
          X[0][g] = m_ * (outer_product(t, dnu_1) -
                          nu_[0] * outer_product(phi_con[g], t));
          X[1][g] = m_ * (outer_product(t, dnu_2) -
                          nu_[1] * outer_product(phi_con[g], t));
        }
      return X;
    }

  private:
    SurfaceFrame<Number>  deformed_;
    double                m_ = 0.;
    std::array<double, 2> tau_;
    Vector                e_;
    Number                scale_ = 0.;
    std::array<Number, 2> nu_;
  };
} // namespace Nacre

#endif
