// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Sizes of the steps of a path. All sizes are powers of two: no round-off.

#include "unit_test.h"
#include <nacre/analysis/step_control.h>

using namespace Nacre;

namespace
{
  const StepControl control(0.125, 4., 10);
}

BOOST_AUTO_TEST_SUITE(step_control)

BOOST_AUTO_TEST_CASE(two_good_steps_double_the_next)
{
  StepSize size{1., 0};
  control.accept(size, 5);
  BOOST_TEST(size.next_step == 1.);
  control.accept(size, 5);
  BOOST_TEST(size.next_step == 2.);
  // The count starts again after a change of size.
  control.accept(size, 1);
  BOOST_TEST(size.next_step == 2.);
}

BOOST_AUTO_TEST_CASE(many_iterations_keep_the_size)
{
  StepSize size{1., 0};
  for (unsigned int k = 0; k < 5; ++k)
    {
      control.accept(size, 5);
      control.accept(size, 6);
    }
  BOOST_TEST(size.next_step == 1.);
  BOOST_TEST(size.n_good_steps == 0u);
}

BOOST_AUTO_TEST_CASE(growth_ends_at_the_maximum)
{
  StepSize size{3., 1};
  control.accept(size, 1);
  BOOST_TEST(size.next_step == 4.);
  control.accept(size, 1);
  control.accept(size, 1);
  BOOST_TEST(size.next_step == 4.);
  // A step beyond the maximum was the user's choice.
  size = {8., 1};
  control.accept(size, 1);
  BOOST_TEST(size.next_step == 8.);
}

BOOST_AUTO_TEST_CASE(failure_halves_down_to_the_minimum)
{
  // The step that failed may be shorter than the next one was meant to be.
  StepSize size{1., 1};
  BOOST_TEST(control.reject(size, 0.5));
  BOOST_TEST(size.next_step == 0.25);
  BOOST_TEST(size.n_good_steps == 0u);
  BOOST_TEST(control.reject(size, 0.25));
  BOOST_TEST(size.next_step == 0.125);
  BOOST_TEST(!control.reject(size, 0.125));
}

BOOST_AUTO_TEST_SUITE_END()
