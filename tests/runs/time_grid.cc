// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Where the steps of a path end: multiples of the step asked for, halved steps
// between them, longer ones over them, listed times, and the end.

#include <nacre/analysis/time_grid.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>

using Nacre::TimeGrid;

/** The ends of steps from 0, the next sizes of which @p size tells by step. */
template <typename Size>
void
follow(const std::string &title, const TimeGrid &grid, const Size &size)
{
  std::cout << title << ':';
  double t = 0.;
  for (unsigned int step = 0; !grid.is_end(t) && step < 50; ++step)
    {
      t = grid.next(t, size(step));
      std::cout << ' ' << t << (grid.is_listed(t) ? "*" : "");
    }
  std::cout << std::endl;
}

void
check(const std::string &name, const bool good)
{
  std::cout << name << ": " << (good ? "OK" : "FAILED") << std::endl;
}

int
main()
{
  const auto constant = [](const double size) {
    return [size](const unsigned int) { return size; };
  };
  // The first step fails twice; sizes double after two good steps.
  const auto cut_back = [](const unsigned int step) {
    return step < 2 ? 0.05 : step < 4 ? 0.1 : 0.2;
  };
  follow("as asked for", TimeGrid(0.2, 1.), constant(0.2));
  follow("end off the multiples", TimeGrid(0.3, 1.), constant(0.3));
  follow("after cut-backs", TimeGrid(0.2, 1.), cut_back);
  follow("cut to 0.07", TimeGrid(0.2, 0.6), constant(0.07));
  follow("longer steps", TimeGrid(0.1, 1.), constant(0.25));
  follow("longer steps from off the multiples",
         TimeGrid(0.1, 1., {0.33}),
         constant(0.3));
  follow("listed", TimeGrid(0.25, 1., {0.9, 0.3, 0.5}), constant(0.25));
  follow("listed, longer steps", TimeGrid(0.1, 1., {0.35, 1.}), constant(0.5));
  follow("no sliver", TimeGrid(0.3, 0.6001), constant(0.3));

  // No sums: after 10^5 steps each time is the multiple's double.
  const TimeGrid fine(1e-5, 1., {0.3, 0.123456});
  bool           exact = true, listed = false;
  unsigned int   n_multiples = 0;
  for (double t = 0.; !fine.is_end(t);)
    {
      t = fine.next(t, 1e-5);
      if (t == 0.123456)
        listed = true;
      else
        exact = exact && std::abs(t - ++n_multiples * 1e-5) <=
                           std::numeric_limits<double>::epsilon();
    }
  check("at 100000 multiples", exact && n_multiples == 100000);
  check("and at the listed time", listed);

  const TimeGrid grid(0.1, 1.);
  check("steps left", grid.n_steps_left(0.5, 0.1) == 5.);
  check("longer ones", grid.n_steps_left(0.5, 0.25) == 2.);
  check("none", grid.n_steps_left(1., 0.1) == 0.);
  check("few more after a cut-back by 2^20",
        std::abs(grid.n_steps_left(0.5, 0.1 / (1 << 20)) - 45.) < 1e-9);
}
