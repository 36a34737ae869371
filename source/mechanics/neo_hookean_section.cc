// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/neo_hookean_section.h>

#include <deal.II/base/quadrature_lib.h>

namespace Nacre
{
  NeoHookeanSection::NeoHookeanSection(LinearElasticSection &values)
    : IntegratedSection<NeoHookean>(values)
    , ParameterAcceptor("/Section/Neo-Hookean")
  {
    add_parameter("Shear modulus",
                  shear_modulus_text_,
                  "Shear modulus mu of 'Type = neo-Hookean', a number or an "
                  "expression of x, y, z; Young's modulus at small strains is "
                  "3 mu. Units: force/length^2.");
    add_parameter("Points",
                  n_points_,
                  "Gauss points through the thickness. Units: none.",
                  prm,
                  Patterns::Integer(2, 20));
  }

  void
  NeoHookeanSection::prepare(const Constants &constants)
  {
    IntegratedSection<NeoHookean>::prepare(constants);
    shear_modulus_ = Expression(shear_modulus_text_,
                                "Section/Neo-Hookean/Shear modulus",
                                constants);
    if (shear_modulus_.is_constant())
      material_at(Point<3>());
    set_rule(QGauss<1>(n_points_));
  }

  Constants
  NeoHookeanSection::named_constants() const
  {
    Constants constants = IntegratedSection<NeoHookean>::named_constants();
    constants.erase("E");
    constants["nu"] = 0.5;
    if (shear_modulus_.is_constant())
      {
        constants["mu"] = shear_modulus_(Point<3>());
        constants["E"]  = 3. * constants["mu"];
      }
    return constants;
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
    return {positive(shear_modulus_(point),
                     "Section/Neo-Hookean/Shear modulus",
                     point)};
  }
} // namespace Nacre
