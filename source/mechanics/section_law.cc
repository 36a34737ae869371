// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/section_law.h>

namespace Nacre
{
  Voigt<>
  SectionLaw::stress(const Voigt<>        &membrane_strain,
                     const Voigt<>        &bending_strain,
                     const double          side,
                     const SurfaceFrame<> &frame,
                     const SectionPoint   &point) const
  {
    const double h    = thickness(point);
    const auto answer = response(membrane_strain, bending_strain, frame, point);
    return answer.membrane_force / h + 6. * side / (h * h) * answer.moment;
  }

  SectionResponse
  LinearSectionLaw::response(const Voigt<>        &membrane_strain,
                             const Voigt<>        &bending_strain,
                             const SurfaceFrame<> &frame,
                             const SectionPoint   &point) const
  {
    SectionResponse answer;
    answer.tangent        = stiffness(frame, point);
    answer.membrane_force = answer.tangent.membrane * membrane_strain;
    answer.moment         = answer.tangent.bending * bending_strain;
    if (is_coupled())
      {
        const VoigtMatrix<> &B = answer.tangent.coupling;
        answer.membrane_force += B * bending_strain;
        answer.moment += transpose(B) * membrane_strain;
      }
    answer.energy = 0.5 * (answer.membrane_force * membrane_strain +
                           answer.moment * bending_strain);
    return answer;
  }
} // namespace Nacre
