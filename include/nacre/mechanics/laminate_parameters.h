// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_laminate_parameters_h
#define nacre_mechanics_laminate_parameters_h

#include <nacre/mechanics/laminate_section.h>
#include <nacre/mechanics/section_parameters.h>

#include <memory>
#include <optional>
#include <string>

namespace Nacre
{
  /** The section Section/Laminate of a parameter file: a LaminateSection. */
  class LaminateSectionParameters : public SectionParameters
  {
  public:
    LaminateSectionParameters();

    /** h, the whole thickness. */
    Constants
    named_constants(const Constants             &constants,
                    const std::optional<double> &thickness) const override;

    std::shared_ptr<const SectionLaw>
    make(const Constants             &constants,
         const std::optional<double> &thickness,
         const MeshRegions           &regions) const override
    {
      return std::make_shared<LaminateSection>(
        section(constants, thickness, regions));
    }

    /** As make(). */
    LaminateSection
    section(const Constants             &constants,
            const std::optional<double> &thickness,
            const MeshRegions           &regions) const;

    /** The parameters of a layup; regions may have some of their own. */
    struct LayupTexts
    {
      std::string stack, thickness, ply_thickness;
      std::string offset    = "0";
      std::string direction = "x";
    };

  private:
    std::string materials_;
    LayupTexts  texts_;
    std::string top_ = "normal";
    std::string regions_;
  };
} // namespace Nacre

#endif
