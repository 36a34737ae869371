// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Where the steps of a path end.

#include "unit_test.h"
#include <nacre/analysis/time_grid.h>

using namespace Nacre;

BOOST_AUTO_TEST_SUITE(time_grid)

BOOST_AUTO_TEST_CASE(multiples_are_exact)
{
  const TimeGrid grid(0.1, 1.);
  double         time = 0.;
  for (unsigned int k = 1; k <= 10; ++k)
    {
      BOOST_TEST(!grid.is_end(time));
      time = grid.next(time, 0.1);
      BOOST_TEST(time == (k == 10 ? 1. : k * 0.1));
    }
  BOOST_TEST(grid.is_end(time));
}

BOOST_AUTO_TEST_CASE(halved_steps_return_to_the_grid)
{
  const TimeGrid grid(0.1, 1.);
  const double   quarter = grid.next(0.1, 0.025);
  BOOST_TEST(quarter > 0.1);
  BOOST_TEST(quarter < 0.2);
  // A step that is longer than the gap stops at the grid.
  BOOST_TEST(grid.next(quarter, 0.1) == 2 * 0.1);
}

BOOST_AUTO_TEST_CASE(listed_times_are_met)
{
  const TimeGrid grid(0.4, 1., {0.55, 0.25});
  BOOST_TEST(grid.next(0., 0.4) == 0.25);
  BOOST_TEST(grid.next(0.25, 0.4) == 0.4);
  BOOST_TEST(grid.next(0.4, 0.8) == 0.55);
  BOOST_TEST(grid.is_listed(0.55));
  BOOST_TEST(!grid.is_listed(0.4));
}

BOOST_AUTO_TEST_CASE(steps_left)
{
  const TimeGrid grid(0.1, 1.);
  BOOST_TEST(std::abs(grid.n_steps_left(0.5, 0.1) - 5.) < 1e-9);
  BOOST_TEST(grid.n_steps_left(0.5, 0.05) >= 5.);
  BOOST_TEST(grid.n_steps_left(0.5, 0.05) < 11.);
  BOOST_TEST(grid.n_steps_left(1., 0.1) == 0.);
}

BOOST_AUTO_TEST_SUITE_END()
