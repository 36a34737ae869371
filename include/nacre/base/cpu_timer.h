// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_base_cpu_timer_h
#define nacre_base_cpu_timer_h

#include <deal.II/base/mpi.h>

#include <ctime>

namespace Nacre
{
  using namespace dealii;

  /** Adds the CPU seconds of its life on this rank to a sum. */
  class CpuSum
  {
  public:
    explicit CpuSum(double &sum)
      : sum_(sum)
      , start_(std::clock())
    {}

    CpuSum(const CpuSum &) = delete;

    ~CpuSum()
    {
      sum_ += double(std::clock() - start_) / CLOCKS_PER_SEC;
    }

  private:
    double            &sum_;
    const std::clock_t start_;
  };

  /**
   * CPU time of parts of a program: of the user and of the system, to a
   * microsecond (deal.II's Timer: of the user, in steps of the scheduler).
   */
  class CpuTimer
  {
  public:
    /** Starts here; collective. */
    explicit CpuTimer(const MPI_Comm communicator)
      : communicator_(communicator)
    {
      start();
    }

    /**
     * Seconds since the start or the last call, summed over the ranks, which
     * wait for each other. Collective.
     */
    double
    lap()
    {
      wait();
      const double seconds = double(std::clock() - start_) / CLOCKS_PER_SEC;
      const double sum     = Utilities::MPI::sum(seconds, communicator_);
      start();
      return sum;
    }

  private:
    void
    start()
    {
      wait();
      start_ = std::clock();
    }

    void
    wait() const
    {
      const int ierr = MPI_Barrier(communicator_);
      AssertThrowMPI(ierr);
    }

    const MPI_Comm communicator_;
    std::clock_t   start_;
  };
} // namespace Nacre

#endif
