// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_mpi_errors_h
#define nacre_base_mpi_errors_h

#include <deal.II/base/mpi.h>

#include <exception>
#include <functional>
#include <string>

namespace Nacre
{
  /**
   * What to tell the user: an ExcMessage's text alone; everything that
   * deal.II knows of its other exceptions; what() of the rest.
   */
  std::string
  error_text(const std::exception &exception);

  /**
   * Call @p run on every rank and return what it returns. If it throws on all
   * ranks, rank 0 prints "nacre: error: text" and every rank returns 1. If it
   * throws on some ranks only, those can't be sure that the others will ever
   * come back from their communication: they print the text and end the
   * program on all ranks (MPI_Abort) after a few seconds. Collective.
   */
  int
  run_guarded(const MPI_Comm communicator, const std::function<int()> &run);

  /**
   * Call @p function on rank 0 only, as for writing a file. If it throws there,
   * every rank throws an ExcMessage of the same text. Collective.
   */
  void
  run_on_root(const MPI_Comm               communicator,
              const std::function<void()> &function);

  /**
   * Call @p function, which must not communicate, on all ranks. If it throws
   * on some, every rank throws an ExcMessage of the lowest one's text, so that
   * none waits for another. Collective.
   */
  void
  run_on_all_ranks(const MPI_Comm               communicator,
                   const std::function<void()> &function);
} // namespace Nacre

#endif
