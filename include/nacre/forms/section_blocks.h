// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_forms_section_blocks_h
#define nacre_forms_section_blocks_h

#include <nacre/mechanics/section_law.h>

namespace Nacre
{
  /**
   * A section at a point, as the finite-rotation forms use it: membrane forces
   * n = A E + B kappa and moments m = B^T E + D kappa, covariant basis of the
   * undeformed surface, Voigt order [resultant][strain].
   *
   * Nothing else in these forms knows how resultants follow from strains.
   */
  struct SectionBlocks
  {
    /** @param factor of all blocks: 1, or area times weight of a point */
    SectionBlocks(const SectionLaw     &section,
                  const SurfaceFrame<> &frame,
                  const SectionPoint   &point,
                  const double          factor = 1.)
    {
      const auto stiffness = section.stiffness(frame, point);
      A                    = factor * stiffness.membrane;
      B                    = factor * stiffness.coupling;
      D                    = factor * stiffness.bending;
      is_coupled           = section.is_coupled();
    }

    /** n from E and kappa. */
    template <typename Number>
    Voigt<Number>
    force(const Voigt<Number> &membrane, const Voigt<Number> &bending) const
    {
      Voigt<Number> n = A * membrane;
      if (is_coupled)
        n += B * bending;
      return subtract(n, initial.membrane_force);
    }

    /** m from E and kappa. */
    template <typename Number>
    Voigt<Number>
    moment(const Voigt<Number> &membrane, const Voigt<Number> &bending) const
    {
      Voigt<Number> m = D * bending;
      if (is_coupled)
        m += transpose(B) * membrane;
      return subtract(m, initial.moment);
    }

    VoigtMatrix<> A, B, D;
    /** Whether B isn't zero. */
    bool is_coupled = false;
    /** Of initial strains, with the factors of the blocks: zero at first. */
    InitialForces initial;

    /** What they add to 1/2 E : n and to 1/2 kappa : m. */
    std::array<double, 2>
    initial_energies(const Voigt<> &membrane, const Voigt<> &bending) const
    {
      return {
        {initial.membrane_energy - 0.5 * (initial.membrane_force * membrane),
         initial.bending_energy - 0.5 * (initial.moment * bending)}};
    }

  private:
    template <typename Number>
    static Voigt<Number>
    subtract(Voigt<Number> a, const Voigt<> &b)
    {
      for (unsigned int v = 0; v < 3; ++v)
        a[v] -= b[v];
      return a;
    }
  };
} // namespace Nacre

#endif
