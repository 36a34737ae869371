// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/output_file.h>

#include <deal.II/base/exceptions.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

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

    std::string
    disk_full(const std::string &file)
    {
      return "Writing '" + file + "' failed: is the disk full?";
    }

    /** A file that can't be opened, by the number of the @p error. */
    std::string
    cannot_open(const std::string &file, const int error)
    {
      return "'" + file +
             "' can't be written: " + std::generic_category().message(error) +
             ".";
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
      AssertThrow(out.is_open(), ExcMessage(cannot_open(file, errno)));
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
          AssertThrow(false, ExcMessage(disk_full(file)));
        }
    }
    std::filesystem::rename(temporary, path, error);
    if (error)
      {
        const int reason = error.value();
        std::filesystem::remove(temporary, error);
        AssertThrow(false, ExcMessage(cannot_open(file, reason)));
      }
  }


  void
  check_space(const std::string &file, const std::size_t bytes)
  {
    const std::string temporary = temporary_name(file).string();
    const int descriptor = open(temporary.c_str(), O_CREAT | O_WRONLY, 0600);
    AssertThrow(descriptor >= 0, ExcMessage(cannot_open(file, errno)));
    const int error = posix_fallocate(descriptor, 0, bytes);
    close(descriptor);
    unlink(temporary.c_str());
    // Other errors say that the file system knows no reservation.
    AssertThrow(error != ENOSPC && error != EFBIG && error != EDQUOT,
                ExcMessage(disk_full(file)));
  }
} // namespace Nacre
