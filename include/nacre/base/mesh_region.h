// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_mesh_region_h
#define nacre_base_mesh_region_h

#include <array>
#include <string>
#include <vector>

namespace Nacre
{
  /** The cells of a mesh that have the same names. */
  struct MeshRegion
  {
    std::vector<std::string> names = {};
    /** One of them, "cell 17", for messages. */
    std::string example = {};
  };

  /** All regions of a mesh; the first one has no name. */
  struct MeshRegions
  {
    std::vector<MeshRegion> regions = std::vector<MeshRegion>(1);
    /** Whether "WEB" and "Web" are one name. */
    bool names_ignore_case = false;
    /**
     * By region: the directions of the lines of the parameters u and v, each as
     * its components along the covariant vectors a_1 and a_2 of a cell. Empty
     * if the surface has no such parameters.
     */
    std::vector<std::array<std::array<double, 2>, 2>> parameter_lines = {};
  };
} // namespace Nacre

#endif
