// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_joined_numbers_h
#define nacre_base_joined_numbers_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace Nacre
{
  /** Disjoint sets of the numbers 0 to n - 1, each named by its smallest. */
  class JoinedNumbers
  {
  public:
    explicit JoinedNumbers(const unsigned int n)
      : root_(n)
    {
      std::iota(root_.begin(), root_.end(), 0u);
    }

    unsigned int
    set_of(unsigned int k)
    {
      while (root_[k] != k)
        k = root_[k] = root_[root_[k]];
      return k;
    }

    void
    join(const unsigned int a, const unsigned int b)
    {
      const unsigned int x = set_of(a), y = set_of(b);
      root_[std::max(x, y)] = std::min(x, y);
    }

  private:
    std::vector<unsigned int> root_;
  };
} // namespace Nacre

#endif
