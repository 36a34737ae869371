// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_blas_check_h
#define nacre_solvers_blas_check_h

#include <string>

namespace Nacre
{
  /**
   * OpenBLAS takes kernels without AVX on processors newer than itself, which
   * makes factorisations two times slower.
   */
  namespace BlasCheck
  {
    /** Vector instructions of a processor that OpenBLAS has kernels for. */
    enum class VectorUnit
    {
      other,
      avx2,
      avx512
    };

    /** What this processor has; other if it isn't known. */
    VectorUnit
    processor();

    /** Name of OpenBLAS' kernels in use; empty with another BLAS. */
    std::string
    kernel();

    /**
     * A warning with its remedy if OpenBLAS' @p kernel leaves the vector unit
     * unused, else an empty text. Names are compared without case.
     */
    std::string
    complaint(const std::string &kernel, const VectorUnit unit);
  } // namespace BlasCheck
} // namespace Nacre

#endif
