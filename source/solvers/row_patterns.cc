// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/row_patterns.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace Nacre
{
  RowPatterns::RowPatterns()
    : runs_{{std::numeric_limits<int>::max(), 0}}
    , starts_{0, 1}
  {}

  std::vector<unsigned int>
  RowPatterns::add(const SparseRows                &rows,
                   const std::vector<unsigned int> &numbers)
  {
    std::vector<unsigned int> patterns(rows.n_rows());
    // The first rows of the two patterns that were met last.
    std::array<unsigned int, 2> known{{0, 0}};
    for (unsigned int i = 0; i < patterns.size(); ++i)
      {
        const auto row     = rows[i];
        const auto is_like = [&](const unsigned int other) {
          return other < i && rows[other].length == row.length &&
                 std::equal(row.columns,
                            row.columns + row.length,
                            rows[other].columns);
        };
        if (is_like(known[0]))
          patterns[i] = patterns[known[0]];
        else if (is_like(known[1]))
          {
            patterns[i] = patterns[known[1]];
            std::swap(known[0], known[1]);
          }
        else
          {
            patterns[i] = append(row, numbers);
            known       = {{i, known[0]}};
          }
      }
    return patterns;
  }

  std::vector<unsigned int>
  RowPatterns::add(const SparseRows &rows)
  {
    std::vector<unsigned int> numbers(rows.n_columns());
    std::iota(numbers.begin(), numbers.end(), 0);
    return add(rows, numbers);
  }

  unsigned int
  RowPatterns::max_length() const
  {
    int result = 0;
    for (const Run &run : runs_)
      result = std::max(result, run.place);
    return result;
  }

  unsigned int
  RowPatterns::append(const SparseRows::Row           &row,
                      const std::vector<unsigned int> &numbers)
  {
    int next = -1;
    for (unsigned int k = 0; k < row.length; ++k)
      {
        const int column = numbers[row.columns[k]];
        if (column != next)
          runs_.push_back({column, static_cast<int>(k)});
        next = column + 1;
      }
    runs_.push_back(
      {std::numeric_limits<int>::max(), static_cast<int>(row.length)});
    starts_.push_back(runs_.size());
    return starts_.size() - 2;
  }
} // namespace Nacre
