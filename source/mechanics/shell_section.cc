// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/mechanics/initially_strained_section.h>
#include <nacre/mechanics/shell_section.h>

#include <utility>

namespace Nacre
{
  const Selection<SectionType> &
  selection(SectionType)
  {
    static const Selection<SectionType> table = {
      {SectionType::isotropic, "isotropic"},
      {SectionType::laminate, "laminate"},
      {SectionType::neo_hookean, "neo-Hookean"},
      {SectionType::elastoplastic, "elastoplastic"}};
    return table;
  }

  ShellSectionParameters::ShellSectionParameters()
    : SectionParameters("/Section")
  {
    add_parameter("Type",
                  type_,
                  "isotropic: a homogeneous section of the values below; "
                  "laminate: a stack of orthotropic plies, by the subsection "
                  "Laminate alone; neo-Hookean: an incompressible material of "
                  "large strains, by the subsection Neo-Hookean and the "
                  "thickness and density below; elastoplastic: the isotropic "
                  "section, whose layers yield, by the subsection Plasticity. "
                  "The last two need an analysis that iterates, and "
                  "'Discretization/Kinematics = finite' or 'linear'.");
  }

  const SectionParameters &
  ShellSectionParameters::chosen() const
  {
    switch (type_)
      {
        case SectionType::laminate:
          return laminate_;
        case SectionType::neo_hookean:
          return neo_hookean_;
        case SectionType::elastoplastic:
          return elastoplastic_;
        case SectionType::isotropic:
          break;
      }
    return isotropic_;
  }

  Constants
  ShellSectionParameters::named_constants(
    const Constants             &constants,
    const std::optional<double> &thickness) const
  {
    AssertThrow(type_ != SectionType::laminate || !isotropic_.has_regions(),
                ExcMessage("Section/Regions: these are regions of isotropic "
                           "sections; for 'Type = laminate' use "
                           "'Section/Laminate/Regions'."));
    AssertThrow(type_ != SectionType::neo_hookean || !isotropic_.has_regions(),
                ExcMessage("Section/Regions: these are regions of isotropic "
                           "sections; for 'Type = neo-Hookean' thickness and "
                           "shear modulus may be expressions of x, y, z."));
    return chosen().named_constants(constants, thickness);
  }

  std::shared_ptr<const SectionLaw>
  ShellSectionParameters::make(const Constants             &constants,
                               const std::optional<double> &thickness,
                               const MeshRegions           &regions) const
  {
    Constants known = constants;
    for (const auto &[name, value] : named_constants(constants, thickness))
      known.emplace(name, value);
    auto law = chosen().make(constants, thickness, regions);
    auto initial_strains =
      initial_strain_.make(known, type_ == SectionType::laminate, regions);
    if (initial_strains.is_zero())
      return law;
    return std::make_shared<InitiallyStrainedSection>(std::move(law),
                                                      std::move(
                                                        initial_strains));
  }
} // namespace Nacre
