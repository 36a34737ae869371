// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/simulation/path_quantities.h>
#include <nacre/simulation/stepped_shell.h>

#include <utility>

namespace Nacre
{
  SteppedShell::SteppedShell(const MPI_Comm                       communicator,
                             const ShellProblem                  &problem,
                             const QuantitiesOfInterest          &quantities,
                             std::unique_ptr<DiscreteShell::Mesh> mesh,
                             Log                                 &log)
    : shell(communicator, problem, std::move(mesh), 1, log)
    , system(shell.discretization(),
             shell.assembly(),
             problem.model,
             shell.solver())
    , path(problem.path, system, *problem.model.section)
  {
    check_path_quantities(problem.path,
                          quantities,
                          problem.model.kinematics.model);
    if (problem.path.controls_displacement())
      path.curve()->control(controlled_quantity(quantities, shell, system));
  }

  namespace
  {
    /** a + c v, ghosted. */
    TrilinosWrappers::MPI::Vector
    acceleration_at(const PathState      &state,
                    const PathParameters &path,
                    const ShellSystem    &system)
    {
      TrilinosWrappers::MPI::Vector w(state.motion.a);
      w.add(path.mass_damping, state.motion.v);
      return system.with_ghosts(w);
    }

    TrilinosWrappers::MPI::Vector
    displacement_at(const PathState &state, ShellSystem &system)
    {
      system.set_time(state.time);
      return system.with_ghosts(state.motion.u);
    }
  } // namespace

  SolvedState::SolvedState(const PathState     &state,
                           const DiscreteShell &shell,
                           const PathAnalysis  &path,
                           ShellSystem         &system)
    : displacement_(displacement_at(state, system))
    , velocity_(system.with_ghosts(state.motion.v))
    , acceleration_(acceleration_at(state, shell.problem().path, system))
    , residual_(shell.owned_vector())
    , shell_{{shell.discretization(),
              shell.problem().model,
              displacement_,
              system.actions().loads,
              &shell.assembly().section_states()},
             shell.assembly(),
             system.actions(),
             shell.conditions(),
             residual_,
             forces(shell, path, system),
             path.dynamic_mass(),
             &velocity_,
             path.dynamic_mass() != nullptr ? &acceleration_ : nullptr,
             state.balance}
  {}

  Energies
  SolvedState::forces(const DiscreteShell &shell,
                      const PathAnalysis  &path,
                      const ShellSystem   &system)
  {
    const MassTerms *const mass     = path.dynamic_mass();
    const Assembly        &assembly = shell.assembly();
    if (mass == nullptr)
      return assembly.residual(displacement_, system.actions(), residual_);
    const Inertia inertia{*mass, acceleration_, 0.};
    const auto    energies =
      assembly.residual(displacement_, system.actions(), residual_, &inertia);
    system.add_held_forces(-1., residual_);
    return energies;
  }
} // namespace Nacre
