// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_output_file_h
#define nacre_base_output_file_h

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace Nacre
{
  /**
   * Create @p folder, with those above it, unless it exists; check that files
   * can be written into it. Throws an ExcMessage that names the folder.
   */
  void
  create_folder(const std::string &folder);

  /**
   * Write @p file as a whole or not at all: under a temporary name in the same
   * folder, which is created if it is missing, then renamed. Throws an
   * ExcMessage that names the folder or the file. For one rank only.
   */
  void
  write_file(const std::string                         &file,
             const std::function<void(std::ostream &)> &write);

  /**
   * Throw the same complaint as write_file() if @p bytes of @p file don't fit
   * on the disk, or into the system's limit of files: for writers of other
   * libraries, which don't survive that. For one rank only.
   */
  void
  check_space(const std::string &file, const std::size_t bytes);
} // namespace Nacre

#endif
