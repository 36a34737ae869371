// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_input_file_h
#define nacre_base_input_file_h

#include <deal.II/base/mpi.h>

#include <string>

namespace Nacre
{
  using namespace dealii;

  /** A text file that a parameter names. */
  struct InputFile
  {
    /** Where it was found. */
    std::string path;
    std::string content;
  };

  /** A number, in text, that tells @p content from any other. */
  std::string
  fingerprint(const std::string &content);

  /**
   * Read the file @p name. A relative name is taken from @p folder, that of
   * the parameter file, if it exists there, else from the current folder.
   * Only rank 0 reads; the others get the content from it. A file that can't
   * be read throws the same on every rank; @p where is the parameter that
   * names it. Collective.
   */
  InputFile
  read_input_file(const MPI_Comm     communicator,
                  const std::string &name,
                  const std::string &folder,
                  const std::string &where);

  /**
   * The @p content of a file without the byte-order mark that some editors
   * put in front. Throws for UTF-16, with the name of the @p file and the
   * remedy.
   */
  std::string
  without_byte_order_mark(const std::string &content, const std::string &file);
} // namespace Nacre

#endif
