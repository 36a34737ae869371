// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_memory_estimate_h
#define nacre_simulation_memory_estimate_h

#include <nacre/base/types.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace Nacre
{
  class Discretization;
  class Log;

  /** Solvers of linear systems, by what they keep. */
  enum class SolverStorage
  {
    factors,
    multigrid
  };

  /**
   * Memory (GB = 1e9 bytes, all ranks together) of a linear solve at its peak,
   * from closed formulas of the dofs N, the degree p and the number of ranks
   * before anything is assembled. Constants: doc/parallel.md, measured.
   */
  struct MemoryEstimate
  {
    /** The program with its libraries, once for each rank. */
    double program = 0.;
    /** Cells, geometry, dof numbers, vectors: proportional to the cells. */
    double mesh = 0.;
    /** 12 bytes for an entry of the rows, and the pattern while it is made. */
    double matrix = 0.;
    /** Factors, of N log2 N entries; or levels and patches. */
    double solver = 0.;

    double
    total() const
    {
      return program + mesh + matrix + solver;
    }

    /** "1.8 GB (matrix 0.4, factors 1.2, ...)" */
    std::string
    text(const SolverStorage storage) const;
  };

  /**
   * Entries of a row of the stiffness matrix, on average over the nodes of a
   * large regular mesh of quadrilaterals: a node couples with all nodes of its
   * cells and of the cells next to these.
   */
  double
  entries_per_row(const unsigned int degree);

  MemoryEstimate
  estimate_memory(const types::global_dof_index n_dofs,
                  const types::global_dof_index n_cells,
                  const unsigned int            degree,
                  const unsigned int            n_ranks,
                  const SolverStorage           storage);

  /** For the system of @p discretization. */
  MemoryEstimate
  estimate_memory(const Discretization &discretization,
                  const SolverStorage   storage);

  /**
   * The largest memory (GB) that the program has had so far, summed over the
   * ranks; what the ranks of a machine share of the program's files counts
   * once. Collective.
   */
  double
  peak_memory(const MPI_Comm communicator);

  /** The memory (GB) that the program has now, likewise. */
  double
  used_memory(const MPI_Comm communicator);

  /** Memory (GB) that the machines of all ranks have free; collective. */
  double
  free_memory(const MPI_Comm communicator);

  /**
   * Throw an ExcMessage if the @p estimate is more than half as much again as
   * @p available (GB on all machines together): a run that the system would
   * end without a word.
   * @return a warning if it is more than what is available, else ""
   */
  std::string
  check_memory(const MemoryEstimate &estimate,
               const SolverStorage   storage,
               const double          available);

  /**
   * Tell the estimate if it is worth it, and judge it against what is @p free
   * (GB on all machines together) and in use already. Collective.
   */
  void
  report_memory(const Discretization &discretization,
                const SolverStorage   storage,
                const double          free,
                Log                  &log);
} // namespace Nacre

#endif
