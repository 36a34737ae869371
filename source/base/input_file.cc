// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/input_file.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace Nacre
{
  namespace
  {
    namespace fs = std::filesystem;

    /**
     * The file that @p name means in @p folder where a backslash ends the name
     * of a folder and the case of letters doesn't matter; empty if there is
     * none, or more than one.
     */
    fs::path
    find_as_on_windows(std::string name, const std::string &folder)
    {
      std::replace(name.begin(), name.end(), '\\', '/');
      fs::path path = fs::path(name).is_absolute() ? fs::path() :
                      folder.empty()               ? fs::path(".") :
                                                     fs::path(folder);
      for (const fs::path &part : fs::path(name))
        {
          std::vector<fs::path> found;
          std::error_code       unreadable;
          if (path.empty() || fs::exists(path / part))
            found = {path / part};
          else
            for (const auto &entry : fs::directory_iterator(path, unreadable))
              if (Text::lower_case(entry.path().filename()) ==
                  Text::lower_case(part))
                found.push_back(entry.path());
          if (found.size() != 1)
            return {};
          path = found.front();
        }
      return path;
    }

    InputFile
    read(const std::string &name,
         const std::string &folder,
         const std::string &where)
    {
      fs::path       path   = name;
      const fs::path beside = fs::path(folder) / path;
      if (path.is_relative() && fs::exists(beside))
        path = beside;
      for (const std::string &place : {folder, std::string()})
        if (!fs::exists(path))
          if (const fs::path other = find_as_on_windows(name, place);
              !other.empty())
            path = other;
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
      return {found, plain_text(content.str(), found)};
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
  plain_text(std::string content, const std::string &file)
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
    if (Text::begins_with(content, mark))
      content.erase(0, mark.size());
    for (std::size_t i = content.find('\r'); i != std::string::npos;
         i             = content.find('\r', i + 1))
      if (i + 1 == content.size() || content[i + 1] != '\n')
        content[i] = '\n';
    return content;
  }


  std::vector<double>
  read_numbers(std::string        line,
               const std::string &where,
               const std::string &form)
  {
    std::replace_if(
      line.begin(),
      line.end(),
      [](const char c) { return c == ',' || c == ';'; },
      ' ');
    std::istringstream  in(line);
    std::vector<double> numbers;
    for (std::string word; in >> word;)
      {
        char        *end    = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        AssertThrow(*end == '\0' && std::isfinite(number),
                    ExcMessage(where + ": '" + word +
                               "' is no finite number; " + form + "."));
        numbers.push_back(number);
      }
    return numbers;
  }
} // namespace Nacre
