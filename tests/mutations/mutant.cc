// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre_mutant.h>

#include <cstdlib>
#include <cstring>

namespace Nacre
{
  bool
  is_mutant(const char *name)
  {
    static const char *const mutant = std::getenv("NACRE_MUTANT");
    return mutant != nullptr && std::strcmp(mutant, name) == 0;
  }
} // namespace Nacre
