// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/section_regions.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    const char *const regions_parameter = "Section/Regions";

    double
    checked_nu(const double nu, const std::string &where)
    {
      AssertThrow(nu > -1. && nu < 0.5,
                  ExcMessage(where + ": " + Text::number(nu) +
                             "; it must be larger than -1 and smaller than "
                             "0.5."));
      return nu;
    }
  } // namespace

  LinearElasticSection::LinearElasticSection()
    : ParameterAcceptor("/Section")
  {
    add_parameter("Young's modulus",
                  youngs_modulus_text_,
                  "Young's modulus E, a number or an expression of x, y, z. "
                  "Units: force/length^2.");
    add_parameter("Poisson's ratio",
                  nu_text_,
                  "Poisson's ratio nu, larger than -1 and smaller than 0.5. "
                  "Units: none.");
    add_parameter("Thickness",
                  thickness_text_,
                  "Thickness h, a number or an expression of x, y, z. "
                  "Units: length.");
    add_parameter("Density",
                  density_text_,
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

  void
  LinearElasticSection::prepare(const Constants &constants)
  {
    const std::string nu_parameter = "Section/Poisson's ratio";
    nu_ = checked_nu(evaluate_number(nu_text_, nu_parameter, constants),
                     nu_parameter);
    region_of_id_.clear();
    youngs_modulus_ =
      Expression(youngs_modulus_text_, "Section/Young's modulus", constants);
    thickness_ = Expression(thickness_text_, "Section/Thickness", constants);
    density_   = Expression(density_text_, "Section/Density", constants);
    // Constants are checked at once, expressions at the points of use.
    if (youngs_modulus_.is_constant())
      youngs_modulus(Point<3>());
    if (thickness_.is_constant())
      thickness(Point<3>());
    if (density_.is_constant())
      density(Point<3>());
    prepare_regions(constants);
  }

  void
  LinearElasticSection::prepare_regions(const Constants &constants)
  {
    regions_.clear();
    Constants known = constants;
    for (const auto &[name, value] : named_constants())
      known[name] = value;
    for (const auto &entry : Text::entries(regions_text_,
                                           regions_parameter,
                                           "region",
                                           "name: h = 0.1"))
      for (const auto &quoted : entry.names)
        {
          const std::string name = Text::unquoted(quoted);
          const std::string where =
            regions_parameter + (", region '" + name) + "'";
          const auto [place, is_new] = regions_.try_emplace(name);
          AssertThrow(is_new, ExcMessage(where + " stands twice."));
          for (const auto &item : Text::split(entry.value, ',', where))
            add_region_item(place->second, item, where, known);
        }
  }

  void
  LinearElasticSection::add_region_item(Region            &region,
                                        const std::string &item,
                                        const std::string &where,
                                        const Constants   &known) const
  {
    const std::vector<std::string> keys = {"h", "E", "density", "nu"};

    const auto [key, value] = Text::key_and_value(item);
    AssertThrow(std::find(keys.begin(), keys.end(), key) != keys.end(),
                ExcMessage(Text::unknown_name(where, "value", key, keys)));
    const std::string what = where + ", " + key;
    if (key == "nu")
      region.nu = checked_nu(evaluate_number(value, what, known), what);
    else
      {
        Expression expression(value, what, known);
        if (key != "density" && expression.is_constant())
          positive(expression(Point<3>()), what, Point<3>());
        region.values[key] = std::move(expression);
      }
  }

  void
  LinearElasticSection::set_regions(const MeshRegions &mesh)
  {
    std::vector<std::string>    names;
    std::vector<const Region *> values;
    for (const auto &[name, region] : regions_)
      {
        names.push_back(name);
        values.push_back(&region);
      }
    region_of_id_.clear();
    for (const unsigned int k : assign_regions(mesh, names, regions_parameter))
      region_of_id_.push_back(k == numbers::invalid_unsigned_int ? nullptr :
                                                                   values[k]);
  }

  const Expression *
  LinearElasticSection::own_value(const SectionPoint &point,
                                  const std::string  &key) const
  {
    if (point.region() >= region_of_id_.size() ||
        region_of_id_[point.region()] == nullptr)
      return nullptr;
    const auto &values = region_of_id_[point.region()]->values;
    const auto  found  = values.find(key);
    return found == values.end() ? nullptr : &found->second;
  }

  void
  LinearElasticSection::set_thickness(const double thickness)
  {
    thickness_of_study_ = thickness;
  }

  Constants
  LinearElasticSection::named_constants() const
  {
    Constants constants;
    constants["nu"] = nu_;
    if (youngs_modulus_.is_constant())
      constants["E"] = youngs_modulus_(Point<3>());
    if (thickness_of_study_)
      constants["h"] = *thickness_of_study_;
    else if (thickness_.is_constant())
      constants["h"] = thickness_(Point<3>());
    return constants;
  }

  double
  LinearElasticSection::youngs_modulus(const SectionPoint &point) const
  {
    if (const Expression *const own = own_value(point, "E"))
      return positive((*own)(point), "Section/Regions, E", point);
    return positive(youngs_modulus_(point), "Section/Young's modulus", point);
  }

  double
  LinearElasticSection::poissons_ratio(const SectionPoint &point) const
  {
    if (point.region() < region_of_id_.size() &&
        region_of_id_[point.region()] != nullptr)
      return region_of_id_[point.region()]->nu.value_or(nu_);
    return nu_;
  }

  double
  LinearElasticSection::thickness(const SectionPoint &point) const
  {
    if (const Expression *const own = own_value(point, "h"))
      return positive((*own)(point), "Section/Regions, h", point);
    return thickness_of_study_ ?
             *thickness_of_study_ :
             positive(thickness_(point), "Section/Thickness", point);
  }

  double
  LinearElasticSection::density(const SectionPoint &point) const
  {
    const Expression *const own   = own_value(point, "density");
    const double            value = (own == nullptr ? density_ : *own)(point);
    AssertThrow(value >= 0.,
                ExcMessage(
                  std::string(own == nullptr ? "Section/Density" :
                                               "Section/Regions, density") +
                  ": " + Text::number(value) + "; it must not be negative."));
    return value;
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
} // namespace Nacre
