// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/initially_strained_section.h>

#include <utility>

namespace Nacre
{
  InitiallyStrainedSection::InitiallyStrainedSection(
    std::shared_ptr<const SectionLaw> law,
    InitialStrains                    initial_strains)
    : law_(std::move(law))
    , initial_strains_(std::move(initial_strains))
    , laminate_(dynamic_cast<const LaminateSection *>(law_.get()))
  {}

  InitialForces
  InitiallyStrainedSection::initial_forces(const SurfaceFrame<> &frame,
                                           const SectionPoint   &point,
                                           const Instant        &instant) const
  {
    const auto initial = initial_strains_.at(frame, point, instant);
    const auto answer =
      law_->response(initial.membrane, initial.bending, frame, point);
    InitialForces result{answer.membrane_force, answer.moment};
    result.membrane_energy = 0.5 * (result.membrane_force * initial.membrane);
    result.bending_energy  = 0.5 * (result.moment * initial.bending);
    if (laminate_ == nullptr || !initial_strains_.has_temperature())
      return result;
    const InitialForces thermal =
      laminate_->thermal_forces(initial.temperature, frame, point);
    result.membrane_energy += thermal.membrane_energy +
                              thermal.membrane_force * initial.membrane +
                              thermal.moment * initial.bending;
    result.membrane_force += thermal.membrane_force;
    result.moment += thermal.moment;
    return result;
  }

  Voigt<>
  InitiallyStrainedSection::stress_at(const Instant        &instant,
                                      const Voigt<>        &membrane_strain,
                                      const Voigt<>        &bending_strain,
                                      const double          side,
                                      const SurfaceFrame<> &frame,
                                      const SectionPoint   &point,
                                      const SectionState & /*state*/) const
  {
    const auto initial = initial_strains_.at(frame, point, instant);
    const auto eps     = membrane_strain - initial.membrane;
    const auto rho     = bending_strain - initial.bending;
    return laminate_ != nullptr ?
             laminate_
               ->stress(eps, rho, side, frame, point, initial.temperature) :
             law_->stress(eps, rho, side, frame, point);
  }

  std::vector<LayerState>
  InitiallyStrainedSection::layers_at(const Instant        &instant,
                                      const Voigt<>        &membrane_strain,
                                      const Voigt<>        &bending_strain,
                                      const SurfaceFrame<> &frame,
                                      const SectionPoint   &point,
                                      const SectionState & /*state*/) const
  {
    if (laminate_ == nullptr)
      return {};
    const auto initial = initial_strains_.at(frame, point, instant);
    return laminate_->layers(membrane_strain - initial.membrane,
                             bending_strain - initial.bending,
                             frame,
                             point,
                             initial.temperature);
  }
} // namespace Nacre
