// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_initially_strained_section_h
#define nacre_mechanics_initially_strained_section_h

#include <nacre/mechanics/initial_strain.h>
#include <nacre/mechanics/laminate_section.h>
#include <nacre/mechanics/section_law.h>

#include <memory>
#include <vector>

namespace Nacre
{
  /**
   * A section that has initial strains: it answers strains as its law does, and
   * has the initial forces that the law answers to the initial strains; plies
   * of a laminate expand with the temperature as well.
   */
  class InitiallyStrainedSection : public SectionLaw
  {
  public:
    /** Of a linear @p law. */
    InitiallyStrainedSection(std::shared_ptr<const SectionLaw> law,
                             InitialStrains                    initial_strains);

    double
    thickness(const SectionPoint &point) const override
    {
      return law_->thickness(point);
    }

    double
    density(const SectionPoint &point) const override
    {
      return law_->density(point);
    }

    using SectionLaw::response;

    SectionResponse
    response(const Voigt<>        &membrane_strain,
             const Voigt<>        &bending_strain,
             const SurfaceFrame<> &frame,
             const SectionPoint   &point,
             const SectionState   &state) const override
    {
      return law_->response(membrane_strain,
                            bending_strain,
                            frame,
                            point,
                            state);
    }

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override
    {
      return law_->stiffness(frame, point);
    }

    bool
    is_linear() const override
    {
      return law_->is_linear();
    }

    bool
    is_coupled() const override
    {
      return law_->is_coupled();
    }

    Voigt<>
    stress(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const double          side,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return law_->stress(membrane_strain, bending_strain, side, frame, point);
    }

    std::vector<LayerState>
    layers(const Voigt<>        &membrane_strain,
           const Voigt<>        &bending_strain,
           const SurfaceFrame<> &frame,
           const SectionPoint   &point) const override
    {
      return law_->layers(membrane_strain, bending_strain, frame, point);
    }

    unsigned int
    n_layers() const override
    {
      return law_->n_layers();
    }

    bool
    has_initial_strain() const override
    {
      return !initial_strains_.is_zero();
    }

    InitialForces
    initial_forces(const SurfaceFrame<> &frame,
                   const SectionPoint   &point,
                   const Instant        &instant) const override;

    Voigt<>
    stress_at(const Instant        &instant,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const double          side,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override;

    std::vector<LayerState>
    layers_at(const Instant        &instant,
              const Voigt<>        &membrane_strain,
              const Voigt<>        &bending_strain,
              const SurfaceFrame<> &frame,
              const SectionPoint   &point,
              const SectionState   &state) const override;

  private:
    std::shared_ptr<const SectionLaw> law_;
    InitialStrains                    initial_strains_;
    /** The law, if it is one of plies. */
    const LaminateSection *laminate_;
  };
} // namespace Nacre

#endif
