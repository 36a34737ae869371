// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_elastoplastic_section_h
#define nacre_mechanics_elastoplastic_section_h

#include <nacre/mechanics/integrated_section.h>
#include <nacre/mechanics/j2_plasticity.h>

namespace Nacre
{
  /**
   * A section of J2Plasticity with the elastic constants of an isotropic
   * section, by Simpson's rule through the thickness. With 5, 9, 13, ... points
   * the rule takes the moment s_y h^2/4 of the section that yields all through
   * exactly, and elastic sections too.
   */
  class ElastoplasticSection
    : public IntegratedSection<J2Plasticity>
    , public ParameterAcceptor
  {
  public:
    /** Thickness, density, E and nu are those of @p values. */
    explicit ElastoplasticSection(LinearElasticSection &values);

    void
    prepare(const Constants &constants) override;

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override
    {
      return values().stiffness(frame, point);
    }

  protected:
    J2Plasticity
    material_at(const SectionPoint &point) const override;

  private:
    /** s_y (force/length^2) at @p point; throws if it isn't positive. */
    double
    yield_stress(const SectionPoint &point) const;

    std::string  yield_stress_text_;
    std::string  hardening_text_ = "0";
    unsigned int n_points_       = 9;
    Expression   yield_stress_;
    double       hardening_ = 0.;
  };
} // namespace Nacre

#endif
