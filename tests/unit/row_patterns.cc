// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Rows of a sparse matrix that share their columns, and runs of columns.

#include "unit_test.h"
#include <nacre/solvers/row_patterns.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <vector>

using namespace Nacre;

namespace
{
  /** Two nodes that couple; the second dof of each is constrained. */
  struct Nodes
  {
    Nodes()
    {
      DynamicSparsityPattern pattern(7, 7);
      for (const unsigned int i : {0, 2, 3, 5})
        for (const unsigned int j : {0, 2, 3, 5})
          pattern.add(i, j);
      for (const unsigned int i : {1, 4, 6})
        pattern.add(i, i);
      matrix.reinit(pattern);
    }

    TrilinosWrappers::SparseMatrix matrix;
  };

  std::vector<std::pair<int, int>>
  runs_of(const RowPatterns &patterns, const unsigned int pattern)
  {
    std::vector<std::pair<int, int>> runs;
    for (auto run = patterns.begin(pattern); run != patterns.end(pattern);
         ++run)
      runs.emplace_back(run->column, run->place);
    return runs;
  }

  using Runs = std::vector<std::pair<int, int>>;
} // namespace

BOOST_AUTO_TEST_SUITE(row_patterns)

BOOST_AUTO_TEST_CASE(rows_share_patterns_across_constrained_ones)
{
  const Nodes nodes;
  RowPatterns patterns;
  const auto  of_row = patterns.add(SparseRows(nodes.matrix));
  BOOST_TEST(of_row.size() == 7u);
  for (const unsigned int i : {2, 3, 5})
    BOOST_TEST(of_row[i] == of_row[0]);
  for (const unsigned int i : {1, 4, 6})
    for (unsigned int j = 0; j < i; ++j)
      BOOST_TEST(of_row[i] != of_row[j]);
}

BOOST_AUTO_TEST_CASE(columns_make_runs)
{
  const Nodes nodes;
  RowPatterns patterns;
  const auto  of_row = patterns.add(SparseRows(nodes.matrix));
  BOOST_TEST((runs_of(patterns, of_row[0]) == Runs{{0, 0}, {2, 1}, {5, 3}}));
  BOOST_TEST(patterns.length(of_row[0]) == 4u);
  BOOST_TEST((runs_of(patterns, of_row[4]) == Runs{{4, 0}}));
  BOOST_TEST(patterns.max_length() == 4u);
  // Whoever searches stops at the run after the last.
  BOOST_TEST(patterns.end(of_row[0])->column > 6);
}

BOOST_AUTO_TEST_CASE(other_numbers_make_other_runs)
{
  const Nodes nodes;
  RowPatterns patterns;
  const auto  of_row =
    patterns.add(SparseRows(nodes.matrix), {3, 0, 4, 5, 1, 6, 2});
  BOOST_TEST((runs_of(patterns, of_row[0]) == Runs{{3, 0}}));
  BOOST_TEST((runs_of(patterns, of_row[1]) == Runs{{0, 0}}));
}

BOOST_AUTO_TEST_CASE(rows_that_are_not_kept_are_empty)
{
  const RowPatterns patterns;
  BOOST_TEST(patterns.length(RowPatterns::empty) == 0u);
  BOOST_TEST(
    (patterns.begin(RowPatterns::empty) == patterns.end(RowPatterns::empty)));
}

BOOST_AUTO_TEST_SUITE_END()
