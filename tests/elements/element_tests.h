// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_element_tests_h
#define nacre_tests_element_tests_h

#include <nacre/elements/fe_serendipity.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

/** What the tests of elements share: no more than the element's own headers. */
namespace ElementTests
{
  using namespace Nacre;

  const MPI_Comm comm = MPI_COMM_WORLD;

  inline unsigned int n_failures = 0;

  /**
   * Rank 0 prints "name: OK (< bound)" if the largest value of all ranks is
   * below it, the value too if it isn't or if NACRE_TEST_VALUES is set.
   */
  inline void
  check(const std::string &name,
        const bool         good,
        const double       value,
        const std::string &relation)
  {
    n_failures += (good ? 0 : 1);
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    std::cout << name << ": " << (good ? "OK" : "FAILED");
    if (!good || std::getenv("NACRE_TEST_VALUES") != nullptr)
      std::cout << ", " << value;
    std::cout << " (" << relation << ')' << std::endl;
  }

  /** NaN is a failure. */
  inline void
  check_below(const std::string &name, const double value, const double bound)
  {
    const double largest =
      Utilities::MPI::max(std::isnan(value) ? 1e300 : value, comm);
    std::ostringstream relation;
    relation << "< " << bound;
    check(name, largest < bound, largest, relation.str());
  }

  /** The largest value of all ranks is above the bound. */
  inline void
  check_above(const std::string &name, const double value, const double bound)
  {
    const double       largest = Utilities::MPI::max(value, comm);
    std::ostringstream relation;
    relation << "> " << bound;
    check(name, largest > bound, largest, relation.str());
  }

  inline void
  check_equal(const std::string  &name,
              const std::uint64_t value,
              const std::uint64_t expected)
  {
    check(name, value == expected, value, "= " + std::to_string(expected));
  }

  /** The larger one; NaN wins. */
  inline void
  raise(double &largest, const double value)
  {
    if (!(value <= largest))
      largest = value;
  }
} // namespace ElementTests

#endif
