// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_input_file_h
#define nacre_base_input_file_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

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
   * the parameter file, if it exists there, else from the current folder. Where
   * there is no such file, names are read as on Windows: a backslash ends the
   * name of a folder, and the case of letters doesn't matter as long as one
   * file fits.
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
   * The @p content of a text file without the byte-order mark that some editors
   * put in front, and with a newline for each carriage return that stands
   * alone, the line end of old Macintosh programs. Throws for UTF-16, with the
   * name of the @p file and the remedy.
   */
  std::string
  plain_text(std::string content, const std::string &file);

  /**
   * The numbers of a @p line of a file, between blanks, commas or semicolons.
   * Throws for a word that is no finite number; @p where names the line, and
   * @p form is a clause that says what a line holds.
   */
  std::vector<double>
  read_numbers(std::string        line,
               const std::string &where,
               const std::string &form);
} // namespace Nacre

#endif
