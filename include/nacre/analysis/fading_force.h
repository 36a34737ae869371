// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_analysis_fading_force_h
#define nacre_analysis_fading_force_h

#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>

namespace Nacre
{
  /**
   * Dead forces of nodes that fall linearly to zero: what closed lips have
   * carried, from the moment of the cut on.
   */
  struct FadingForce
  {
    /** At the start (force), owned entries, zero on constrained dofs. */
    dealii::TrilinosWrappers::MPI::Vector force;
    double                                start = 0.;
    /** 0: there is no force. */
    double duration = 0.;

    /** The part of the force that is left at @p time. */
    double
    share(const double time) const
    {
      if (duration <= 0.)
        return 0.;
      const double left = 1. - (time - start) / duration;
      // What is less is round-off of the time.
      return left > 1e-9 ? std::min(left, 1.) : 0.;
    }
  };
} // namespace Nacre

#endif
