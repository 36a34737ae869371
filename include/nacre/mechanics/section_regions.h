// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mechanics_section_regions_h
#define nacre_mechanics_section_regions_h

#include <nacre/base/mesh_region.h>
#include <nacre/mechanics/section_law.h>

#include <map>
#include <string>
#include <utility>
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

  /**
   * Values of a section, which are the same everywhere but in regions of the
   * mesh that have others.
   */
  template <typename T>
  class ByRegion
  {
  public:
    /** The same everywhere. */
    ByRegion(T everywhere)
      : values_(1, std::move(everywhere))
    {}

    /**
     * @param named the values of regions, by their names. A name may stand for
     *        several regions, and a region may have several names
     * @param parameter which holds them; throws as assign_regions()
     */
    ByRegion(T                               everywhere,
             const std::map<std::string, T> &named,
             const MeshRegions              &mesh,
             const std::string              &parameter)
      : ByRegion(std::move(everywhere))
    {
      std::vector<std::string> names;
      for (const auto &[name, value] : named)
        {
          names.push_back(name);
          values_.push_back(value);
        }
      for (const unsigned int k : assign_regions(mesh, names, parameter))
        place_.push_back(k == numbers::invalid_unsigned_int ? 0 : k + 1);
    }

    const T &
    at(const SectionPoint &point) const
    {
      return values_[point.region() < place_.size() ? place_[point.region()] :
                                                      0];
    }

    /** Those of everywhere, and then those of each name. */
    const std::vector<T> &
    all() const
    {
      return values_;
    }

  private:
    std::vector<T> values_;
    /** In values_, by the region of a point. */
    std::vector<unsigned int> place_;
  };
} // namespace Nacre

#endif
