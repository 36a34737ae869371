// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/checked_value.h>
#include <nacre/mechanics/elastoplastic_section.h>

#include <deal.II/base/quadrature_lib.h>

#include <utility>

namespace Nacre
{
  namespace
  {
    const std::string plasticity = "Section/Plasticity/";

    Quadrature<1>
    simpson_rule(const unsigned int n_points)
    {
      AssertThrow(n_points > 1 && n_points % 4 == 1,
                  ExcMessage(plasticity +
                             "Points: " + std::to_string(n_points) +
                             "; it must be 5, 9, 13, ..., so that Simpson's "
                             "rule ends at the middle."));
      return QIterated<1>(QSimpson<1>(), (n_points - 1) / 2);
    }
  } // namespace

  ElastoplasticSection::ElastoplasticSection(LinearElasticSection elastic,
                                             const Expression    &yield_stress,
                                             const double         hardening,
                                             const unsigned int   n_points)
    : IntegratedSection<J2Plasticity>(std::move(elastic),
                                      simpson_rule(n_points))
    , yield_stress_(yield_stress)
    , hardening_(hardening)
  {
    AssertThrow(hardening_ >= 0.,
                ExcMessage(plasticity +
                           "Hardening modulus: " + Text::number(hardening_) +
                           "; it must not be negative."));
    check_positive(yield_stress_);
  }

  J2Plasticity
  ElastoplasticSection::material_at(const SectionPoint &point) const
  {
    return {elastic().youngs_modulus(point),
            elastic().poissons_ratio(point),
            positive(yield_stress_, point),
            hardening_};
  }

  ElastoplasticSectionParameters::ElastoplasticSectionParameters(
    const LinearElasticSectionParameters &elastic)
    : SectionParameters("/Section/Plasticity")
    , elastic_(elastic)
  {
    add_parameter("Yield stress",
                  yield_stress_,
                  "Stress at which 'Type = elastoplastic' begins to yield in "
                  "tension, a number or an expression of x, y, z. "
                  "Units: force/length^2.");
    add_parameter("Hardening modulus",
                  hardening_,
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

  std::shared_ptr<const SectionLaw>
  ElastoplasticSectionParameters::make(const Constants             &constants,
                                       const std::optional<double> &thickness,
                                       const MeshRegions &regions) const
  {
    return std::make_shared<ElastoplasticSection>(
      elastic_.section(constants, thickness, regions),
      Expression(yield_stress_, plasticity + "Yield stress", constants),
      evaluate_number(hardening_, plasticity + "Hardening modulus", constants),
      n_points_);
  }
} // namespace Nacre
