// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/output_file.h>

#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace Nacre
{
  using dealii::ExcMessage;

  namespace
  {
    std::filesystem::path
    temporary_name(const std::filesystem::path &file)
    {
      return file.string() + ".part" + std::to_string(getpid());
    }
  } // namespace


  void
  create_folder(const std::string &folder)
  {
    const std::filesystem::path path = folder.empty() ? "." : folder;
    std::error_code             error;
    std::filesystem::create_directories(path, error);
    if (!std::filesystem::is_directory(path))
      AssertThrow(false,
                  ExcMessage("The output folder '" + path.string() +
                             "' can't be created: " +
                             (error ? error.message() : "it is a file") +
                             ". Choose another one by Study/Output folder."));

    const auto probe    = temporary_name(path / "nacre_probe");
    const bool writable = std::ofstream(probe).good();
    std::filesystem::remove(probe, error);
    AssertThrow(writable,
                ExcMessage("No file can be written into the output folder '" +
                           path.string() +
                           "'. Choose another one by Study/Output folder."));
  }


  void
  write_file(const std::string                         &file,
             const std::function<void(std::ostream &)> &write)
  {
    const std::filesystem::path path(file);
    create_folder(path.parent_path().string());
    const auto      temporary = temporary_name(path);
    std::error_code error;
    {
      std::ofstream out(temporary);
      try
        {
          write(out);
        }
      catch (const std::exception &)
        {
          // Writers complain of a stream that fails, each in its own words:
          // ours follow. All else is not the file's matter.
          if (out.good())
            {
              out.close();
              std::filesystem::remove(temporary, error);
              throw;
            }
        }
      out.close();
      if (!out.good())
        {
          std::filesystem::remove(temporary, error);
          AssertThrow(false,
                      ExcMessage("Writing '" + file +
                                 "' failed: is the disk full?"));
        }
    }
    std::filesystem::rename(temporary, path, error);
    if (error)
      {
        const std::string reason = error.message();
        std::filesystem::remove(temporary, error);
        AssertThrow(false,
                    ExcMessage("'" + file + "' can't be written: " + reason +
                               "."));
      }
  }
} // namespace Nacre
