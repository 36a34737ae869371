// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// OpenBLAS kernels that leave the processor's vector unit unused are warned
// about, by name and in processes that are made to use them.

#include "../tests_common.h"
#include <nacre/solvers/blas_check.h>

using namespace Nacre::BlasCheck;

/** Whether this very program, with these kernels, has something to complain. */
bool
complains(const std::string &program, const std::string &kernel)
{
  return std::system(("OPENBLAS_CORETYPE=" + kernel + " " + program + " child")
                       .c_str()) != 0;
}

int
main(int argc, char *argv[])
{
  if (argc > 1)
    return complaint(kernel(), processor()).empty() ? 0 : 1;

  for (const std::string name : {"Prescott", "Nehalem", "Core2", "Katmai"})
    {
      const auto text = complaint(name, VectorUnit::avx512);
      Tests::check_below(name + ": silent",
                         text.find("OPENBLAS_CORETYPE=SKYLAKEX") ==
                           std::string::npos,
                         0.5);
      Tests::check_below(
        name + ", AVX2: silent",
        complaint(name, VectorUnit::avx2).find("OPENBLAS_CORETYPE=HASWELL") ==
          std::string::npos,
        0.5);
      Tests::check_below(name + ", no AVX: complaint",
                         !complaint(name, VectorUnit::other).empty(),
                         0.5);
    }
  for (const std::string name :
       {"SkylakeX", "Haswell", "Zen", "Cooperlake", "Sapphirerapids", ""})
    Tests::check_below("'" + name + "': complaint",
                       !complaint(name, VectorUnit::avx512).empty(),
                       0.5);

  // Other libraries than OpenBLAS and older processors are never complained of.
  const bool relevant = !kernel().empty() && processor() != VectorUnit::other;
  Tests::check_below("run with Prescott: silent",
                     relevant && !complains(argv[0], "Prescott"),
                     0.5);
  Tests::check_below("run with Haswell: complaint",
                     complains(argv[0], "Haswell"),
                     0.5);
  return Tests::n_failures > 0;
}
