// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_simulation_discrete_shell_h
#define nacre_simulation_discrete_shell_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/assembly.h>
#include <nacre/simulation/shell_problem.h>

#include <memory>

namespace Nacre
{
  class Log;

  /** The mesh of a problem before any adaptive refinement. Collective. */
  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  create_mesh(const MPI_Comm communicator, const ShellProblem &problem);

  /**
   * A shell on one mesh: its discretisation, supports and forms, and the solver
   * of its linear systems. The members are built in the order in which they
   * stand, each of those before it.
   */
  class DiscreteShell
  {
  public:
    using Mesh = parallel::TriangulationBase<dim, spacedim>;

    /**
     * All that can be found wrong before a system is assembled is found here,
     * as rigid motions left free, which are named; throws ExcMessage. Tells
     * warnings and the memory that a solve takes. Collective.
     * @param problem must live as long
     * @param mesh of the mid-surface; null: that of the problem
     * @param n_right_hand_sides how often each matrix is solved with
     */
    DiscreteShell(const MPI_Comm        communicator,
                  const ShellProblem   &problem,
                  std::unique_ptr<Mesh> mesh,
                  const unsigned int    n_right_hand_sides,
                  Log                  &log);

    const ShellProblem &
    problem() const
    {
      return problem_;
    }

    const Discretization &
    discretization() const
    {
      return discretization_;
    }

    /** With the prescribed displacements at t = 0 with the factor 1. */
    const DisplacementConditions &
    conditions() const
    {
      return conditions_;
    }

    const Assembly &
    assembly() const
    {
      return assembly_;
    }

    ChosenSolver &
    solver()
    {
      return *solver_;
    }

    /** A zero vector of owned entries. */
    TrilinosWrappers::MPI::Vector
    owned_vector() const
    {
      return TrilinosWrappers::MPI::Vector(discretization_.locally_owned_dofs(),
                                           discretization_.communicator());
    }

    /** The same with ghosts of all dofs that constraints mention. */
    TrilinosWrappers::MPI::Vector
    ghosted_vector() const
    {
      return TrilinosWrappers::MPI::Vector(discretization_.locally_owned_dofs(),
                                           conditions_.relevant_dofs(),
                                           discretization_.communicator());
    }

    /**
     * Evaluate all loads and stiffnesses on the undeformed shell at t = 0, and
     * throw what is wrong with one. Collective.
     */
    void
    check_integrands() const;

    /** Hand over the mesh; the shell can only be destroyed after that. */
    std::unique_ptr<Mesh>
    release_mesh()
    {
      return discretization_.release_triangulation();
    }

  private:
    void
    warn_of_penalty(Log &log) const;

    std::unique_ptr<ChosenSolver>
    make_solver(const unsigned int n_right_hand_sides, Log &log) const;

    const ShellProblem          &problem_;
    Discretization               discretization_;
    const DisplacementConditions conditions_;
    const Assembly               assembly_;
    /** Refers to the members before it. */
    std::unique_ptr<ChosenSolver> solver_;
  };
} // namespace Nacre

#endif
