// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_j2_plasticity_h
#define nacre_mechanics_j2_plasticity_h

#include <nacre/mechanics/plane_stress.h>
#include <nacre/mechanics/section_law.h>

namespace Nacre
{
  /**
   * Isotropic elasticity with the yield condition of von Mises and isotropic
   * linear hardening, in plane stress and for small strains:
   *   s = C (e - e_p),   s_eq <= s_y + H a,   s_eq^2 = 3/2 s . P s,
   * with the accumulated plastic strain a. A step is integrated by Euler's
   * backward method, with its consistent tangent: J. C. Simo, R. L. Taylor, A
   * return mapping algorithm for plane stress elastoplasticity, International
   * Journal for Numerical Methods in Engineering 22 (1986) 649; Simo & Hughes,
   * Computational Inelasticity, section 3.4.
   *
   * The state of a point, in Cartesian components so that it depends on no
   * basis: a, then e_p in the order of SymmetricTensor, 11, 22, 33, 12, 13, 23.
   */
  struct J2Plasticity
  {
    static constexpr unsigned int n_state_variables = 7;

    /** What users see of a state: the first of its numbers. */
    static constexpr std::array<const char *, 1> result_names{
      {"accumulated plastic strain"}};

    /** E (force/length^2). */
    double youngs_modulus;
    double poissons_ratio;
    /** s_y (force/length^2), positive. */
    double yield_stress;
    /** H = ds_y/da (force/length^2), not negative. */
    double hardening;

    /**
     * What answers the @p strain at the end of a step that begins in @p state.
     * The energy is the elastic one and the plastic work,
     *   w = 1/2 s : (e - e_p) + s_y a + 1/2 H a^2,
     * whose derivative is the stress: backward Euler minimises w over the
     * plastic strains that follow from the state at the start (Ortiz &
     * Stainier 1999).
     */
    PlaneStress
    response(const Voigt<>      &strain,
             const TangentAxes  &axes,
             const SectionState &state) const;

    /** s_y a, what of w has been dissipated in a state (force/length^2). */
    double
    dissipated(const SectionState &state) const
    {
      return state.size() > 0 ? yield_stress * state[0] : 0.;
    }

    /** Replace @p state by that of the end of the step. */
    void
    update(const Voigt<>           &strain,
           const TangentAxes       &axes,
           const ArrayView<double> &state) const;

  private:
    /** Where the stress comes to lie, and what that takes. */
    struct Return
    {
      Voigt<> stress, plastic_strain;
      /** a at the end. */
      double accumulated;
      /** Delta gamma of e_p = e_p + Delta gamma P s (1/stress); 0: elastic. */
      double multiplier;
    };

    Return
    return_mapping(const Voigt<>      &strain,
                   const TangentAxes  &axes,
                   const SectionState &state) const;

    /** Delta gamma of the trial stress @p trial, or 0; @p limit: s_y + H a. */
    double
    plastic_multiplier(const Voigt<> &trial, const double limit) const;

    /** [C^-1 + @p multiplier P]^-1. */
    VoigtMatrix<>
    algorithmic_stiffness(const double multiplier) const;

    /** dsigma/de after a step with the @p multiplier to @p stress. */
    VoigtMatrix<>
    tangent(const Voigt<> &stress, const double multiplier) const;
  };
} // namespace Nacre

#endif
