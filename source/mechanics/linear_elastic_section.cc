// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/linear_elastic_section.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace Nacre
{
  namespace
  {
    const char *const regions_parameter = "Section/Regions";

    double
    checked_nu(const double nu, const std::string &where)
    {
      AssertThrow(nu > -1. && nu <= 0.5,
                  ExcMessage(where + ": " + Text::number(nu) +
                             "; it must be larger than -1 and at most "
                             "0.5."));
      return nu;
    }

    double
    density_at(const Expression &density, const SectionPoint &point)
    {
      const double value = density(point);
      AssertThrow(value >= 0.,
                  ExcMessage(density.where() + ": " + Text::number(value) +
                             "; it must not be negative."));
      return value;
    }

    void
    check(const IsotropicValues &values)
    {
      checked_nu(values.poissons_ratio, "Poisson's ratio");
      check_positive(values.youngs_modulus);
      check_positive(values.thickness);
      if (values.density.is_constant())
        density_at(values.density, Point<3>());
    }

    /** The numbers among the @p values. */
    Constants
    numbers_of(const IsotropicValues &values)
    {
      Constants constants{{"nu", values.poissons_ratio}};
      if (values.youngs_modulus.is_constant())
        constants["E"] = values.youngs_modulus(Point<3>());
      if (values.thickness.is_constant())
        constants["h"] = values.thickness(Point<3>());
      return constants;
    }

    /** Replace one of a region's @p values by that of "key = value". */
    void
    replace_value(IsotropicValues   &values,
                  const std::string &item,
                  const std::string &where,
                  const Constants   &known)
    {
      const std::map<std::string, Expression *> expressions = {
        {"h", &values.thickness},
        {"E", &values.youngs_modulus},
        {"density", &values.density}};

      const auto [key, value] = Text::key_and_value(item);
      const std::string what  = where + ", " + key;
      if (key == "nu")
        {
          values.poissons_ratio =
            checked_nu(evaluate_number(value, what, known), what);
          return;
        }
      const auto found = expressions.find(key);
      AssertThrow(found != expressions.end(),
                  ExcMessage(Text::unknown_name(where,
                                                "value",
                                                key,
                                                {"h", "E", "density", "nu"})));
      *found->second = Expression(value, what, known);
    }
  } // namespace

  LinearElasticSection::LinearElasticSection(const double E,
                                             const double nu,
                                             const double h,
                                             const double density)
    : LinearElasticSection(IsotropicValues{{E, "Young's modulus"},
                                           nu,
                                           {h, "Thickness"},
                                           {density, "Density"}})
  {}

  LinearElasticSection::LinearElasticSection(ByRegion<IsotropicValues> values)
    : values_(std::move(values))
  {
    for (const IsotropicValues &some : values_.all())
      check(some);
  }

  double
  LinearElasticSection::youngs_modulus(const SectionPoint &point) const
  {
    return positive(values_.at(point).youngs_modulus, point);
  }

  double
  LinearElasticSection::poissons_ratio(const SectionPoint &point) const
  {
    return values_.at(point).poissons_ratio;
  }

  double
  LinearElasticSection::thickness(const SectionPoint &point) const
  {
    return positive(values_.at(point).thickness, point);
  }

  double
  LinearElasticSection::density(const SectionPoint &point) const
  {
    return density_at(values_.at(point).density, point);
  }

  SectionStiffness
  LinearElasticSection::stiffness(const SurfaceFrame<> &frame,
                                  const SectionPoint   &point) const
  {
    const double E  = youngs_modulus(point);
    const double h  = thickness(point);
    const double nu = poissons_ratio(point);
    const auto   H  = isotropic_stiffness(frame, nu);
    // (8), (9); the report's (31) prints (1 - nu^2)^2 by mistake.
    const double membrane = E * h / (1. - nu * nu);
    const double bending  = membrane * h * h / 12.;
    return {membrane * H, bending * H};
  }

  LinearElasticSectionParameters::LinearElasticSectionParameters()
    : SectionParameters("/Section")
  {
    add_parameter("Young's modulus",
                  youngs_modulus_,
                  "Young's modulus E, a number or an expression of x, y, z. "
                  "Units: force/length^2.");
    add_parameter("Poisson's ratio",
                  nu_,
                  "Poisson's ratio nu, larger than -1 and at most 0.5. "
                  "Units: none.");
    add_parameter("Thickness",
                  thickness_,
                  "Thickness h, a number or an expression of x, y, z. "
                  "Units: length.");
    add_parameter("Density",
                  density_,
                  "Mass per volume, a number or an expression of x, y, z. "
                  "Units: mass/length^3.");
    add_parameter("Regions",
                  regions_text_,
                  "Other values in regions of the mesh, by the names of its "
                  "groups of cells (mesh files only): "
                  "'web: h = 0.2, E = 2*E; flange: h = 0.3'. Keys: h, E, "
                  "density (expressions of x, y, z), nu; E, nu and h on the "
                  "right are those of the section. Units: as above.");
  }

  IsotropicValues
  LinearElasticSectionParameters::values(
    const Constants             &constants,
    const std::optional<double> &thickness) const
  {
    const std::string nu_parameter = "Section/Poisson's ratio";
    IsotropicValues   result;
    result.poissons_ratio =
      checked_nu(evaluate_number(nu_, nu_parameter, constants), nu_parameter);
    result.youngs_modulus =
      Expression(youngs_modulus_, "Section/Young's modulus", constants);
    result.thickness = Expression(thickness_, "Section/Thickness", constants);
    result.density   = Expression(density_, "Section/Density", constants);
    check(result);
    if (thickness)
      result.thickness = {*thickness, "Study/Thicknesses"};
    return result;
  }

  Constants
  LinearElasticSectionParameters::named_constants(
    const Constants             &constants,
    const std::optional<double> &thickness) const
  {
    return numbers_of(values(constants, thickness));
  }

  LinearElasticSection
  LinearElasticSectionParameters::section(
    const Constants             &constants,
    const std::optional<double> &thickness,
    const MeshRegions           &regions) const
  {
    const IsotropicValues everywhere = values(constants, thickness);
    Constants             known      = constants;
    for (const auto &[name, value] : numbers_of(everywhere))
      known[name] = value;
    std::map<std::string, IsotropicValues> named;
    for (const auto &entry : Text::entries(regions_text_,
                                           regions_parameter,
                                           "region",
                                           "name: h = 0.1"))
      for (const auto &quoted : entry.names)
        {
          const std::string name = Text::unquoted(quoted);
          const std::string where =
            regions_parameter + (", region '" + name) + "'";
          const auto [place, is_new] = named.try_emplace(name, everywhere);
          AssertThrow(is_new, ExcMessage(where + " stands twice."));
          for (const auto &item : Text::split(entry.value, ',', where))
            replace_value(place->second, item, where, known);
        }
    return LinearElasticSection(
      ByRegion<IsotropicValues>(everywhere, named, regions, regions_parameter));
  }
} // namespace Nacre
