// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_rotation_jump_h
#define nacre_forms_rotation_jump_h

#include <nacre/discretization/shell_edge_values.h>
#include <nacre/mechanics/section_law.h>

namespace Nacre
{
  /**
   * The quantities of the rotation-jump form at one point of one side of an
   * edge, for the shape function of each node: a displacement N e_c has the
   * rotation rotation[a] * t0_c and the moment moment[a] * t0_c, to which
   * sections with
   * coupling add that of the membrane strain, membrane_moment[a][c].
   */
  struct JumpSide
  {
    /** theta = t0 . du/dnu of the shape functions, per t0 (1/length). */
    std::vector<double> rotation;
    /** m_nn = nu . D rho . nu of the shape functions, per t0. */
    std::vector<double> moment;
    /**
     * nu . B^T eps . nu of the shape functions times e_c, eps the tied
     * membrane strain: that of the displacements would bring membrane locking
     * back through the edges. Empty for sections without coupling.
     */
    std::vector<Tensor<1, spacedim>> membrane_moment;
    /** @name theta and m_nn of the tip functions */
    //@{
    std::vector<double> tip_rotation;
    std::vector<double> tip_moment;
    //@}
    /** sigma B nu nu: its product with eps is that moment. */
    Voigt<>             coupling;
    Tensor<1, spacedim> t0;
    /** D(nu, nu, nu, nu): bending stiffness across the edge. */
    double stiffness = 0.;
    /** D(nu, nu)^ab phi0,ab . t0, sigma included (force). */
    double curvature_moment = 0.;

    /**
     * Fill for the point @p q of the @p side of @p edge, sigma included.
     */
    void
    reinit(const ShellEdgeValues &edge,
           const unsigned int     side,
           const unsigned int     q,
           const SectionLaw      &section);

    /** m_nn of a displacement @p u of the node @p a alone. */
    double
    moment_of(const unsigned int a, const Tensor<1, spacedim> &u) const
    {
      const double bending = moment[a] * (t0 * u);
      return membrane_moment.empty() ? bending :
                                       bending + membrane_moment[a] * u;
    }

  private:
    /**
     * Set tip_rotation and tip_moment.
     * @param nu covariant components of the conormal
     * @param H_nu D nu nu
     */
    void
    fill_tip_functions(const ShellEdgeValues       &edge,
                       const unsigned int           side,
                       const unsigned int           q,
                       const std::array<double, 2> &nu,
                       const Voigt<>               &H_nu);

    /** Set membrane_moment from the rows of the tied membrane strain. */
    void
    fill_membrane_moment(const FullMatrix<double> &rows, const unsigned int q);
  };

  /**
   * m_nn (force), sigma included, that the section's initial strains take to be
   * held at the point @p q of the @p side of @p edge.
   */
  double
  initial_moment(const ShellEdgeValues &edge,
                 const unsigned int     side,
                 const unsigned int     q,
                 const SectionLaw      &section,
                 const Instant         &instant);

  /** The mean of both sides; on the boundary that of the one side. */
  double
  mean_initial_moment(const ShellEdgeValues &edge,
                      const unsigned int     q,
                      const SectionLaw      &section,
                      const Instant         &instant);

  /**
   * Factors of the three terms at an edge point, quadrature weight included:
   * penalty [[theta(u)]] [[theta(v)]] + symmetry {m_nn(v)} [[theta(u)]] +
   * consistency [[theta(v)]] {m_nn(u)}.
   */
  struct EdgeFluxes
  {
    double penalty;
    double symmetry;
    double consistency;
  };

  /**
   * Those of the point @p q.
   * @param stiffness D (force times length)
   * @param penalty eta^e (1/length)
   */
  EdgeFluxes
  edge_fluxes(const ShellEdgeValues &edge,
              const unsigned int     q,
              const double           stiffness,
              const double           penalty);

  /**
   * [[theta]], {m_nn} of all dofs of an edge and D at one point:
   * formulation.md section 3. On the boundary [[theta]] = -theta^- and {m_nn}
   * = m_nn^-, the mirror image's.
   */
  class RotationJump
  {
  public:
    void
    reinit(const ShellEdgeValues &edge,
           const unsigned int     q,
           const SectionLaw      &section);

    /** Rotation jump of each dof (1/length). */
    const std::vector<double> &
    rotation_jump() const
    {
      return rotation_jump_;
    }

    /** Mean normal moment of each dof (force/length). */
    const std::vector<double> &
    mean_moment() const
    {
      return mean_moment_;
    }

    /** D = {D(nu, nu, nu, nu)} (force times length). */
    double
    stiffness() const
    {
      return stiffness_;
    }

  private:
    JumpSide            side_;
    std::vector<double> rotation_jump_;
    std::vector<double> mean_moment_;
    double              stiffness_ = 0.;
  };
} // namespace Nacre

#endif
