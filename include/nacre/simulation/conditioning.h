// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_conditioning_h
#define nacre_simulation_conditioning_h

#include <string>

namespace Nacre
{
  class Discretization;
  class SectionLaw;

  /**
   * What makes the stiffness matrix of a shell ill-conditioned, by its length
   * L, its thickness h and the sides a >= b of its cells.
   */
  struct Conditioning
  {
    /** The largest a / b of a cell. */
    double elongation = 1.;
    /** L / h. */
    double slenderness = 1.;

    /**
     * The likely cause, for a message: bending along and across a cell differs
     * by (a/b)^4, stretching and bending by (L/h)^2; the larger one is named
     * first.
     */
    std::string
    cause() const;
  };

  /** Collective. */
  Conditioning
  measure_conditioning(const Discretization &discretization,
                       const SectionLaw     &section);
} // namespace Nacre

#endif
