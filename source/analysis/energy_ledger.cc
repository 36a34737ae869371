// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/energy_ledger.h>

#include <algorithm>
#include <cmath>

namespace Nacre
{
  EnergyLedger::EnergyLedger(ShellSystem     &system,
                             const MassTerms &mass,
                             const double     damping)
    : system_(system)
    , mass_(mass)
    , damping_(damping)
  {}

  double
  EnergyLedger::kinetic_energy(const Vector &v) const
  {
    Vector momentum = system_.owned_vector();
    mass_.vmult(momentum, system_.with_ghosts(v));
    return 0.5 * (momentum * v);
  }

  EnergyBalance
  EnergyLedger::start(const MotionState &motion, const double dt) const
  {
    EnergyBalance balance;
    balance.is_kept = true;
    balance.kinetic = kinetic_energy(motion.v);
    balance.strain =
      system_.assembly()
        .energies(system_.with_ghosts(motion.u), system_.actions())
        .total();
    balance.initial              = balance.kinetic + balance.strain;
    const double round_off_speed = 1e-10 * system_.size() / dt;
    balance.largest =
      std::max(balance.initial,
               mass_.total() * round_off_speed * round_off_speed);
    return balance;
  }

  EnergyBalance
  EnergyLedger::after_cut(const EnergyBalance &before,
                          const MotionState   &motion,
                          const double         dt) const
  {
    const EnergyBalance now = start(motion, dt);
    EnergyBalance       after(before);
    after.kinetic = now.kinetic;
    after.strain  = now.strain;
    after.released += before.kinetic + before.strain - now.initial;
    return after;
  }

  double
  EnergyLedger::reaction_work(const Step &step, const Vector &mean) const
  {
    const Vector start = system_.with_ghosts(step.start.u);
    const Vector end   = system_.with_ghosts(step.end.u);
    const auto  &owned = system_.discretization().locally_owned_dofs();
    // How far the supports have moved.
    std::vector<std::pair<types::global_dof_index, double>> moves;
    double                                                  largest = 0.;
    for (const auto &line : system_.constraints().get_lines())
      if (owned.is_element(line.index))
        {
          double move = end(line.index) - start(line.index);
          for (const auto &[dof, weight] : line.entries)
            move -= weight * (end(dof) - start(dof));
          moves.emplace_back(line.index, move);
          largest = std::max(largest, std::abs(move));
        }
    const auto communicator = system_.discretization().communicator();
    if (Utilities::MPI::max(largest, communicator) <= 1e-13 * system_.size())
      return 0.;
    // Not the mean of a: generalised alpha's a is that of another time.
    Vector w(step.end.v);
    w -= step.start.v;
    w /= step.dt;
    w.add(0.5 * damping_, step.end.v, 0.5 * damping_, step.start.v);
    const Vector  ghosted_w = system_.with_ghosts(w);
    const Inertia inertia{mass_,
                          ghosted_w,
                          0.,
                          step.conserves ? &step.step_start : nullptr};
    Vector        residual = system_.owned_vector();
    system_.assembly().residual(mean, system_.actions(), residual, &inertia);
    double work = 0.;
    for (const auto &[dof, move] : moves)
      work += residual(dof) * move;
    return Utilities::MPI::sum(work, communicator);
  }

  double
  EnergyLedger::initial_strain_work(const Step   &step,
                                    const double  strain_change,
                                    const Vector &end) const
  {
    const ShellActions &actions = system_.actions();
    const Assembly     &shell   = system_.assembly();
    return strain_change - shell.energies(end, actions).total() +
           shell
             .energies(step.step_start.u,
                       {actions.loads, step.step_start.rotations})
             .total();
  }

  EnergyBalance
  EnergyLedger::after_step(const EnergyBalance &before, const Step &step) const
  {
    const Assembly &shell = system_.assembly();
    EnergyBalance   after(before);
    Vector          change(step.end.u), mean(step.end.u);
    change -= step.start.u;
    mean.sadd(0.5, 0.5, step.start.u);
    const Vector ghosted_mean = system_.with_ghosts(mean);
    const Vector end          = system_.with_ghosts(step.end.u);
    const double end_time     = step.start_time + step.dt;
    const double middle       = end_time - 0.5 * step.dt;
    if (!step.conserves)
      {
        system_.set_load_time(middle);
        after.prescribed_work += reaction_work(step, ghosted_mean);
      }
    system_.set_load_time(end_time);
    const ShellActions at_end = system_.actions();
    system_.set_force_time(middle);
    if (step.conserves)
      after.prescribed_work += reaction_work(step, ghosted_mean);
    after.prescribed_work +=
      shell.rotation_conditions().work(step.step_start, end, system_.actions());

    Vector loads = system_.owned_vector();
    shell.loads(ghosted_mean, loads, system_.actions().loads, &step.step_start);
    after.external_work += loads * change;
    Vector held = system_.owned_vector();
    system_.add_held_forces(1., held);
    after.released -= held * change;
    if (damping_ > 0.)
      after.dissipation += 2. * damping_ / step.dt * kinetic_energy(change);

    after.kinetic = kinetic_energy(step.end.v);
    after.strain  = shell.energies(end, at_end).total();
    if (system_.has_initial_strain())
      after.external_work +=
        initial_strain_work(step, after.strain - before.strain, end);
    after.largest = std::max({before.largest,
                              after.kinetic + after.strain,
                              std::abs(after.external_work),
                              std::abs(after.prescribed_work)});
    return after;
  }
} // namespace Nacre
