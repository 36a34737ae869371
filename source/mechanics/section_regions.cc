// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/mechanics/section_regions.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/types.h>

#include <map>

namespace Nacre
{
  using namespace dealii;

  std::vector<unsigned int>
  assign_regions(const MeshRegions              &mesh,
                 const std::vector<std::string> &names,
                 const std::string              &parameter)
  {
    const auto plain = [&](const std::string &name) {
      return mesh.names_ignore_case ? Text::lower_case(name) : name;
    };
    std::vector<std::string>                         known;
    std::map<std::string, std::vector<unsigned int>> ids;
    for (unsigned int id = 0; id < mesh.regions.size(); ++id)
      for (const std::string &name : mesh.regions[id].names)
        {
          ids[plain(name)].push_back(id);
          if (ids[plain(name)].size() == 1)
            known.push_back(Text::quoted(name));
        }

    std::vector<unsigned int> name_of_id(mesh.regions.size(),
                                         numbers::invalid_unsigned_int);
    for (unsigned int k = 0; k < names.size(); ++k)
      {
        const std::string &name = names[k];
        AssertThrow(!known.empty(),
                    ExcMessage(parameter + ": the mid-surface has no region '" +
                               name +
                               "': only mesh files with named groups of cells "
                               "have regions."));
        const auto found = ids.find(plain(name));
        AssertThrow(found != ids.end(),
                    ExcMessage(
                      Text::unknown_name(parameter, "region", name, known)));
        for (const unsigned int id : found->second)
          {
            AssertThrow(name_of_id[id] == numbers::invalid_unsigned_int,
                        ExcMessage(parameter + ": " + mesh.regions[id].example +
                                   " is in both of the regions '" +
                                   names[name_of_id[id]] + "' and '" + name +
                                   "'; only one of them can give its "
                                   "section."));
            name_of_id[id] = k;
          }
      }
    return name_of_id;
  }
} // namespace Nacre
