// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_laminates_laminate_parameters_h
#define nacre_tests_laminates_laminate_parameters_h

#include "../tests_common.h"
#include <nacre/mechanics/laminate_parameters.h>

namespace Tests
{
  /** A graphite-epoxy of the literature, strengths included. */
  const std::string graphite =
    "graphite: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5, density = 1.5, "
    "Xt = 2, Xc = 1.5, Yt = 0.05, Yc = 0.2, S = 0.1";

  inline std::string
  laminate_text(const std::string &stack,
                const std::string &thickness,
                const std::string &others    = "",
                const std::string &materials = graphite)
  {
    return "subsection Section\n subsection Laminate\n  set Materials = " +
           materials + "\n  set Stack = " + stack +
           "\n  set Thickness = " + thickness + "\n" + others + " end\nend\n";
  }

  /** A laminate of a text, no conditions and no loads. */
  struct LaminateParameters
  {
    explicit LaminateParameters(const std::string &text)
      : section(section_of_text<LaminateSectionParameters>(text))
    {}

    LaminateSection    section;
    BoundaryConditions conditions;
    Loads              loads;
  };
} // namespace Tests

#endif
