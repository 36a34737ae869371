// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_finite_edge_h
#define nacre_forms_finite_edge_h

#include <nacre/forms/corotational_edge.h>
#include <nacre/forms/finite_cell.h>
#include <nacre/forms/finite_edge_side.h>

namespace Nacre
{
  /**
   * The energy of an edge with exact finite rotations, at one point:
   *
   *   W = 1/2 eta^e D theta^2 - {lambda m_nn} theta,
   *
   * times length element and weight, doc/formulation.md (N.21). With the unit
   * tangent d of the deformed edge, the normals t^s of the sides (sigma
   * included, so that both turn alike) and the deformed conormals nu = t x d:
   *
   * - theta = alpha - alpha0 is the change of the angle
   *   alpha = atan2((t^- x t^+) . d, t^- . t^+) between the normals. Each of
   *   both angles is in (-pi, pi], which is the range of a crease whose cells
   *   don't penetrate each other: from a fold of the one side onto itself to
   *   that of the other. So theta is in (-2 pi, 2 pi), and jumps only where the
   *   surface passes through itself.
   * - m_nn = -(Y . t - Y0 . t0) + c : E, Y = h^ab phi,ab, h = D(nu0, nu0),
   *   c = B(nu0, nu0), is the moment nu0 . m . nu0 of m = B^T E + D kappa. E is
   *   the tied strain, since the displacements' own would bring membrane
   *   locking back through the edges; only sections that couple have it.
   *   A law that isn't linear answers m at E and kappa itself, with D and B its
   *   tangent there: dm_nn = -d(h^ab phi,ab . t) + c : dE with h and c held.
   *   hessian() leaves out what h and c change by, third derivatives of the
   *   energy w. D of the penalty is that at rest always.
   * - lambda = (j / j0) / |e|, e = dx/ds: the stretch across the edge, which is
   *   nu . phi,a nu0^a. The rotation's work conjugate is lambda m_nn.
   *
   * Prescribed rotation: t^+ is the normal t_bar of prescribed_frame(), turned
   * with the edge by the smallest rotation, alpha0 = 0 (the angle prescribed is
   * in t_bar), the mean is that of the one side, and the penalty twice as
   * large.
   *
   * StrainMeasure::linear: the variations below at the undeformed surface,
   * applied to the displacement, are theta and m_nn; lambda is one, and the
   * angle prescribed is added to theta.
   *
   * The variations are in terms of v_e = tau^g v,g (along the edge, per length
   * of the undeformed one), v_n = nu^g v,g (along nu, per deformed length) and
   * y = h^ab v,ab of each side; a^g (t . v,g) = d (t . v_e) / |e| +
   * nu (t . v_n). What E changes is the business of TiedGreenStrain: its work
   * conjugate is membrane_force().
   */
  template <typename Number>
  class FiniteEdgePoint
  {
  public:
    using Vector = Tensor<1, spacedim, Number>;
    using Matrix = Tensor<2, spacedim, Number>;

    using Side = FiniteEdgeSide<Number>;

    explicit FiniteEdgePoint(const StrainMeasure measure = StrainMeasure::green)
      : measure_(measure)
    {}

    /** Of initial strains. */
    void
    set_instant(const Instant &instant)
    {
      instant_ = instant;
    }

    /** Those of the points of both sides, for the edge to come. */
    void
    set_states(const std::array<SectionStates::Points, 2> &states)
    {
      states_ = states;
    }

    /**
     * Everything at the point @p q, for the displacements @p u of the nodes of
     * each side.
     * @param rotation not used for interior edges
     * @param membrane the strains of each side, for sections that couple; null
     *   for others, and where nobody asks for moments
     */
    void
    reinit(
      const ShellEdgeValues                              &edge,
      const unsigned int                                  q,
      const SectionLaw                                   &section,
      const double                                        penalty,
      const PrescribedRotation                           &rotation,
      const std::array<NodeVectors<Number>, 2>           &u,
      const std::array<TiedGreenStrain<Number>, 2> *const membrane = nullptr)
    {
      n_sides_         = edge.n_sides();
      double stiffness = 0.;
      for (unsigned int s = 0; s < n_sides_; ++s)
        {
          const TiedGreenStrain<Number> *const strain =
            membrane != nullptr ? &(*membrane)[s] : nullptr;
          stiffness += reinit_side(edge, s, q, section, u[s], strain);
        }
      fluxes_    = edge_fluxes(edge, q, stiffness, penalty);
      stiffness_ = stiffness;
      mean_      = 0.;
      for (unsigned int s = 0; s < n_sides_; ++s)
        mean_ += sides_[s].mean_factor * sides_[s].lambda * sides_[s].moment;
      if (has_linear_strains())
        set_linear_jump(rotation, u);
      else
        set_jump(edge, q, rotation);
    }

    const Side &
    side(const unsigned int s) const
    {
      return sides_[s];
    }

    unsigned int
    n_sides() const
    {
      return n_sides_;
    }

    /** theta (rad). */
    const Number &
    jump() const
    {
      return jump_;
    }

    /** {lambda m_nn} (force). */
    const Number &
    mean() const
    {
      return mean_;
    }

    /** D = {D(nu0, nu0, nu0, nu0)} (force times length). */
    double
    stiffness() const
    {
      return stiffness_;
    }

    /** alpha0 (rad). */
    double
    initial_angle() const
    {
      return initial_angle_;
    }

    /** t^+, or t_bar of a prescribed rotation. */
    const Vector &
    normal_plus() const
    {
      return n_sides_ == 2 ? sides_[1].normal : prescribed_normal_;
    }

    /**
     * Take the means of theta and {lambda m_nn} of both ends of a step instead,
     * and the forces with them; the frames stay.
     */
    void
    take_means(const FiniteEdgePoint<Number> &start,
               const FiniteEdgePoint<Number> &end)
    {
      jump_ = 0.5 * (start.jump_ + end.jump_);
      mean_ = 0.5 * (start.mean_ + end.mean_);
    }

    const EdgeFluxes &
    fluxes() const
    {
      return fluxes_;
    }

    /** W (force times length). */
    Number
    energy() const
    {
      return 0.5 * fluxes_.penalty * jump_ * jump_ +
             fluxes_.consistency * mean_ * jump_;
    }

    /** Work conjugate of theta, weight included (force times length). */
    Number
    rotation_force() const
    {
      return fluxes_.penalty * jump_ + fluxes_.consistency * mean_;
    }

    /** Work conjugate of lambda m_nn of the side @p s. */
    Number
    moment_force(const unsigned int s) const
    {
      return sides_[s].mean_factor * fluxes_.consistency * jump_;
    }

    /** Work conjugate of E of the side @p s, for sections that couple. */
    Voigt<Number>
    membrane_force(const unsigned int s) const
    {
      const Number factor = moment_force(s) * sides_[s].lambda;
      return Voigt<Number>(factor * sides_[s].coupling);
    }

    /** How theta changes with v_e, v_n and y of the side @p s. */
    std::array<Vector, 3>
    jump_gradient(const unsigned int s) const
    {
      const Side           &side = sides_[s];
      std::array<Vector, 3> gradient;
      gradient[1] = side.jump_factor * side.normal;
      if (n_sides_ == 1)
        gradient[0] = spin_ / side.length;
      return gradient;
    }

    /** How lambda m_nn changes with v_e, v_n and y of the side @p s. */
    std::array<Vector, 3>
    moment_gradient(const unsigned int s) const
    {
      const Side  &side = sides_[s];
      const Number stretch =
        has_linear_strains() ? Number(0.) : side.lambda * side.moment;
      return {
        {(side.lambda * (side.Y * side.tangent) / side.length) * side.normal,
         stretch * side.conormal +
           (side.lambda * (side.Y * side.conormal)) * side.normal,
         -side.lambda * side.normal}};
    }

    /** Add the internal force of each node of the side @p s. */
    void
    add_force(const unsigned int s, NodeVectors<Number> &force) const
    {
      const auto  &rows   = sides_[s].rows;
      const auto   jump   = jump_gradient(s);
      const auto   moment = moment_gradient(s);
      const Number f      = rotation_force();
      const Number g      = moment_force(s);
      const Vector G_e    = f * jump[0] + g * moment[0];
      const Vector G_n    = f * jump[1] + g * moment[1];
      const Vector G_y    = g * moment[2];
      for (unsigned int a = 0; a < force.size(); ++a)
        force[a] += rows[0][a] * G_e + rows[1][a] * G_n + rows[2][a] * G_y;
    }

    /** Second derivatives by v_e, v_n and y: [k][l], (y, y) is zero. */
    using Hessian = std::array<std::array<Matrix, 3>, 3>;

    /**
     * rotation_force() d2(theta) + moment_force() d2(lambda m_nn) of the side
     * @p s, less what the antisymmetric parts of both sides' d2(theta) have in
     * common: they cancel. Without the derivatives by E, which are
     * moment_force() (dlambda c : dE + c : dE dlambda + lambda c : d2E).
     *
     * An edge that has not yet reached its prescribed rotation, at the start of
     * a step, stands under the penalty's moment, many times the shell's; with
     * its stiffness Newton's method loses its way. @p limits_gap takes a
     * moment of the penalty of at most {lambda m_nn}, which changes nothing
     * near the solution.
     */
    Hessian
    hessian(const unsigned int s, const bool limits_gap = false) const
    {
      Hessian K;
      if (has_linear_strains())
        return K;
      Number force = rotation_force();
      if (limits_gap && n_sides_ == 1)
        {
          using std::abs;
          const double shell   = abs(fluxes_.consistency * mean_);
          const double penalty = abs(fluxes_.penalty * jump_);
          if (penalty > shell)
            force += (shell / penalty - 1.) * fluxes_.penalty * jump_;
        }
      add_rotation_hessian(s, force, K);
      add_moment_hessian(s, K);
      for (unsigned int k = 0; k < 2; ++k)
        {
          K[k][k] += transpose(K[k][k]);
          K[2][k] = transpose(K[k][2]);
        }
      K[1][0] = transpose(K[0][1]);
      return K;
    }

  private:
    bool
    has_linear_strains() const
    {
      return measure_ == StrainMeasure::linear;
    }

    /** alpha0 and theta, after the sides. */
    void
    set_jump(const ShellEdgeValues    &edge,
             const unsigned int        q,
             const PrescribedRotation &rotation)
    {
      const Vector &t = sides_[0].normal;
      const Vector &d = sides_[0].tangent;
      initial_angle_  = 0.;
      if (n_sides_ == 2)
        {
          const auto d0 =
            cross_product_3d(edge.conormal(0, q), edge.frame(0, q).t0);
          const auto &t0 = edge.frame(0, q).t0;
          const auto  t1 = edge.sigma(1, q) * edge.frame(1, q).t0;
          initial_angle_ = std::atan2(cross_product_3d(t0, t1) * d0, t0 * t1);
        }
      else
        turn_prescribed_normal(edge, q, rotation);
      jump_ = angle(t, normal_plus(), d) - initial_angle_;
    }

    /** theta of StrainMeasure::linear. */
    void
    set_linear_jump(const PrescribedRotation                 &rotation,
                    const std::array<NodeVectors<Number>, 2> &u)
    {
      spin_ = Vector();
      jump_ = n_sides_ == 1 ? rotation.angle : 0.;
      for (unsigned int s = 0; s < n_sides_; ++s)
        jump_ += sides_[s].variation(jump_gradient(s), u[s]);
    }

    /** Returns the share of the side in D. */
    double
    reinit_side(const ShellEdgeValues               &edge,
                const unsigned int                   s,
                const unsigned int                   q,
                const SectionLaw                    &section,
                const NodeVectors<Number>           &u,
                const TiedGreenStrain<Number> *const membrane)
    {
      Side         &side   = sides_[s];
      const auto   &frame  = edge.frame(s, q);
      const auto   &shapes = edge.shapes(s);
      const double  sigma  = edge.sigma(s, q);
      const bool    linear = section.is_linear();
      const auto    dyad   = ShellStrain::dyad_of(frame, edge.conormal(s, q));
      const Voigt<> H_nu   = ask_section(edge, s, q, section, u, membrane);
      const auto    d0 =
        cross_product_3d(edge.conormal(0, q), edge.frame(0, q).t0);
      side.tau         = {{d0 * frame.a_con[0], d0 * frame.a_con[1]}};
      side.jump_factor = s == 0 ? -1. : 1.; // plus - minus
      side.mean_factor = n_sides_ == 2 ? 0.5 : 1.;

      side.Y = Vector();
      for (unsigned int v = 0; v < 3; ++v)
        side.Y += (v < 2 ? 1. : 2.) * H_nu[v] * frame.a_cov_derivatives[v];
      using std::real;
      Tensor<1, spacedim> Y0;
      for (unsigned int c = 0; c < spacedim; ++c)
        Y0[c] = real(side.Y[c]);
      side.initial_moment = sigma * (Y0 * frame.t0);
      // The geometry of the variations
      const NodeVectors<Number>  none;
      const NodeVectors<Number> &moved = has_linear_strains() ? none : u;
      for (auto &row : side.rows)
        row.resize(u.size());
      for (unsigned int a = 0; a < u.size(); ++a)
        {
          const auto &ddN = shapes.hessian(q, a);
          side.rows[2][a] =
            H_nu[0] * ddN[0] + H_nu[1] * ddN[1] + 2. * H_nu[2] * ddN[2];
        }
      for (unsigned int a = 0; a < moved.size(); ++a)
        side.Y += side.rows[2][a] * moved[a];
      side.deform(frame, displacement_gradient(shapes, q, moved), sigma);
      const std::array<Number, 2> nu_con = {
        {side.conormal * side.deformed.a_con[0],
         side.conormal * side.deformed.a_con[1]}};
      for (unsigned int a = 0; a < u.size(); ++a)
        {
          const auto &dN  = shapes.gradient(q, a);
          side.rows[0][a] = side.tau[0] * dN[0] + side.tau[1] * dN[1];
          side.rows[1][a] = nu_con[0] * dN[0] + nu_con[1] * dN[1];
        }
      if (linear)
        side.moment = has_linear_strains() ?
                        side.variation(moment_gradient(s), u) :
                        side.initial_moment - side.Y * side.normal;
      if (linear && membrane != nullptr)
        side.moment += side.coupling * membrane->tied_strain(edge.tying(s), q);
      if (section.has_initial_strain())
        side.moment -= initial_moment(edge, s, q, section, instant_);
      const Voigt<> H_rest =
        linear ? H_nu :
                 section.stiffness(frame, edge.point(q, s)).bending * dyad;
      return side.mean_factor * (dyad * H_rest);
    }

    /**
     * Sets c of a side's point, and m_nn of laws that aren't linear, at the
     * strains of now. Returns h = D(nu0, nu0).
     */
    Voigt<>
    ask_section(const ShellEdgeValues               &edge,
                const unsigned int                   s,
                const unsigned int                   q,
                const SectionLaw                    &section,
                const NodeVectors<Number>           &u,
                const TiedGreenStrain<Number> *const membrane)
    {
      const auto   &frame = edge.frame(s, q);
      const auto    dyad  = ShellStrain::dyad_of(frame, edge.conormal(s, q));
      const double  sigma = edge.sigma(s, q);
      SectionBlocks blocks(section, frame, edge.point(q, s), 1., states_[s][q]);
      if (!section.is_linear())
        {
          Voigt<Number> E;
          if (membrane != nullptr)
            E = membrane->tied_strain(edge.tying(s), q);
          SurfaceFrame<Number> geometry;
          const auto           kappa =
            bending_strain(measure_, frame, edge.shapes(s), q, u, geometry);
          blocks.evaluate(E, kappa);
          sides_[s].moment = sigma * (dyad * blocks.moment(E, kappa));
        }
      if (blocks.is_coupled)
        sides_[s].coupling = sigma * (blocks.B * dyad);
      return blocks.D * dyad;
    }

    /** From @p t to @p t_plus about @p d. */
    static Number
    angle(const Vector &t, const Vector &t_plus, const Vector &d)
    {
      return angle_of<Number>(cross_product_3d(t, t_plus) * d, t * t_plus);
    }

    /**
     * t_bar, and its spin about d: d . omega = spin . dd under the smallest
     * rotation that takes the prescribed direction to d.
     */
    void
    turn_prescribed_normal(const ShellEdgeValues    &edge,
                           const unsigned int        q,
                           const PrescribedRotation &rotation)
    {
      const auto   &nu  = edge.conormal(0, q);
      const auto   &t0  = edge.frame(0, q).t0;
      const auto    p_t = prescribed_frame(nu, t0, rotation).second;
      const auto    c   = rotation.turn * cross_product_3d(nu, t0);
      const Vector &d   = sides_[0].tangent;
      // Exactly opposite directions leave the axis open. An edge that has
      // turned by 180 degrees in a symmetry plane did so about its conormal.
      using std::real;
      const bool is_opposite = !(real(Number(1. + d * c)) > 1e-14);
      const auto axis        = rotation.turn * nu;
      const auto turned      = [&](const Tensor<1, spacedim> &v) {
        return is_opposite ? 2. * (axis * v) * axis - v : v;
      };
      prescribed_tangent_ = turned(c);
      prescribed_normal_ =
        EdgeRotation::smallest<Number>(prescribed_tangent_, d, turned(p_t));
      spin_ = EdgeRotation::smallest_spin<Number>(prescribed_tangent_, d);
    }

    /**
     * Half of the diagonal blocks and K[0][1] of @p force d2(theta).
     * The angle of t has the variation t . v_n; its own second one is
     * -(nu . w_e) (t . v_e) / |e|^2 - T(v) . w_n - T(w) . v_n, the first term
     * of which is replaced by its symmetric part.
     */
    void
    add_rotation_hessian(const unsigned int s,
                         const Number      &force,
                         Hessian           &K) const
    {
      const Side   &side   = sides_[s];
      const Vector &t      = side.normal;
      const Vector &nu     = side.conormal;
      const Number  of_t   = side.jump_factor * force;
      const Number  length = side.length;
      K[0][0] -= (0.5 * of_t / (length * length)) * outer_product(t, nu);
      K[0][1] -= (of_t / length) * outer_product(t, side.tangent);
      K[1][1] -= of_t * outer_product(t, nu);
      if (n_sides_ == 2)
        return;
      // spin . v_e / |e| of t_bar, spin = d x c / (1 + d . c), dd = P w_e / |e|
      const Vector &d     = side.tangent;
      const Vector  c     = prescribed_tangent_;
      const Number  scale = 0.5 * force / (length * length);
      for (unsigned int i = 0; i < spacedim; ++i)
        {
          Vector dd = -d[i] * d;
          dd[i] += 1.;
          const Vector d_spin =
            (cross_product_3d(dd, c) - (c * dd) * spin_) / (1. + d * c);
          for (unsigned int k = 0; k < spacedim; ++k)
            K[0][0][k][i] += scale * (d_spin[k] - spin_[k] * d[i]);
        }
    }

    /**
     * Half of the diagonal blocks, K[0][1] and K[k][2] of moment_force()
     * d2(lambda m), m = -(Y . t - Y0 . t0) + c : E, E being held:
     *
     * dlambda = lambda nu . v_n,
     * d2lambda = lambda ((t . v_n)(t . w_n) - (nu . v_e)(nu . w_e) / |e|^2
     *            - ((nu . v_e)(d . w_n) + (nu . w_e)(d . v_n)) / |e|),
     * dm = -t . y + Y . T(v),
     * d2m = V(v) . T(w) + V(w) . T(v) + (Y . t) T(v) . T(w),
     *
     * V(v) = y - (Y . d) v_e / |e| - (Y . nu) v_n as in GreenStrain.
     */
    void
    add_moment_hessian(const unsigned int s, Hessian &K) const
    {
      const Side   &side = sides_[s];
      const Vector &t    = side.normal;
      const Vector &nu   = side.conormal;
      const Vector &d    = side.tangent;
      const Number  r    = 1. / side.length;
      const Number  g    = moment_force(s) * side.lambda;
      const Number  gm   = g * side.moment;
      const Number  Y_e  = (side.Y * d) * r;
      const Number  Y_n  = side.Y * nu;
      const Number  Y_t  = side.Y * t;
      const Matrix  tt   = outer_product(t, t);
      const Matrix  t_nu = outer_product(t, nu);
      const Matrix  t_d  = outer_product(t, d);
      // m d2lambda
      K[0][0] -= (0.5 * gm * r * r) * outer_product(nu, nu);
      K[0][1] -= (gm * r) * outer_product(nu, d);
      K[1][1] += (0.5 * gm) * tt;
      // dlambda dm + dm dlambda
      K[0][1] += (g * Y_e) * t_nu;
      K[1][1] += (g * Y_n) * t_nu;
      K[1][2] -= g * outer_product(nu, t);
      // d2m
      K[0][0] += g * ((0.5 * Y_t * r * r) * tt - (Y_e * r) * t_d);
      K[0][1] -= g * (Y_e * transpose(t_nu) + (Y_n * r) * t_d);
      K[1][1] += g * ((0.5 * Y_t) * tt - Y_n * t_nu);
      K[0][2] += (g * r) * t_d;
      K[1][2] += g * t_nu;
    }

    StrainMeasure       measure_;
    unsigned int        n_sides_ = 0;
    std::array<Side, 2> sides_;
    EdgeFluxes          fluxes_;
    double              stiffness_ = 0.;
    Instant             instant_;
    /** By side. */
    std::array<SectionStates::Points, 2> states_;
    Number                               jump_          = 0.;
    Number                               mean_          = 0.;
    double                               initial_angle_ = 0.;

    Tensor<1, spacedim> prescribed_tangent_;
    Vector              prescribed_normal_;
    Vector              spin_;
  };
} // namespace Nacre

#endif
