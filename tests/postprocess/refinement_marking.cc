// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Doerfler's marking takes the smallest set that reaches the fraction, fixed
// fractions the right number of cells; ties go together; the choice doesn't
// depend on the number of ranks.

#include <nacre/postprocess/refinement_marking.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

using namespace Nacre;

namespace
{
  const MPI_Comm world = MPI_COMM_WORLD;

  void
  report(const bool good, const std::string &text)
  {
    if (Utilities::MPI::this_mpi_process(world) == 0)
      std::cout << (good ? "OK   " : "FAIL ") << text << std::endl;
  }

  /** The values number rank, rank + n, rank + 2 n, ... */
  std::vector<double>
  mine(const std::vector<double> &all)
  {
    const unsigned int  n = Utilities::MPI::n_mpi_processes(world);
    std::vector<double> values;
    for (std::size_t k = Utilities::MPI::this_mpi_process(world);
         k < all.size();
         k += n)
      values.push_back(all[k]);
    return values;
  }

  /** Number and sum of the values marked on all ranks, and the least of them.*/
  struct Marked
  {
    Marked(const std::vector<double> &all, const std::vector<bool> &marked)
    {
      const auto values = mine(all);
      for (std::size_t k = 0; k < values.size(); ++k)
        if (marked[k])
          {
            ++number;
            sum += values[k];
            least = std::min(least, values[k]);
          }
      number = Utilities::MPI::sum(number, world);
      sum    = Utilities::MPI::sum(sum, world);
      least  = Utilities::MPI::min(least, world);
    }

    unsigned int number = 0;
    double       sum    = 0.;
    double       least  = 1e300;
  };

  /** Over twelve orders of magnitude, without order. */
  std::vector<double>
  spread_values()
  {
    std::vector<double> all(1000);
    for (unsigned int k = 0; k < all.size(); ++k)
      all[k] = std::pow(10., 6. * std::sin(1000. * (k + 1)));
    return all;
  }

  void
  test_bulk(const double fraction)
  {
    const auto   all   = spread_values();
    const double total = std::accumulate(all.begin(), all.end(), 0.);
    const Marked marked(all,
                        RefinementMarking::bulk(mine(all), fraction, world));

    auto sorted = all;
    std::sort(sorted.rbegin(), sorted.rend());
    unsigned int n   = 0;
    double       sum = 0.;
    while (sum < (1. - 1e-12) * fraction * total)
      sum += sorted[n++];
    const std::string name = "Doerfler " + std::to_string(fraction);
    report(marked.sum >= (1. - 1e-10) * fraction * total, name + ": enough");
    report(marked.number == n, name + ": no more than needed");
    report(marked.least == sorted[n - 1], name + ": the largest");
  }

  void
  test_fixed_fraction(const double fraction, const unsigned int expected)
  {
    const auto   all = spread_values();
    const Marked marked(
      all,
      RefinementMarking::fixed_fraction(mine(all), fraction, 1000, world));
    report(marked.number == expected,
           "fixed fraction: " + std::to_string(expected) + " cells");
  }

  void
  test_ties()
  {
    // Four cells equal but for round-off, of which two would suffice.
    std::vector<double> all(40, 1e-3);
    for (unsigned int k = 0; k < 4; ++k)
      all[10 * k] = 1. + 1e-12 * k;
    report(Marked(all, RefinementMarking::bulk(mine(all), 0.5, world)).number ==
             4,
           "ties go together");
    all.assign(40, 0.);
    report(Marked(all, RefinementMarking::bulk(mine(all), 0.5, world)).number ==
             0,
           "no error, no refinement");
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double fraction : {0.1, 0.5, 0.9, 1.})
    test_bulk(fraction);
  test_fixed_fraction(0.25, 250);
  test_fixed_fraction(1e-9, 1);
  test_fixed_fraction(1., 1000);
  test_ties();
}
