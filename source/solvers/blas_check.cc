// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/blas_check.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <dlfcn.h>

#include <algorithm>
#include <array>

namespace Nacre
{
  namespace BlasCheck
  {
    VectorUnit
    processor()
    {
#if defined(__x86_64__) && defined(__GNUC__)
      if (__builtin_cpu_supports("avx512f") &&
          __builtin_cpu_supports("avx512vl"))
        return VectorUnit::avx512;
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return VectorUnit::avx2;
#endif
      return VectorUnit::other;
    }

    std::string
    kernel()
    {
      // The function is looked up at run time, so that any other BLAS will do.
      using Function      = char *(*)();
      const auto function = reinterpret_cast<Function>(
        dlsym(RTLD_DEFAULT, "openblas_get_corename"));
      return function == nullptr ? "" : function();
    }

    std::string
    complaint(const std::string &kernel, const VectorUnit unit)
    {
      // OpenBLAS' names of x86 kernels without AVX, and of those with AVX only.
      static const std::array<const char *, 18> slow = {{"generic",
                                                         "katmai",
                                                         "coppermine",
                                                         "northwood",
                                                         "prescott",
                                                         "banias",
                                                         "core2",
                                                         "penryn",
                                                         "dunnington",
                                                         "atom",
                                                         "nehalem",
                                                         "athlon",
                                                         "opteron",
                                                         "opteron_sse3",
                                                         "barcelona",
                                                         "bobcat",
                                                         "nano",
                                                         "sandybridge"}};
      if (unit == VectorUnit::other ||
          std::find(slow.begin(),
                    slow.end(),
                    boost::algorithm::to_lower_copy(kernel)) == slow.end())
        return "";
      const bool avx512 = (unit == VectorUnit::avx512);
      return "OpenBLAS uses its kernels '" + kernel + "', which leave the " +
             (avx512 ? "AVX-512" : "AVX2") +
             " unit of this processor unused and make solvers about two times "
             "slower; set the environment variable OPENBLAS_CORETYPE=" +
             (avx512 ? "SKYLAKEX" : "HASWELL") +
             ", as '. scripts/environment' does.";
    }
  } // namespace BlasCheck
} // namespace Nacre
