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
  SectionAt::response(const Voigt<>        &membrane_strain,
                      const Voigt<>        &bending_strain,
                      const SurfaceFrame<> &frame,
                      const SectionPoint   &point,
                      const SectionState   &state) const
  {
    SectionResponse answer =
      law.response(membrane_strain, bending_strain, frame, point, state);
    if (!law.has_initial_strain())
      return answer;
    const InitialForces held = law.initial_forces(frame, point, instant);
    answer.membrane_force -= held.membrane_force;
    answer.moment -= held.moment;
    answer.energy += held.membrane_energy + held.bending_energy -
                     held.membrane_force * membrane_strain -
                     held.moment * bending_strain;
    return answer;
  }

  SectionResponse
  LinearSectionLaw::response(const Voigt<>        &membrane_strain,
                             const Voigt<>        &bending_strain,
                             const SurfaceFrame<> &frame,
                             const SectionPoint   &point,
                             const SectionState & /*state*/) const
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
