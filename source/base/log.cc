// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>

#include <iostream>

namespace Nacre
{
  using namespace dealii;

  Log::Log(const MPI_Comm communicator, const bool quiet)
    : quiet_(quiet)
    , progress_(std::cout,
                !quiet && Utilities::MPI::this_mpi_process(communicator) == 0)
    , results_(std::cout, Utilities::MPI::this_mpi_process(communicator) == 0)
    , errors_(std::cerr, Utilities::MPI::this_mpi_process(communicator) == 0)
  {}

  ConditionalOStream &
  Log::progress()
  {
    return progress_;
  }

  ConditionalOStream &
  Log::results()
  {
    return results_;
  }

  bool
  Log::tell_once(const std::string &line)
  {
    if (!told_.insert(line).second)
      return false;
    // Keep the order of the two streams on a terminal.
    std::cout << std::flush;
    errors_ << line << std::endl;
    return true;
  }

  void
  Log::warning(const std::string &text)
  {
    n_warnings_ += tell_once("nacre: warning: " + text) ? 1 : 0;
  }

  void
  Log::note(const std::string &text)
  {
    tell_once("nacre: note: " + text);
  }

  bool
  Log::is_quiet() const
  {
    return quiet_;
  }
} // namespace Nacre
