// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/input_file.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>

#include <deal.II/base/exceptions.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace Nacre
{
  namespace
  {
    InputFile
    read(const std::string &name,
         const std::string &folder,
         const std::string &where)
    {
      namespace fs          = std::filesystem;
      fs::path       path   = name;
      const fs::path beside = fs::path(folder) / path;
      if (path.is_relative() && fs::exists(beside))
        path = beside;
      const std::string folders =
        fs::path(name).is_relative() && !folder.empty() ?
          "; looked for in '" + folder + "' and in the current folder" :
          "";
      AssertThrow(fs::exists(path),
                  ExcMessage(where + ": the file '" + name + "' doesn't exist" +
                             folders + "."));
      AssertThrow(!fs::is_directory(path),
                  ExcMessage(where + ": '" + path.string() +
                             "' is a folder; a file is expected."));
      std::ifstream in(path, std::ios::binary);
      AssertThrow(in.good(),
                  ExcMessage(where + ": the file '" + path.string() +
                             "' can't be read."));
      std::ostringstream content;
      content << in.rdbuf();
      AssertThrow(!in.bad(),
                  ExcMessage(where + ": reading the file '" + path.string() +
                             "' failed."));
      return {path.lexically_normal().string(), content.str()};
    }
  } // namespace


  std::string
  fingerprint(const std::string &content)
  {
    // Fowler, Noll and Vo's hash, FNV-1a of 64 bits
    std::uint64_t hash = 14695981039346656037u;
    for (const unsigned char byte : content)
      {
        hash ^= byte;
        hash *= 1099511628211u;
      }
    std::ostringstream text;
    text << std::hex << hash;
    return text.str();
  }


  InputFile
  read_input_file(const MPI_Comm     communicator,
                  const std::string &name,
                  const std::string &folder,
                  const std::string &where)
  {
    const std::string trimmed = Text::trim(name);
    AssertThrow(!trimmed.empty(), ExcMessage(where + ": no file is named."));
    InputFile file;
    run_on_root(communicator, [&]() { file = read(trimmed, folder, where); });
    file.path    = Utilities::MPI::broadcast(communicator, file.path);
    file.content = Utilities::MPI::broadcast(communicator, file.content);
    return file;
  }
} // namespace Nacre
