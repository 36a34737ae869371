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
      unsigned int k = 0;
      // Four at a time: x is read once, and the sums don't wait for each other.
      for (; k + 4 <= n_rows; k += 4)
        {
          const double *a_0 = rows[k], *a_1 = rows[k + 1], *a_2 = rows[k + 2],
                       *a_3 = rows[k + 3];
          double s_0 = 0., s_1 = 0., s_2 = 0., s_3 = 0.;
#pragma omp simd reduction(+ : s_0, s_1, s_2, s_3)
          for (unsigned int j = 0; j < n; ++j)
            {
              s_0 += a_0[j] * x[j];
              s_1 += a_1[j] * x[j];
              s_2 += a_2[j] * x[j];
              s_3 += a_3[j] * x[j];
            }
          products[k]     = s_0;
          products[k + 1] = s_1;
          products[k + 2] = s_2;
          products[k + 3] = s_3;
        }
      for (; k < n_rows; ++k)
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
