// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_output_options_h
#define nacre_simulation_output_options_h

#include <nacre/postprocess/vtu_output.h>

#include <filesystem>
#include <string>

namespace Nacre
{
  /** Which files a run writes, and where. */
  struct OutputOptions
  {
    std::string folder = "output";
    /** That the names of all files begin with. */
    std::string        name;
    VtuOutput::Options fields         = {};
    bool               write_vtu      = true;
    bool               report_seconds = true;

    /** Folder and name of a file whose name ends with @p ending. */
    std::string
    file(const std::string &ending) const
    {
      return (std::filesystem::path(folder) / (name + ending)).string();
    }
  };
} // namespace Nacre

#endif
