// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The program of the unit tests.

#define BOOST_TEST_MODULE nacre
#define BOOST_TEST_NO_MAIN
#define BOOST_TEST_ALTERNATIVE_INIT_API
#include <deal.II/base/mpi.h>

#include <boost/test/included/unit_test.hpp>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return boost::unit_test::unit_test_main(&init_unit_test, argc, argv);
}
