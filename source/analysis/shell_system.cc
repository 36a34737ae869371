// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/analysis/shell_system.h>
#include <nacre/base/cpu_timer.h>
#include <nacre/base/mpi_errors.h>
#include <nacre/solvers/direct_solver.h>
#include <nacre/solvers/sparse_rows.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace Nacre
{
  namespace
  {
    StepFailure
    singular_tangent(const bool requires_definite)
    {
      return {FailureKind::singular_tangent,
              requires_definite ?
                "the tangent is not positive definite" :
                "the tangent is singular to working precision"};
    }
  } // namespace

  ShellSystem::ShellSystem(const Discretization &discretization,
                           const Assembly       &assembly,
                           const ShellModel     &model,
                           LinearSolver         &solver)
    : discretization_(discretization)
    , assembly_(assembly)
    , model_(model)
    , size_(discretization.extent().second)
    , area_(MassTerms(discretization).total())
    , solver_(solver)
  {
    set_time(0.);
    assembly_.reinit_matrix(constraints(), matrix_);
  }

  void
  ShellSystem::set_time(const double time)
  {
    set_load_time(time);
    factor_     = actions_.loads.factor;
    conditions_ = std::make_unique<DisplacementConditions>(discretization_,
                                                           model_.supports,
                                                           actions_.loads);
  }

  void
  ShellSystem::set_load_time(const double time)
  {
    actions_    = assembly_.actions(model_.at(time));
    held_share_ = held_.share(time);
  }

  void
  ShellSystem::set_force_time(const double time)
  {
    actions_.loads = model_.at(time);
    held_share_    = held_.share(time);
  }

  void
  ShellSystem::accept_step(const Vector &u, const double time)
  {
    if (assembly_.section_states().has_none())
      return;
    set_time(time);
    assembly_.update_section_states(with_ghosts(u), actions_);
  }

  void
  ShellSystem::hold(const Vector  &u,
                    const Inertia &inertia,
                    const double   duration)
  {
    Vector force = owned_vector();
    assembly_.residual(with_ghosts(u), actions_, force, &inertia);
    condense(homogeneous_constraints(), force);
    hold({force, actions_.loads.time, duration});
  }

  void
  ShellSystem::hold(const FadingForce &held)
  {
    held_       = held;
    held_share_ = held_.share(actions_.loads.time);
  }

  ShellSystem::Vector
  ShellSystem::acceleration(const Vector    &u,
                            const Inertia   &inertia,
                            const MassTerms &mass)
  {
    Vector force = owned_vector();
    assembly_.residual(with_ghosts(u), actions_, force, &inertia);
    add_held_forces(-1., force);
    force *= -1.;
    return solve_mass(mass, {force}).front();
  }

  std::vector<ShellSystem::Vector>
  ShellSystem::solve_mass(const MassTerms           &mass,
                          const std::vector<Vector> &b,
                          const bool                 moves_tips)
  {
    const AffineConstraints<double> homogeneous =
      moves_tips ? homogeneous_constraints() : constraints_without_tips();
    has_tangent_ = false;
    DirectSolver        mass_solver(discretization_.communicator());
    std::vector<Vector> x;
    for (const Vector &load : b)
      {
        Vector right_hand_side = owned_vector();
        mass.assemble_system(homogeneous,
                             with_ghosts(load),
                             matrix_,
                             right_hand_side);
        if (x.empty())
          mass_solver.factorize(matrix_);
        x.push_back(owned_vector());
        mass_solver.solve(x.back(), right_hand_side);
        homogeneous.distribute(x.back());
      }
    return x;
  }

  double
  ShellSystem::stiffness_to_mass(const Vector &u, const MassTerms &mass)
  {
    has_tangent_  = false;
    Vector unused = owned_vector();
    assembly_.assemble(with_ghosts(u),
                       actions_,
                       constraints(),
                       matrix_,
                       unused);
    double trace = 0.;
    for (const auto i : discretization_.locally_owned_dofs())
      trace += matrix_.diag_element(i);
    return Utilities::MPI::sum(trace, discretization_.communicator()) /
           mass.trace();
  }

  double
  ShellSystem::product(const MassTerms &mass,
                       const Vector    &v,
                       const Vector    &w) const
  {
    Vector Mw = owned_vector();
    mass.vmult(Mw, with_ghosts(w));
    return v * Mw;
  }

  void
  ShellSystem::count_negative_eigenvalues(NewtonSolver::Result &result)
  {
    if (!result.converged)
      return;
    if (const auto n = solver_.count_negative_eigenvalues())
      {
        result.last.n_negative_pivots = *n;
        return;
      }
    result.converged    = false;
    result.last.failure = singular_tangent(false);
    result.kind         = result.last.failure.kind;
    result.reason       = result.last.failure.text;
  }

  double
  ShellSystem::improve_mode(const MassTerms   &mass,
                            const unsigned int n_steps,
                            Vector            &mode)
  {
    const AffineConstraints<double> homogeneous = homogeneous_constraints();
    Vector                          b = owned_vector(), x = owned_vector();
    double                          mu = 0.;
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        mass.vmult(b, with_ghosts(mode));
        condense(homogeneous, b);
        solver_.solve(x, b);
        const double bx = b * x;
        homogeneous.distribute(x);
        const double norm_square = product(mass, x, x);
        mu                       = bx / norm_square;
        mode.equ(1. / std::sqrt(norm_square), x);
      }
    return mu;
  }

  ShellSystem::Vector
  ShellSystem::prescribed_change(const double before, const double after) const
  {
    Vector change = owned_vector();
    for (const auto &[time, sign] :
         {std::make_pair(before, -1.), std::make_pair(after, 1.)})
      {
        const DisplacementConditions conditions(discretization_,
                                                model_.supports,
                                                model_.at(time));
        for (const auto &line : conditions.constraints().get_lines())
          if (discretization_.locally_owned_dofs().is_element(line.index))
            change(line.index) += sign * line.inhomogeneity;
      }
    change.compress(VectorOperation::add);
    return change;
  }

  ShellSystem::Rate
  ShellSystem::rate(const Vector &u, const double time, const double dt)
  {
    const Vector change = prescribed_change(time - dt, time + dt);
    const auto residual = [&](const double at, const double share, Vector &r) {
      Vector moved(u);
      moved.add(share, change);
      assembly_.residual(with_ghosts(moved),
                         assembly_.actions(model_.at(at)),
                         r);
    };
    // How loads move the shell, and how prescribed displacements do, K(u) g:
    // these by small ones, since they strain the cells at the supports alone.
    Vector force = owned_vector(), end_force = owned_vector();
    residual(time - dt, 0., force);
    residual(time + dt, 0., end_force);
    force -= end_force;
    const double largest = change.linfty_norm();
    if (largest > 0.)
      {
        const double share       = std::min(0.5, 1e-6 * size_ / largest);
        Vector       start_force = owned_vector();
        residual(time, -share, start_force);
        residual(time, share, end_force);
        force.add(0.5 / share, start_force, -0.5 / share, end_force);
      }
    force /= 2. * dt;
    const AffineConstraints<double> homogeneous = homogeneous_constraints();
    condense(homogeneous, force);
    Rate result{owned_vector()};
    solver_.solve(result.velocity, force);
    result.work = force * result.velocity;
    homogeneous.distribute(result.velocity);
    result.velocity.add(0.5 / dt, change);
    return result;
  }

  ShellSystem::VirtualWork
  ShellSystem::virtual_work(const Vector &u,
                            const Vector &v,
                            const double  time,
                            const double  dt)
  {
    const CpuSum seconds(assembly_seconds_);
    const Vector ghosted = with_ghosts(u);
    const auto   work_at = [&](const double at) {
      Vector force = owned_vector();
      assembly_.residual(ghosted, assembly_.actions(model_.at(at)), force);
      return force * v;
    };
    AffineConstraints<double> none(conditions_->relevant_dofs());
    none.close();
    if (whole_matrix_.m() == 0)
      assembly_.reinit_matrix(none, whole_matrix_);
    Vector unused = owned_vector();
    assembly_.assemble(ghosted,
                       assembly_.actions(model_.at(time)),
                       none,
                       whole_matrix_,
                       unused);
    VirtualWork result{work_at(time), owned_vector()};
    whole_matrix_.vmult(result.gradient, v);
    result.rate = (work_at(time + dt) - work_at(time - dt)) / (2. * dt);
    return result;
  }

  ShellSystem::Vector
  ShellSystem::interpolate(
    const std::function<Tensor<1, spacedim>(const Point<spacedim> &)> &function)
    const
  {
    Vector      values    = owned_vector();
    const auto &node_dofs = discretization_.node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    run_on_all_ranks(discretization_.communicator(), [&]() {
      for (const CellPart &part : discretization_.owned_parts())
        {
          discretization_.get_dof_indices(part, dofs);
          const auto nodes = discretization_.node_positions(part);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const auto i = dofs[node_dofs[spacedim * a + c]];
                if (discretization_.locally_owned_dofs().is_element(i))
                  values(i) = function(nodes[a])[c];
              }
        }
    });
    values.compress(VectorOperation::insert);
    discretization_.node_constraints().distribute(values);
    return values;
  }

  double
  ShellSystem::thickness() const
  {
    const auto cell = discretization_.triangulation().begin_active();
    return Utilities::MPI::max(model_.section->thickness(
                                 {cell->center(), cell->material_id()}),
                               discretization_.communicator());
  }

  ShellSystem::Vector
  ShellSystem::owned_vector() const
  {
    return Vector(discretization_.locally_owned_dofs(),
                  discretization_.communicator());
  }

  ShellSystem::Vector
  ShellSystem::with_ghosts(const Vector &owned) const
  {
    Vector ghosted(discretization_.locally_owned_dofs(),
                   conditions_->relevant_dofs(),
                   discretization_.communicator());
    ghosted = owned;
    return ghosted;
  }

  AffineConstraints<double>
  ShellSystem::increment_constraints(const Vector &ghosted_end,
                                     const double  share) const
  {
    AffineConstraints<double> result(constraints());
    for (const auto &line : constraints().get_lines())
      {
        double gap = line.inhomogeneity - ghosted_end(line.index);
        for (const auto &[dof, weight] : line.entries)
          gap += weight * ghosted_end(dof);
        result.set_inhomogeneity(line.index, share * gap);
      }
    return result;
  }

  AffineConstraints<double>
  ShellSystem::homogeneous_constraints() const
  {
    AffineConstraints<double> result(constraints());
    for (const auto &line : constraints().get_lines())
      result.set_inhomogeneity(line.index, 0.);
    return result;
  }

  AffineConstraints<double>
  ShellSystem::constraints_without_tips() const
  {
    AffineConstraints<double> result(discretization_.locally_relevant_dofs());
    result.merge(homogeneous_constraints());
    std::vector<types::global_dof_index> dofs;
    for (const CellPart &part : discretization_.relevant_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        for (auto i = discretization_.node_dofs().size(); i < dofs.size(); ++i)
          if (!result.is_constrained(dofs[i]))
            result.add_line(dofs[i]);
      }
    result.close();
    return result;
  }

  bool
  ShellSystem::can_keep_tangent(const AffineConstraints<double> &constraints,
                                const Vector                    &u) const
  {
    if (!keeps_tangent_ || !has_tangent_)
      return false;
    // Prescribed increments would need the columns that were eliminated.
    return prescribed_increment(constraints) <= 1e-12 * u.linfty_norm();
  }

  double
  ShellSystem::prescribed_increment(
    const AffineConstraints<double> &constraints) const
  {
    double increment = 0.;
    for (const auto &line : constraints.get_lines())
      increment = std::max(increment, std::abs(line.inhomogeneity));
    return Utilities::MPI::max(increment, discretization_.communicator());
  }

  double
  ShellSystem::round_off_work(const Vector &u) const
  {
    // Tangent vectors phi,a have errors of their own size, eps, and those of
    // the displacements, eps |u| per distance of nodes; so have strains. Such
    // errors de make the residual dr = B^T D de. Its answer K^-1 dr is the
    // nearest strain that displacements can have, thus dr . K^-1 dr is at most
    // de . D de, however K is conditioned. K_ii being (twice) the energy of the
    // i-th unknown alone, de . D de is the sum of K_ii du_i^2 with du_i = eps
    // |u_i| and eps times the distance of nodes. Measured: 1e-5 to 4e-3 of the
    // value returned, for R/h from 10 to 10^4: doc/paths.md.
    const double accuracy = 10. * std::numeric_limits<double>::epsilon();
    const double n_nodes  = 1. * u.size() / spacedim;
    const double distance = std::sqrt(area_ / n_nodes);
    const auto   diagonal = SparseRows(matrix_).diagonal();
    double       energy   = 0.;
    for (unsigned int i = 0; i < diagonal.size(); ++i)
      energy += std::abs(diagonal[i]) *
                (Utilities::fixed_power<2>(u.begin()[i]) + distance * distance);
    return accuracy * accuracy *
           Utilities::MPI::sum(energy, discretization_.communicator());
  }

  void
  ShellSystem::condense(const AffineConstraints<double> &constraints,
                        Vector                          &r) const
  {
    Vector moved = owned_vector();
    for (const auto &line : constraints.get_lines())
      if (discretization_.locally_owned_dofs().is_element(line.index))
        {
          for (const auto &[dof, weight] : line.entries)
            moved(dof) += weight * r(line.index);
          moved(line.index) -= r(line.index);
        }
    moved.compress(VectorOperation::add);
    r += moved;
  }

  NewtonSolver::Step
  ShellSystem::solve_linearised(const Vector  &u,
                                const Vector  &end,
                                Vector        &du,
                                const Inertia *inertia,
                                const double   share)
  {
    const Vector ghosted     = with_ghosts(u);
    const auto   constraints = increment_constraints(with_ghosts(end), share);
    Vector       right_hand_side = owned_vector();

    NewtonSolver::Step step;
    step.failure = linearise(ghosted,
                             constraints,
                             inertia,
                             can_keep_tangent(constraints, u),
                             right_hand_side);
    if (step.failure.kind != FailureKind::none)
      return step;
    du = 0.;
    if (!solver_.solve(du, right_hand_side).is_regular)
      {
        step.failure = singular_tangent(requires_definite_);
        return step;
      }

    step.n_negative_pivots = solver_.n_negative_pivots().value_or(0);
    // Rows of constrained dofs hold the prescribed increments.
    for (const auto &line : constraints.get_lines())
      if (discretization_.locally_owned_dofs().is_element(line.index))
        right_hand_side(line.index) = 0.;
    right_hand_side.compress(VectorOperation::insert);
    step.residual = right_hand_side.l2_norm();
    step.work     = right_hand_side * du;
    if (prescribed_increment(constraints) <= 1e-12 * (u.linfty_norm() + size_))
      step.round_off_work = round_off_work(u);
    constraints.distribute(du);
    last_increment_ = du;
    return step;
  }

  StepFailure
  ShellSystem::linearise(const Vector                    &u,
                         const AffineConstraints<double> &constraints,
                         const Inertia                   *inertia,
                         const bool                       keeps_tangent,
                         Vector                          &right_hand_side)
  {
    if (keeps_tangent)
      {
        const CpuSum time(assembly_seconds_);
        energies_ = assembly_.residual(u, actions_, right_hand_side, inertia);
        right_hand_side *= -1.;
        condense(constraints, right_hand_side);
        add_held_forces(1., right_hand_side);
        return std::isfinite(right_hand_side.l2_norm()) ? StepFailure() :
                                                          not_finite(u);
      }
    has_tangent_ = false;
    {
      const CpuSum time(assembly_seconds_);
      energies_ = assembly_.assemble(u,
                                     actions_,
                                     constraints,
                                     matrix_,
                                     right_hand_side,
                                     inertia);
      add_held_forces(1., right_hand_side);
    }
    if (!std::isfinite(energies_.total() + right_hand_side.l2_norm() +
                       matrix_.frobenius_norm()))
      return not_finite(u);
    if (!solver_.try_prepare(
          {matrix_, constraints, &u, actions_.loads, requires_definite_}))
      return singular_tangent(requires_definite_);
    has_tangent_ = true;
    return {};
  }

  StepFailure
  ShellSystem::not_finite(const Vector &u) const
  {
    std::string where = find_impossible_state(discretization_, u);
    if (where.empty())
      where =
        find_torn_edge(assembly_, u, actions_.rotations, 0.5 * numbers::PI);
    std::ostringstream text;
    text << "the internal forces are infinite or not a number";
    if (!where.empty())
      text << ": " << where;
    else
      text << " at displacements of up to " << u.linfty_norm();
    return {FailureKind::not_finite, text.str()};
  }

  Point<spacedim>
  ShellSystem::position_of_largest(const Vector &v) const
  {
    double          largest = -1.;
    Point<spacedim> position;
    const auto     &node_dofs = discretization_.node_dofs();
    const auto     &owned     = discretization_.locally_owned_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const CellPart &part : discretization_.owned_parts())
      {
        discretization_.get_dof_indices(part, dofs);
        const auto nodes = discretization_.node_positions(part);
        for (unsigned int k = 0; k < node_dofs.size(); ++k)
          {
            const auto i = dofs[node_dofs[k]];
            if (owned.is_element(i) && std::abs(v(i)) > largest)
              {
                largest  = std::abs(v(i));
                position = nodes[k / spacedim];
              }
          }
      }
    std::pair<double, Point<spacedim>> found(-1., position);
    for (const auto &other :
         Utilities::MPI::all_gather(discretization_.communicator(),
                                    std::make_pair(largest, position)))
      if (other.first > found.first)
        found = other;
    return found.second;
  }

  double
  ShellSystem::work(const Vector  &u,
                    const Vector  &du,
                    const Inertia *inertia) const
  {
    // du fulfils the homogeneous constraints up to what is still prescribed:
    // the free part of r . du is that of the condensed residual.
    const CpuSum time(assembly_seconds_);
    Vector       residual = owned_vector();
    assembly_.residual(with_ghosts(u), actions_, residual, inertia);
    add_held_forces(-1., residual);
    Vector free(du);
    for (const auto &line : constraints().get_lines())
      if (line.entries.empty() &&
          discretization_.locally_owned_dofs().is_element(line.index))
        free(line.index) = 0.;
    free.compress(VectorOperation::insert);
    return -(residual * free);
  }
} // namespace Nacre
