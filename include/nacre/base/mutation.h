// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_mutation_h
#define nacre_base_mutation_h

/**
 * A factor that tests/mutations may falsify, to prove that a test notices:
 * in the product it is the value and nothing else.
 */
#ifdef NACRE_MUTATIONS
namespace Nacre
{
  /** Whether the environment variable NACRE_MUTANT is @p name. */
  bool
  is_mutant(const char *name);
} // namespace Nacre
#  define NACRE_MUTABLE(name, value, mutated) \
    (Nacre::is_mutant(#name) ? (mutated) : (value))
#else
#  define NACRE_MUTABLE(name, value, mutated) (value)
#endif

#endif
