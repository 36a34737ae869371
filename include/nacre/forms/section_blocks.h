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
      return is_coupled ? A * membrane + B * bending : A * membrane;
    }

    /** m from E and kappa. */
    template <typename Number>
    Voigt<Number>
    moment(const Voigt<Number> &membrane, const Voigt<Number> &bending) const
    {
      return is_coupled ? transpose(B) * membrane + D * bending : D * bending;
    }

    VoigtMatrix<> A, B, D;
    /** Whether B isn't zero. */
    bool is_coupled = false;
  };
} // namespace Nacre

#endif
