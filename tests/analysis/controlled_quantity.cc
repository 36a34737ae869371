// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Derivatives of a controlled quantity by differences: of a smooth one, of one
// with a kink, of one that is smooth in a small reach only, of round-off.

#include "../tests_common.h"
#include <nacre/analysis/controlled_quantity.h>

#include <cmath>

using namespace Tests;

using Quantity = std::function<double(const TrilinosVector &, const double)>;

/** The slope along (1, 2) at (u_0, 0.3), t = 2. */
ControlledQuantity::Slope
slope(const Quantity &quantity, const double u_0)
{
  TrilinosVector u(complete_index_set(2)), v(complete_index_set(2));
  u(0) = u_0;
  u(1) = 0.3;
  v(0) = 1.;
  v(1) = 2.;
  return ControlledQuantity::by_differences(quantity, u, 2., 1e-3, 1e-3)
    .slope(v);
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Quantity smooth = [](const auto &u, const double t) {
    return std::exp(u(0)) + u(0) * u(1) * u(1) + t * std::sin(u(1));
  };
  const double exact =
    std::exp(0.5) + 0.3 * 0.3 + 2. * (2. * 0.5 * 0.3 + 2. * std::cos(0.3));
  const auto found = slope(smooth, 0.5);
  check_below("slope", std::abs(found.value / exact - 1.), 1e-6);
  check_below("what it may be wrong by", found.error / exact, 0.1);

  TrilinosVector u(complete_index_set(2));
  u(1)          = 0.3;
  const auto at = ControlledQuantity::by_differences(smooth, u, 2., 1., 1e-3);
  check_below("value",
              std::abs(at.value / (1. + 2. * std::sin(0.3)) - 1.),
              1e-14);
  check_below("rate", std::abs(at.rate / std::sin(0.3) - 1.), 1e-9);

  const Quantity kink = [](const auto &w, const double) {
    return 2. * std::abs(w(0)) + std::abs(5e-4 - w(0));
  };
  check_below("ahead of a kink", std::abs(slope(kink, 5e-4).value - 3.), 1e-9);
  check_below("from one to another",
              std::abs(slope(kink, 0.).value - 1.),
              1e-9);
  const Quantity square = [](const auto &w, const double) {
    return w(0) * w(0);
  };
  const Quantity round_off = [](const auto &w, const double) {
    return 1e-16 * std::sin(1e9 * w(0));
  };
  for (const auto &[name, quantity, u_0] :
       std::vector<std::tuple<std::string, Quantity, double>>{
         {"a square at rest", square, 0.},
         {"round-off", round_off, 0.3}})
    {
      const auto none = slope(quantity, u_0);
      check_above(name + " has no slope",
                  none.error / std::abs(none.value),
                  1.);
    }
  return n_failures > 0;
}
