// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/anderson_mixing.h>

namespace Nacre
{
  void
  AndersonMixing::reset()
  {
    changes_.clear();
    last_.clear();
  }

  void
  AndersonMixing::learn(const Vector &u, const Vector &du)
  {
    Vector change_u(u), change_g(du);
    change_u -= last_.front().first;
    change_g -= last_.front().second;
    const double length = change_g.l2_norm();
    for (const auto &[x, g] : changes_)
      {
        const double share = g * change_g;
        change_g.add(-share, g);
        change_u.add(-share, x);
      }
    const double rest = change_g.l2_norm();
    // What is left by cancellation tells nothing new.
    if (!(rest > 1e-6 * length))
      return;
    change_g /= rest;
    change_u /= rest;
    changes_.emplace_back(change_u, change_g);
  }

  void
  AndersonMixing::improve(const Vector &u, Vector &du)
  {
    if (!last_.empty())
      learn(u, du);
    last_.assign(1, {u, du});
    for (const auto &[x, g] : changes_)
      {
        const double share = g * du;
        du.add(-share, g);
      }
    // The shares of the original increment, since the changes are orthonormal
    for (const auto &[x, g] : changes_)
      du.add(-(g * last_.front().second), x);
  }
} // namespace Nacre
