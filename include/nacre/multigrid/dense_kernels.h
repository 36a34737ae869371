// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_dense_kernels_h
#define nacre_multigrid_dense_kernels_h

namespace Nacre
{
  /**
   * Small dense products. The compiler makes versions for several generations
   * of x86-64, of which the loader takes the best one: deal.II's packages, and
   * the flags they hand on, are for the oldest.
   */
  namespace DenseKernels
  {
    /** The dot products of @p n_rows arrays of length @p n with @p x. */
    void
    dot_products(const unsigned int   n_rows,
                 const unsigned int   n,
                 const double *const *rows,
                 const double        *x,
                 double              *products);

    /**
     * y = A x for a symmetric matrix of @p n rows, of which the lower triangle
     * is stored row by row.
     */
    void
    multiply_packed(const unsigned int n,
                    const float       *A,
                    const float       *x,
                    float             *y);
  } // namespace DenseKernels
} // namespace Nacre

#endif
