// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/log.h>
#include <nacre/discretization/discretization.h>
#include <nacre/simulation/memory_estimate.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Nacre
{
  namespace
  {
    constexpr double giga = 1e9;

    /** Measured: doc/parallel.md tells how to repeat it. */
    constexpr double bytes_of_program = 0.18e9;
    /** For each node of each cell: geometry, numbers, constraints. */
    constexpr double bytes_per_cell_node = 500.;
    /** 8 for the number, 4 for its column. */
    constexpr double bytes_per_entry = 12.;
    /** Of the direct solver: bytes / (N log2 N), by degree from 2. */
    constexpr double bytes_of_factors[] = {420., 660., 900., 1150.};
    /** Levels, prolongations, patches: bytes / N by degree from 2. */
    constexpr double bytes_of_levels[] = {1700., 1900., 2500., 3500.};
    /** Factors of the coarsest level. */
    constexpr double bytes_of_coarsest_level = 0.1e9;

    std::string
    in_gigabytes(const double value)
    {
      std::ostringstream text;
      text << std::setprecision(2) << value;
      return text.str();
    }
  } // namespace

  double
  entries_per_row(const unsigned int degree)
  {
    const double p = degree;
    // Nodes of a cell and its four neighbours, of the eight cells around an
    // edge and of the twelve around a vertex.
    const double of_cell   = (p + 1.) * (p + 1.) + 4. * (p + 1.) * p;
    const double of_edge   = (2. * p + 1.) * (3. * p + 1.) + 2. * (p + 1.) * p;
    const double of_vertex = (2. * p + 1.) * (2. * p + 1. + 4. * p);
    // A cell's share of nodes: (p - 1)^2 inside, 2 (p - 1) on edges, a vertex.
    return spacedim *
           ((p - 1.) * (p - 1.) * of_cell + 2. * (p - 1.) * of_edge +
            of_vertex) /
           (p * p);
  }

  MemoryEstimate
  estimate_memory(const types::global_dof_index n_dofs,
                  const types::global_dof_index n_cells,
                  const unsigned int            degree,
                  const unsigned int            n_ranks,
                  const SolverStorage           storage)
  {
    Assert(degree >= 2 && degree <= 5, ExcNotImplemented());
    const double   n = n_dofs;
    MemoryEstimate estimate;
    estimate.program = n_ranks * bytes_of_program / giga;
    estimate.mesh =
      bytes_per_cell_node * n_cells * (degree + 1) * (degree + 1) / giga;
    estimate.matrix = bytes_per_entry * entries_per_row(degree) * n / giga;
    estimate.solver =
      (storage == SolverStorage::factors ?
         bytes_of_factors[degree - 2] * n * std::log2(n + 1.) :
         bytes_of_levels[degree - 2] * n + bytes_of_coarsest_level) /
      giga;
    return estimate;
  }

  MemoryEstimate
  estimate_memory(const Discretization &discretization,
                  const SolverStorage   storage)
  {
    return estimate_memory(
      discretization.n_dofs(),
      discretization.triangulation().n_global_active_cells(),
      discretization.degree(),
      Utilities::MPI::n_mpi_processes(discretization.communicator()),
      storage);
  }

  std::string
  MemoryEstimate::text(const SolverStorage storage) const
  {
    return in_gigabytes(total()) + " GB (program " + in_gigabytes(program) +
           ", mesh " + in_gigabytes(mesh) + ", matrix " + in_gigabytes(matrix) +
           (storage == SolverStorage::factors ? ", factors " : ", levels ") +
           in_gigabytes(solver) + ")";
  }

  namespace
  {
    /**
     * The number of bytes behind @p key in a file of Linux that counts in kB
     * of 1024 bytes; -1 where there is none.
     */
    double
    read_bytes(const std::string &file, const std::string &key)
    {
      std::ifstream lines(file);
      for (std::string line; std::getline(lines, line);)
        if (line.rfind(key + ":", 0) == 0)
          return 1024. * std::strtod(line.c_str() + key.size() + 1, nullptr);
      return -1.;
    }

    /** Number of ranks on the machine of this one; collective. */
    unsigned int
    n_ranks_here(const MPI_Comm communicator)
    {
      MPI_Comm machine;
      int      ierr = MPI_Comm_split_type(communicator,
                                     MPI_COMM_TYPE_SHARED,
                                     0,
                                     MPI_INFO_NULL,
                                     &machine);
      AssertThrowMPI(ierr);
      const unsigned int result = Utilities::MPI::n_mpi_processes(machine);
      ierr                      = MPI_Comm_free(&machine);
      AssertThrowMPI(ierr);
      return result;
    }

    /**
     * The processes' memory of kind @p key, summed over the ranks, those of a
     * machine sharing the pages that are parts of files: the program.
     */
    double
    sum_memory(const std::string &key, const MPI_Comm communicator)
    {
      const std::string file     = "/proc/self/status";
      const double      mine     = std::max(read_bytes(file, key), 0.);
      const double      of_files = std::max(read_bytes(file, "RssFile"), 0.);
      const double      others   = 1. - 1. / n_ranks_here(communicator);
      return Utilities::MPI::sum(mine - others * of_files, communicator) / giga;
    }
  } // namespace

  double
  peak_memory(const MPI_Comm communicator)
  {
    return sum_memory("VmHWM", communicator);
  }

  double
  used_memory(const MPI_Comm communicator)
  {
    return sum_memory("VmRSS", communicator);
  }

  double
  free_memory(const MPI_Comm communicator)
  {
    const double bytes = read_bytes("/proc/meminfo", "MemAvailable");
    // Where nothing is known, memory doesn't decide.
    const double mine = bytes < 0. ? 1e15 : bytes / n_ranks_here(communicator);
    return Utilities::MPI::sum(mine, communicator) / giga;
  }

  std::string
  check_memory(const MemoryEstimate &estimate,
               const SolverStorage   storage,
               const double          available)
  {
    const std::string found = "The linear system takes about " +
                              estimate.text(storage) + " of memory; " +
                              in_gigabytes(available) + " GB are free";
    AssertThrow(estimate.total() <= 1.5 * available,
                ExcMessage(found +
                           ": use fewer refinements, a lower degree, "
                           "'Linear solver/Solver = multigrid', or more "
                           "machines."));
    return estimate.total() > available ? found + "." : "";
  }

  void
  report_memory(const Discretization &discretization,
                const SolverStorage   storage,
                const double          free,
                Log                  &log)
  {
    const auto estimate = estimate_memory(discretization, storage);
    // The program's own share grows with the ranks: no news.
    if (estimate.total() - estimate.program >= 0.12)
      log.progress() << "memory: about " << estimate.text(storage) << std::endl;
    // Part of the estimate is in use already.
    const std::string warning =
      check_memory(estimate,
                   storage,
                   free + used_memory(discretization.communicator()));
    if (!warning.empty())
      log.warning(warning);
  }
} // namespace Nacre
