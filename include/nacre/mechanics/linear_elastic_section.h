// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_linear_elastic_section_h
#define nacre_mechanics_linear_elastic_section_h

#include <nacre/base/expression.h>
#include <nacre/mechanics/section_law.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

  /**
   * Isotropic linear elastic homogeneous section, (8)-(10):
   * H_n = E h/(1 - nu^2) H, H_m = E h^3/(12 (1 - nu^2)) H.
   * Regions of the mesh may have values of their own.
   */
  class LinearElasticSection
    : public LinearSectionLaw
    , public ParameterAcceptor
  {
  public:
    LinearElasticSection();

    void
    prepare(const Constants &constants) override;

    void
    set_thickness(const double thickness) override;

    Constants
    named_constants() const override;

    void
    set_regions(const MeshRegions &mesh) override;

    /** Whether regions have values of their own, before prepare(), too. */
    bool
    has_regions() const
    {
      return !regions_text_.empty();
    }

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
    /** What a region has instead of the section's own values. */
    struct Region
    {
      std::map<std::string, Expression> values;
      std::optional<double>             nu;
    };

    void
    prepare_regions(const Constants &constants);

    void
    add_region_item(Region            &region,
                    const std::string &item,
                    const std::string &where,
                    const Constants   &known) const;

    /** The region's own expression named @p key, or nothing. */
    const Expression *
    own_value(const SectionPoint &point, const std::string &key) const;

    std::string youngs_modulus_text_ = "1";
    std::string thickness_text_      = "0.1";
    std::string density_text_        = "0";
    std::string nu_text_             = "0.3";
    std::string regions_text_;
    double      nu_ = 0.3;

    Expression            youngs_modulus_;
    Expression            thickness_;
    Expression            density_;
    std::optional<double> thickness_of_study_;

    std::map<std::string, Region> regions_;
    /** By the region of a point; null: the section's own values. */
    std::vector<const Region *> region_of_id_;
  };
} // namespace Nacre

#endif
