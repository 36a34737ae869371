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
      const std::string found = path.lexically_normal().string();
      return {found, without_byte_order_mark(content.str(), found)};
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


  std::string
  without_byte_order_mark(const std::string &content, const std::string &file)
  {
    const std::string begin = content.substr(0, 2);
    // Without a mark, each second byte of English text is zero.
    const bool is_utf_16 =
      begin == "\xFF\xFE" || begin == "\xFE\xFF" ||
      (begin.size() == 2 && (begin[0] == '\0') != (begin[1] == '\0'));
    AssertThrow(!is_utf_16,
                ExcMessage(
                  "The file '" + file +
                  "' is UTF-16 text; save it as UTF-8 (editor: Save "
                  "as, encoding UTF-8; or iconv -f UTF-16 -t UTF-8)."));
    const std::string mark = "\xEF\xBB\xBF";
    return content.compare(0, mark.size(), mark) == 0 ?
             content.substr(mark.size()) :
             content;
  }
} // namespace Nacre
