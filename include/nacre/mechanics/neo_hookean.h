// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_neo_hookean_h
#define nacre_mechanics_neo_hookean_h

#include <nacre/mechanics/plane_stress.h>
#include <nacre/mechanics/section_law.h>

namespace Nacre
{
  /**
   * The incompressible neo-Hookean material w = mu/2 (I1 - 3) in plane stress
   * (Holzapfel, Nonlinear Solid Mechanics, section 6.5; Kiendl et al. 2015).
   * With C = 1 + 2 e of the surface and the stretch normal to it,
   * lambda_3^2 = 1/det C,
   *   w = mu/2 (tr C + 1/det C - 3),   S = mu (1 - C^-1/det C) .
   */
  struct NeoHookean
  {
    static constexpr unsigned int                n_state_variables = 0;
    static constexpr std::array<const char *, 0> result_names{};

    /** mu (force/length^2). */
    double shear_modulus;

    /**
     * What answers the @p strain. No body has strains whose C isn't positive
     * definite: they are answered by numbers that are not (NaN), so that a step
     * which meets them fails and is repeated shorter.
     */
    PlaneStress
    response(const Voigt<> &strain,
             const TangentAxes & /*axes*/,
             const SectionState & /*state*/) const;

    double
    dissipated(const SectionState & /*state*/) const
    {
      return 0.;
    }

    void
    update(const Voigt<> & /*strain*/,
           const TangentAxes & /*axes*/,
           const ArrayView<double> & /*state*/) const
    {}
  };
} // namespace Nacre

#endif
