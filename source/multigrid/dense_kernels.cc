// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/multigrid/dense_kernels.h>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define NACRE_TARGET_CLONES \
    __attribute__((           \
      target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#  define NACRE_TARGET_CLONES
#endif

namespace Nacre
{
  namespace DenseKernels
  {
    NACRE_TARGET_CLONES
    void
    dot_products(const unsigned int   n_rows,
                 const unsigned int   n,
                 const double *const *rows,
                 const double        *x,
                 double              *products)
    {
      for (unsigned int k = 0; k < n_rows; ++k)
        {
          const double *a = rows[k];
          double        s = 0.;
#pragma omp simd reduction(+ : s)
          for (unsigned int j = 0; j < n; ++j)
            s += a[j] * x[j];
          products[k] = s;
        }
    }


    NACRE_TARGET_CLONES
    void
    multiply_packed(const unsigned int n,
                    const float       *A,
                    const float       *x,
                    float             *y)
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          const float x_i = x[i];
          float       s   = 0.f;
#pragma omp simd reduction(+ : s)
          for (unsigned int j = 0; j < i; ++j)
            {
              s += A[j] * x[j];
              y[j] += A[j] * x_i;
            }
          y[i] = s + A[i] * x_i;
          A += i + 1;
        }
    }
  } // namespace DenseKernels
} // namespace Nacre
