// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/elastoplastic_section.h>

#include <deal.II/base/quadrature_lib.h>

namespace Nacre
{
  namespace
  {
    const std::string plasticity = "Section/Plasticity/";
  }

  ElastoplasticSection::ElastoplasticSection(LinearElasticSection &values)
    : IntegratedSection<J2Plasticity>(values)
    , ParameterAcceptor("/Section/Plasticity")
  {
    add_parameter("Yield stress",
                  yield_stress_text_,
                  "Stress at which 'Type = elastoplastic' begins to yield in "
                  "tension, a number or an expression of x, y, z. "
                  "Units: force/length^2.");
    add_parameter("Hardening modulus",
                  hardening_text_,
                  "How the yield stress grows with the accumulated plastic "
                  "strain; 0: perfectly plastic. In tension the tangent beyond "
                  "yielding is E H/(E + H). Units: force/length^2.");
    add_parameter("Points",
                  n_points_,
                  "Points of Simpson's rule through the thickness, with both "
                  "faces: 5, 9, 13, ... Units: none.",
                  prm,
                  Patterns::Integer(5, 201));
  }

  void
  ElastoplasticSection::prepare(const Constants &constants)
  {
    IntegratedSection<J2Plasticity>::prepare(constants);
    yield_stress_ =
      Expression(yield_stress_text_, plasticity + "Yield stress", constants);
    const std::string modulus = plasticity + "Hardening modulus";
    hardening_ = evaluate_number(hardening_text_, modulus, constants);
    AssertThrow(hardening_ >= 0.,
                ExcMessage(modulus + ": " + Text::number(hardening_) +
                           "; it must not be negative."));
    AssertThrow(n_points_ % 4 == 1,
                ExcMessage(plasticity + "Points: " + std::to_string(n_points_) +
                           "; it must be 5, 9, 13, ..., so that Simpson's rule "
                           "ends at the middle."));
    if (yield_stress_.is_constant())
      yield_stress(Point<3>());
    set_rule(QIterated<1>(QSimpson<1>(), (n_points_ - 1) / 2));
  }

  double
  ElastoplasticSection::yield_stress(const SectionPoint &point) const
  {
    return positive(yield_stress_(point), plasticity + "Yield stress", point);
  }

  J2Plasticity
  ElastoplasticSection::material_at(const SectionPoint &point) const
  {
    return {values().youngs_modulus(point),
            values().poissons_ratio(point),
            yield_stress(point),
            hardening_};
  }
} // namespace Nacre
