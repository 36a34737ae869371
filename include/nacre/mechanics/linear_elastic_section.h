// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_linear_elastic_section_h
#define nacre_mechanics_linear_elastic_section_h

#include <nacre/base/expression.h>
#include <nacre/mechanics/section_parameters.h>
#include <nacre/mechanics/section_regions.h>

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace Nacre
{
  /**
   * The dimensionless isotropic stiffness (10) with the metric G^11, G^22, G^12
   * (1/length^2), in Voigt order:
   * H^abcd = nu G^ab G^cd + (1 - nu)/2 (G^ac G^bd + G^ad G^bc).
   */
  template <typename Number>
  VoigtMatrix<Number>
  isotropic_stiffness(const std::array<Number, 3> &metric, const Number &nu)
  {
    const auto &[g_11, g_22, g_12] = metric;

    VoigtMatrix<Number> H;
    H[0][0] = g_11 * g_11;
    H[1][1] = g_22 * g_22;
    H[0][1] = nu * g_11 * g_22 + (1. - nu) * g_12 * g_12;
    H[0][2] = g_11 * g_12;
    H[1][2] = g_22 * g_12;
    H[2][2] = 0.5 * ((1. - nu) * g_11 * g_22 + (1. + nu) * g_12 * g_12);
    H[1][0] = H[0][1];
    H[2][0] = H[0][2];
    H[2][1] = H[1][2];
    return H;
  }

  /** The same with the metric of the surface. */
  template <typename Number>
  VoigtMatrix<Number>
  isotropic_stiffness(const SurfaceFrame<Number> &frame, const Number &nu)
  {
    return isotropic_stiffness(frame.metric_con, nu);
  }

  /** What an isotropic section is made of. */
  struct IsotropicValues
  {
    /** E (force/length^2), positive. */
    Expression youngs_modulus;
    /** nu, larger than -1 and smaller than 1/2. */
    double poissons_ratio = 0.;
    /** h (length), positive. */
    Expression thickness;
    /** Mass per volume, not negative. */
    Expression density;
  };

  /**
   * Isotropic linear elastic homogeneous section, (8)-(10):
   * H_n = E h/(1 - nu^2) H, H_m = E h^3/(12 (1 - nu^2)) H.
   */
  class LinearElasticSection : public LinearSectionLaw
  {
  public:
    /** The same everywhere; throws for values out of range. */
    LinearElasticSection(const double E,
                         const double nu,
                         const double h,
                         const double density = 0.);

    /**
     * Throws for numbers out of range; expressions of the position are checked
     * at the points of use.
     */
    explicit LinearElasticSection(ByRegion<IsotropicValues> values);

    /** Throws if it isn't positive, as the next one. */
    double
    thickness(const SectionPoint &point) const override;

    double
    density(const SectionPoint &point) const override;

    /** E (force/length^2) at @p point; throws if it isn't positive. */
    double
    youngs_modulus(const SectionPoint &point) const;

    double
    poissons_ratio(const SectionPoint &point) const;

    SectionStiffness
    stiffness(const SurfaceFrame<> &frame,
              const SectionPoint   &point) const override;

  private:
    ByRegion<IsotropicValues> values_;
  };

  /**
   * The section Section of a parameter file: an isotropic section. Regions of
   * the mesh may have values of their own.
   */
  class LinearElasticSectionParameters : public SectionParameters
  {
  public:
    LinearElasticSectionParameters();

    /** Whether regions have values of their own. */
    bool
    has_regions() const
    {
      return !regions_text_.empty();
    }

    Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const override;

    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override
    {
      return std::make_shared<LinearElasticSection>(
        section(constants, thickness, regions));
    }

    /** As make(). */
    LinearElasticSection
    section(const Constants             &constants,
            const std::optional<double> &thickness,
            const MeshRegions           &regions) const;

  private:
    /** Those of everywhere, checked. */
    IsotropicValues
    values(const Constants             &constants,
           const std::optional<double> &thickness) const;

    std::string youngs_modulus_ = "1";
    std::string thickness_      = "0.1";
    std::string density_        = "0";
    std::string nu_             = "0.3";
    std::string regions_text_;
  };
} // namespace Nacre

#endif
