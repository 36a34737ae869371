// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_neo_hookean_section_h
#define nacre_mechanics_neo_hookean_section_h

#include <nacre/mechanics/integrated_section.h>
#include <nacre/mechanics/neo_hookean.h>

namespace Nacre
{
  /**
   * A section of an incompressible NeoHookean material, by Gauss points through
   * the thickness: C_ab(z) = a_ab - 2 z (b_ab - b0_ab) of the deformed surface,
   * with the metric of the undeformed mid-surface.
   */
  class NeoHookeanSection : public IntegratedSection<NeoHookean>
  {
  public:
    /**
     * @param shear_modulus mu (force/length^2), positive
     * @param n_points of Gauss' rule
     */
    NeoHookeanSection(const double       shear_modulus,
                      const double       thickness,
                      const double       density  = 0.,
                      const unsigned int n_points = 4)
      : NeoHookeanSection(
          {shear_modulus, "Shear modulus"},
          LinearElasticSection(3. * shear_modulus, 0., thickness, density),
          n_points)
    {}

    /** Thickness and density are those of @p values. */
    NeoHookeanSection(const Expression    &shear_modulus,
                      LinearElasticSection values,
                      const unsigned int   n_points);

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override;

  protected:
    NeoHookean
    material_at(const SectionPoint &point) const override;

  private:
    Expression shear_modulus_;
  };

  /** The section Section/Neo-Hookean of a parameter file. */
  class NeoHookeanSectionParameters : public SectionParameters
  {
  public:
    /** Thickness and density are those of @p values. */
    explicit NeoHookeanSectionParameters(
      const LinearElasticSectionParameters &values);

    /** mu; E = 3 mu and nu = 1/2 as at small strains; h. */
    Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const override;

    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override;

  private:
    Expression
    shear_modulus(const Constants &constants) const;

    const LinearElasticSectionParameters &values_;
    std::string                           shear_modulus_;
    unsigned int                          n_points_ = 4;
  };
} // namespace Nacre

#endif
