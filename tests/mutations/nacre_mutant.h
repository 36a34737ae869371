// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_mutant_h
#define nacre_mutant_h

namespace Nacre
{
  /** Whether the environment variable NACRE_MUTANT is @p name. */
  bool
  is_mutant(const char *name);
} // namespace Nacre

#endif
