// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/neo_hookean_section.h>

#include <deal.II/base/quadrature_lib.h>

#include <utility>

namespace Nacre
{
  NeoHookeanSection::NeoHookeanSection(const Expression    &shear_modulus,
                                       LinearElasticSection values,
                                       const unsigned int   n_points)
    : IntegratedSection<NeoHookean>(std::move(values), QGauss<1>(n_points))
    , shear_modulus_(shear_modulus)
  {
    check_positive(shear_modulus_);
  }

  SectionStiffness
  NeoHookeanSection::stiffness(const SurfaceFrame<> &frame,
                               const SectionPoint   &point) const
  {
    // E/(1 - nu^2) of the incompressible material
    const double h        = thickness(point);
    const double membrane = 4. * material_at(point).shear_modulus * h;
    const auto   H        = isotropic_stiffness(frame, 0.5);
    return {membrane * H, membrane * h * h / 12. * H};
  }

  NeoHookean
  NeoHookeanSection::material_at(const SectionPoint &point) const
  {
    return {positive(shear_modulus_, point)};
  }

  NeoHookeanSectionParameters::NeoHookeanSectionParameters(
    const LinearElasticSectionParameters &values)
    : SectionParameters("/Section/Neo-Hookean")
    , values_(values)
  {
    add_parameter("Shear modulus",
                  shear_modulus_,
                  "Shear modulus mu of 'Type = neo-Hookean', a number or an "
                  "expression of x, y, z; Young's modulus at small strains is "
                  "3 mu. Units: force/length^2.");
    add_parameter("Points",
                  n_points_,
                  "Gauss points through the thickness. Units: none.",
                  prm,
                  Patterns::Integer(2, 20));
  }

  Expression
  NeoHookeanSectionParameters::shear_modulus(const Constants &constants) const
  {
    return {shear_modulus_, "Section/Neo-Hookean/Shear modulus", constants};
  }

  Constants
  NeoHookeanSectionParameters::named_constants(
    const Constants             &constants,
    const std::optional<double> &thickness) const
  {
    Constants  result = values_.named_constants(constants, thickness);
    const auto mu     = shear_modulus(constants);
    check_positive(mu);
    result.erase("E");
    result["nu"] = 0.5;
    if (mu.is_constant())
      {
        result["mu"] = mu(Point<3>());
        result["E"]  = 3. * result["mu"];
      }
    return result;
  }

  std::shared_ptr<const SectionLaw>
  NeoHookeanSectionParameters::make(const Constants             &constants,
                                    const std::optional<double> &thickness,
                                    const MeshRegions           &regions) const
  {
    return std::make_shared<NeoHookeanSection>(shear_modulus(constants),
                                               values_.section(constants,
                                                               thickness,
                                                               regions),
                                               n_points_);
  }
} // namespace Nacre
