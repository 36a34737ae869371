// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_law_h
#define nacre_mechanics_section_law_h

#include <nacre/mechanics/surface_frame.h>

namespace Nacre
{
  /** Stiffness of a section in the covariant basis, Voigt [resultant][strain]. */
  struct SectionStiffness
  {
    /** H_n: membrane forces n^ab from membrane strains. */
    VoigtMatrix<> membrane;
    /** H_m: moments m^ab from bending strains. */
    VoigtMatrix<> bending;
  };

  /**
   * The law of a section: how membrane forces and moments follow from strains.
   * To add one, derive from this class and hand it to ConvergenceStudy.
   */
  class SectionLaw
  {
  public:
    virtual ~SectionLaw() = default;

    /**
     * Evaluate the parameters' expressions and check them; throws ExcMessage
     * on values out of range.
     */
    virtual void
    prepare(const Constants &constants) = 0;

    /** Replace the thickness (length), for a study over thicknesses. */
    virtual void
    set_thickness(const double thickness) = 0;

    /**
     * The constants E, nu, h of the section as far as they are numbers, for
     * the expressions of loads and reference values.
     */
    virtual Constants
    named_constants() const = 0;

    /** Thickness (length) at @p point; throws if it isn't positive. */
    virtual double
    thickness(const Point<3> &point) const = 0;

    /** Mass per volume at @p point. */
    virtual double
    density(const Point<3> &point) const = 0;

    /** H_n and H_m, (8)-(10), at @p point with the surface's @p frame. */
    virtual SectionStiffness
    stiffness(const SurfaceFrame<> &frame, const Point<3> &point) const = 0;
  };
} // namespace Nacre

#endif
