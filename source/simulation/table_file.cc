// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/output_file.h>
#include <nacre/base/types.h>
#include <nacre/simulation/table_file.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <fstream>

namespace Nacre
{
  TableFile
  TableFile::read(const std::string                              &file,
                  const std::function<bool(const std::string &)> &keeps)
  {
    TableFile     table;
    std::ifstream in(file);
    std::string   line;
    std::getline(in, table.header);
    while (std::getline(in, line))
      if (!keeps || keeps(line))
        table.rows.push_back(line);
    return table;
  }

  namespace
  {
    std::vector<std::string>
    fields_of(const std::string &line)
    {
      std::vector<std::string> fields;
      boost::split(fields, line, boost::is_any_of(","));
      return fields;
    }
  } // namespace

  TableFile
  TableFile::with_columns(const std::string &new_header) const
  {
    TableFile  table{new_header, {}};
    const auto names = fields_of(header);
    for (const std::string &row : rows)
      {
        auto fields = fields_of(row);
        fields.resize(names.size());
        std::string line;
        for (const std::string &name : fields_of(new_header))
          {
            const auto found = std::find(names.begin(), names.end(), name);
            if (found != names.end())
              line += fields[found - names.begin()];
            line += ',';
          }
        line.pop_back();
        table.rows.push_back(line);
      }
    return table;
  }

  void
  TableFile::write(const std::string &file) const
  {
    write_file(file, [&](std::ostream &out) {
      out << header << '\n';
      for (const std::string &row : rows)
        out << row << '\n';
    });
  }

  void
  TableFile::append(const std::string &row, const std::string &file)
  {
    std::ofstream out(file, std::ios::app);
    out << row << '\n' << std::flush;
    AssertThrow(out,
                ExcMessage("Writing '" + file + "' failed: is the disk full?"));
  }
} // namespace Nacre
