// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_simd_h
#define nacre_base_simd_h

/**
 * Before a function of plain loops over arrays: compiled for AVX-512, for AVX2
 * and for any processor; the program's start picks one of the three.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
  defined(__OPTIMIZE__)
#  define NACRE_SIMD  \
    __attribute__((   \
      optimize("O3"), \
      target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#  define NACRE_SIMD
#endif

#endif
