// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_shell_section_h
#define nacre_mechanics_shell_section_h

#include <nacre/base/selection.h>
#include <nacre/mechanics/elastoplastic_section.h>
#include <nacre/mechanics/initial_strain.h>
#include <nacre/mechanics/laminate_parameters.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/mechanics/neo_hookean_section.h>

#include <memory>
#include <optional>

namespace Nacre
{
  enum class SectionType
  {
    isotropic,
    laminate,
    neo_hookean,
    elastoplastic
  };

  const Selection<SectionType> &selection(SectionType);

  /** The section that 'Section/Type' chooses, with its initial strains. */
  class ShellSectionParameters : public SectionParameters
  {
  public:
    ShellSectionParameters();

    Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const override;

    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override;

  private:
    const SectionParameters &
    chosen() const;

    SectionType                    type_ = SectionType::isotropic;
    LinearElasticSectionParameters isotropic_;
    LaminateSectionParameters      laminate_;
    NeoHookeanSectionParameters    neo_hookean_{isotropic_};
    ElastoplasticSectionParameters elastoplastic_{isotropic_};
    InitialStrainParameters        initial_strain_;
  };
} // namespace Nacre

#endif
