// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_regions_h
#define nacre_mechanics_section_regions_h

#include <nacre/base/mesh_region.h>

#include <string>
#include <vector>

namespace Nacre
{
  /**
   * Which of the @p names, for which a section has values of their own, each
   * region of the @p mesh has: an index, or invalid_unsigned_int for none.
   * Throws with @p parameter, which holds the names, if a name isn't there or
   * if a region has two of them.
   */
  std::vector<unsigned int>
  assign_regions(const MeshRegions              &mesh,
                 const std::vector<std::string> &names,
                 const std::string              &parameter);
} // namespace Nacre

#endif
