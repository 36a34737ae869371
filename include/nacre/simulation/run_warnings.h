// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_run_warnings_h
#define nacre_simulation_run_warnings_h

#include <deal.II/lac/trilinos_vector.h>

/** Warnings of what a run can compute, but a user can hardly mean. */
namespace Nacre
{
  class Discretization;
  class Log;
  class Expression;
  struct ProblemRecord;

  /** That a path has linear kinematics. */
  void
  warn_of_linear_path(Log &log);

  /**
   * That the ghosted @p displacement, of linear kinematics, is larger than the
   * shell. Collective.
   */
  void
  warn_of_large_displacements(
    const Discretization                        &discretization,
    const dealii::TrilinosWrappers::MPI::Vector &displacement,
    Log                                         &log);

  /** That the load factor and what it multiplies both depend on t. */
  void
  warn_of_load_factor(const Expression    &load_factor,
                      const ProblemRecord &problem,
                      Log                 &log);
} // namespace Nacre

#endif
