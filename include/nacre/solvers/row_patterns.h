// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_row_patterns_h
#define nacre_solvers_row_patterns_h

#include <nacre/solvers/sparse_rows.h>

#include <vector>

namespace Nacre
{
  /**
   * The columns of sparse rows. Rows that have the same columns share a
   * pattern: the dofs of a vertex, of an edge or inside a cell are numbered
   * together and couple with the same dofs. Its columns are kept as runs of
   * consecutive numbers, so that one search, or one copy, serves a whole run.
   */
  class RowPatterns
  {
  public:
    /**
     * The columns column, column + 1, ... at the places place, place + 1, ...
     * of a row. A run ends where the next one's places begin; after the last
     * run stands one whose column is larger than any.
     */
    struct Run
    {
      int column;
      int place;
    };

    /** The pattern that the constructor makes: no column at all. */
    static constexpr unsigned int empty = 0;

    RowPatterns();

    /**
     * Find the patterns of @p rows. Returns that of each row. Rows are
     * compared with the two patterns that were met last: a constrained dof may
     * stand between others of its vertex.
     * @param numbers what to call each local column of @p rows
     */
    std::vector<unsigned int>
    add(const SparseRows &rows, const std::vector<unsigned int> &numbers);

    /** The same, with the local columns called as they are. */
    std::vector<unsigned int>
    add(const SparseRows &rows);

    const Run *
    begin(const unsigned int pattern) const
    {
      return &runs_[starts_[pattern]];
    }

    const Run *
    end(const unsigned int pattern) const
    {
      return &runs_[starts_[pattern + 1] - 1];
    }

    /** Number of columns. */
    unsigned int
    length(const unsigned int pattern) const
    {
      return end(pattern)->place;
    }

    /** Number of columns of the longest pattern. */
    unsigned int
    max_length() const;

  private:
    unsigned int
    append(const SparseRows::Row           &row,
           const std::vector<unsigned int> &numbers);

    std::vector<Run>         runs_;   // of all patterns
    std::vector<std::size_t> starts_; // [pattern]: its first run
  };
} // namespace Nacre

#endif
