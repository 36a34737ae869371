// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_table_file_h
#define nacre_simulation_table_file_h

#include <functional>
#include <string>
#include <vector>

namespace Nacre
{
  /**
   * A table of values separated by commas that grows row by row as a run goes
   * on, and that a restart takes up. For one rank only.
   */
  struct TableFile
  {
    /** Names of the columns; empty: there is no table. */
    std::string header;
    /** Without their line ends. */
    std::vector<std::string> rows;

    /** The table in @p file; if @p keeps is given, the rows that it keeps. */
    static TableFile
    read(const std::string                              &file,
         const std::function<bool(const std::string &)> &keeps = {});

    /** The table with other columns, empty where it hasn't had them. */
    TableFile
    with_columns(const std::string &new_header) const;

    /** As a whole or not at all: write_file(). */
    void
    write(const std::string &file) const;

    /** Add a @p row to the table in @p file; throws if the disk is full. */
    static void
    append(const std::string &row, const std::string &file);
  };
} // namespace Nacre

#endif
