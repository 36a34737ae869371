// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_averaged_normal_kinematics_h
#define nacre_forms_averaged_normal_kinematics_h

#include <nacre/forms/linear_kinematics.h>

namespace Nacre
{
  /**
   * [[Delta t~]] and the moments m~ of all dofs of an interior edge at one
   * point, in the edge's frame of the averaged normal: Kaufmann et al.
   * (34)-(45). Matrices are [Voigt component][dof].
   */
  class AveragedNormalPoint
  {
  public:
    /** Throws if the two cells are folded onto each other. */
    void
    reinit(const ShellEdgeValues &edge,
           const unsigned int     q,
           const SectionLaw      &section,
           const Instant         &instant);

    /** N^ [[Delta t~]], (37) and (38), Voigt as strains (1/length). */
    const FullMatrix<double> &
    normal_jump() const
    {
      return normal_jump_;
    }

    /** {m~} = {H_m p rho}, Voigt as resultants (force/length). */
    const FullMatrix<double> &
    mean_moment() const
    {
      return mean_moment_;
    }

    /**
     * Those that initial strains hold, which {m~} counts too much: their
     * contravariant components in the edge's basis, p^-T m0.
     */
    const Voigt<> &
    initial_moment() const
    {
      return initial_moment_;
    }

    /** {H_m} in the edge's basis, as (41). */
    const VoigtMatrix<> &
    stiffness() const
    {
      return stiffness_;
    }

  private:
    /** Add the part of the @p side, at the point @p q. */
    void
    add_side(const ShellEdgeValues &edge,
             const unsigned int     side,
             const unsigned int     q,
             const SectionLaw      &section,
             const Instant         &instant,
             const SurfaceFrame<>  &edge_frame);

    FullMatrix<double> normal_jump_;
    FullMatrix<double> mean_moment_;
    Voigt<>            initial_moment_;
    VoigtMatrix<>      stiffness_;
  };

  /**
   * Small displacements with the report's own edge terms (14), (37), in Voigt
   * notation and with the frame of the averaged normal:
   *
   * a^e(u,v) = int eta^e [[Delta t~(v)]] : H_m : [[Delta t~(u)]]   penalty
   *            + {m~(v)} [[Delta t~(u)]]                           symmetry
   *            + [[Delta t~(v)]] {m~(u)} ds                        consistency
   *
   * For continuous displacements it is the rotation-jump form of
   * LinearKinematics where the surface has a tangent plane; at a crease it
   * depends on the angle, and the rotation-jump form is to be preferred.
   *
   * On the boundary the edge's frame is that of the cell, so that the rotation
   * about the edge has the terms of the rotation-jump form. The report has no
   * boundary terms; the rotation along a clamped edge follows from its
   * displacements.
   */
  class AveragedNormalKinematics : public LinearKinematics
  {
  public:
    using LinearKinematics::LinearKinematics;

    std::unique_ptr<Kinematics>
    clone() const override;

    void
    add_edge_terms(const ShellEdgeValues &edge,
                   const double           penalty,
                   const Vector<double>  &u,
                   LocalTerms            &terms) override;

  private:
    /** Rows whose product is the tangent of the point of point_. */
    void
    fill_rows(const unsigned int q, const double penalty, const double dx);

    void
    add_point_residual(const double          penalty,
                       const double          dx,
                       const Vector<double> &u,
                       LocalTerms           &terms) const;

    AveragedNormalPoint point_;
    FullMatrix<double>  normal_test_rows_;
    FullMatrix<double>  normal_trial_rows_;
  };
} // namespace Nacre

#endif
