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
  class ElastoplasticSection : public IntegratedSection<J2Plasticity>
  {
  public:
    /**
     * Throws for values out of range.
     * @param elastic thickness, density, E and nu
     * @param yield_stress s_y (force/length^2), positive
     * @param hardening H (force/length^2), not negative
     * @param n_points of Simpson's rule: 5, 9, 13, ...
     */
    ElastoplasticSection(LinearElasticSection elastic,
                         const Expression    &yield_stress,
                         const double         hardening = 0.,
                         const unsigned int   n_points  = 9);

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override
    {
      return elastic().stiffness(frame, point);
    }

  protected:
    J2Plasticity
    material_at(const SectionPoint &point) const override;

  private:
    Expression yield_stress_;
    double     hardening_;
  };

  /** The section Section/Plasticity of a parameter file. */
  class ElastoplasticSectionParameters : public SectionParameters
  {
  public:
    /** Thickness, density, E and nu are those of @p elastic. */
    explicit ElastoplasticSectionParameters(
      const LinearElasticSectionParameters &elastic);

    Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const override
    {
      return elastic_.named_constants(constants, thickness);
    }

    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override;

  private:
    const LinearElasticSectionParameters &elastic_;
    std::string                           yield_stress_;
    std::string                           hardening_ = "0";
    unsigned int                          n_points_  = 9;
  };
} // namespace Nacre

#endif
