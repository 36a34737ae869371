// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/point_constraints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /**
     * Points nearer to a node or an edge of the reference cell lie there. A
     * condition between an edge that is held and a point so near would hold
     * the rotation.
     */
    constexpr double near = 1e-3;

    Point<dim>
    snap(const FiniteElement<dim, spacedim> &fe, Point<dim> unit)
    {
      for (const auto &node : fe.get_unit_support_points())
        if (std::abs(node[0] - unit[0]) < near &&
            std::abs(node[1] - unit[1]) < near)
          return node;
      for (unsigned int alpha = 0; alpha < dim; ++alpha)
        for (const double side : {0., 1.})
          if (std::abs(unit[alpha] - side) < near)
            unit[alpha] = side;
      const double slanting = 1. - unit[0] - unit[1];
      if (fe.reference_cell() == ReferenceCells::Triangle &&
          std::abs(slanting) < near)
        unit += Point<dim>(0.5 * slanting, 0.5 * slanting);
      return unit;
    }

    PointPlace
    place_in_cell(const Discretization &discretization,
                  const SurfacePoint   &found)
    {
      const auto      &fe        = discretization.scalar_fe();
      const auto      &node_dofs = discretization.node_dofs();
      const auto      &hanging   = discretization.node_constraints();
      const auto       nodes     = discretization.node_positions(found.part);
      const Point<dim> unit      = snap(fe, found.unit);
      std::vector<types::global_dof_index> dofs;
      discretization.get_dof_indices(found.part, dofs);
      PointPlace place;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const double N = fe.shape_value(a, unit);
          if (std::abs(N) < 1e-12)
            continue;
          place.position += N * nodes[a];
          place.weights.push_back(N);
          place.dofs.emplace_back();
          for (unsigned int c = 0; c < spacedim; ++c)
            place.dofs.back()[c] = dofs[node_dofs[spacedim * a + c]];
        }
      place.is_node =
        place.weights.size() == 1 && !hanging.is_constrained(place.dofs[0][0]);
      return place;
    }

    template <typename Line>
    double
    product(const Line                          &line,
            const TrilinosWrappers::MPI::Vector &u,
            const IndexSet                      &owned)
    {
      double sum = 0.;
      for (const auto &[i, weight] : line)
        if (owned.is_element(i))
          sum += weight * u(i);
      return sum;
    }
  } // namespace

  PointPlace
  place_point(const Discretization  &discretization,
              const Point<spacedim> &point,
              const std::string     &source)
  {
    const auto communicator = discretization.communicator();
    const auto found        = discretization.locate(point, source);
    const auto me           = Utilities::MPI::this_mpi_process(communicator);
    const auto owner =
      Utilities::MPI::max(found.is_mine ? me : 0u, communicator);
    PointPlace place;
    if (found.is_mine)
      place = place_in_cell(discretization, found);
    place       = Utilities::MPI::broadcast(communicator, place, owner);
    place.owner = owner;
    return place;
  }

  Tensor<1, spacedim>
  displacement_of(const PointPlace                    &place,
                  const TrilinosWrappers::MPI::Vector &u,
                  const IndexSet                      &owned)
  {
    Tensor<1, spacedim> sum;
    for (unsigned int a = 0; a < place.weights.size(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        if (owned.is_element(place.dofs[a][c]))
          sum[c] += place.weights[a] * u(place.dofs[a][c]);
    return sum;
  }

  PointConstraints::PointConstraints(
    const Discretization              &discretization,
    const std::vector<PointCondition> &conditions,
    const AffineConstraints<double>   &others)
    : discretization_(&discretization)
    , conditions_(conditions)
  {
    others_.copy_from(others);
    const auto communicator = discretization.communicator();
    const auto me           = Utilities::MPI::this_mpi_process(communicator);
    std::map<types::global_dof_index, unsigned int> column;
    for (const auto &condition : conditions_)
      {
        Equation equation;
        if (me == condition.place.owner)
          equation = make_equation(condition);
        equations_.push_back(Utilities::MPI::broadcast(communicator,
                                                       equation,
                                                       condition.place.owner));
        for (const auto &entry : equations_.back().by_free)
          column[entry.first] = 0;
      }
    for (auto &[dof, k] : column)
      {
        k = columns_.size();
        columns_.push_back(dof);
      }
    const unsigned int n = equations_.size();
    rows_.reinit(n, columns_.size());
    combination_.reinit(n, n);
    for (unsigned int k = 0; k < n; ++k)
      {
        combination_(k, k) = 1.;
        for (const auto &[dof, weight] : equations_[k].by_free)
          rows_(k, column[dof]) += weight;
      }
    eliminate(!discretization.is_coarse_level());
  }

  PointConstraints::Equation
  PointConstraints::make_equation(const PointCondition &condition) const
  {
    std::map<types::global_dof_index, double> by_nodes, by_free;
    Equation                                  equation;
    const auto &hanging = discretization_->node_constraints();
    const auto &place   = condition.place;
    for (unsigned int a = 0; a < place.weights.size(); ++a)
      {
        const auto   i = place.dofs[a][condition.component];
        const double N = place.weights[a];
        if (!hanging.is_constrained(i))
          by_nodes[i] += N;
        else
          for (const auto &[j, weight] : *hanging.get_constraint_entries(i))
            by_nodes[j] += weight * N;
        if (!others_.is_constrained(i))
          by_free[i] += N;
        else
          {
            equation.known += others_.get_inhomogeneity(i) * N;
            for (const auto &[j, weight] : *others_.get_constraint_entries(i))
              by_free[j] += weight * N;
          }
      }
    equation.by_nodes.assign(by_nodes.begin(), by_nodes.end());
    equation.by_free.assign(by_free.begin(), by_free.end());
    return equation;
  }

  double
  PointConstraints::right_hand_side(const unsigned int k) const
  {
    return conditions_[k].value - equations_[k].known;
  }

  void
  PointConstraints::check_dependent(const unsigned int k) const
  {
    double rest = 0., magnitude = 0.;
    for (unsigned int m = 0; m < equations_.size(); ++m)
      {
        rest += combination_(k, m) * right_hand_side(m);
        magnitude +=
          std::abs(combination_(k, m)) *
          (std::abs(conditions_[m].value) + std::abs(equations_[m].known));
      }
    const auto        &x = conditions_[k].place.position;
    std::ostringstream message;
    message << "Contradicting conditions at the point (" << x[0] << ", " << x[1]
            << ", " << x[2] << "): '" << *conditions_[k].source
            << "' against those of edges or points around it.";
    // Between nodes the edges' values are interpolated.
    AssertThrow(std::abs(rest) <= 1e-3 * magnitude, ExcMessage(message.str()));
  }

  void
  PointConstraints::eliminate(const bool checks)
  {
    const auto subtract = [&](const unsigned int from,
                              const unsigned int what,
                              const double       factor) {
      for (unsigned int j = 0; j < rows_.n(); ++j)
        rows_(from, j) -= factor * rows_(what, j);
      for (unsigned int j = 0; j < combination_.n(); ++j)
        combination_(from, j) -= factor * combination_(what, j);
    };
    for (unsigned int k = 0; k < equations_.size(); ++k)
      {
        for (const auto &[row, column] : pivots_)
          subtract(k, row, rows_(k, column));
        unsigned int pivot = 0;
        for (unsigned int j = 1; j < rows_.n(); ++j)
          // Of coefficients that differ by round-off only, the first one is
          // taken.
          if (std::abs(rows_(k, j)) > 1.000001 * std::abs(rows_(k, pivot)))
            pivot = j;
        // As precise as the mean conormals of edges.
        if (rows_.n() == 0 || std::abs(rows_(k, pivot)) < 1e-3)
          {
            if (checks)
              check_dependent(k);
            continue;
          }
        const double value = rows_(k, pivot);
        subtract(k, k, 1. - 1. / value);
        for (const auto &[row, column] : pivots_)
          subtract(row, k, rows_(row, pivot));
        pivots_.emplace_back(k, pivot);
      }
  }

  void
  PointConstraints::add_to(AffineConstraints<double> &constraints) const
  {
    for (const auto &[row, column] : pivots_)
      {
        const auto dof = columns_[column];
        constraints.add_line(dof);
        for (unsigned int j = 0; j < columns_.size(); ++j)
          if (j != column && std::abs(rows_(row, j)) > 1e-14)
            constraints.add_entry(dof, columns_[j], -rows_(row, j));
        double value = 0.;
        for (unsigned int m = 0; m < equations_.size(); ++m)
          value += combination_(row, m) * right_hand_side(m);
        constraints.set_inhomogeneity(dof, value);
      }
  }

  std::vector<double>
  PointConstraints::values(const Vector &u) const
  {
    std::vector<double> result(equations_.size());
    if (is_empty())
      return result;
    for (unsigned int k = 0; k < equations_.size(); ++k)
      result[k] = product(equations_[k].by_nodes,
                          u,
                          discretization_->locally_owned_dofs());
    Utilities::MPI::sum(result, discretization_->communicator(), result);
    return result;
  }

  void
  PointConstraints::set_values(const std::vector<double> &targets,
                               Vector                    &v) const
  {
    if (is_empty())
      return;
    // The support force k is lambda_k = r . w_k, with displacements w_k that
    // fulfil the other conditions and are 1 at k: unit vectors of the pivots,
    // extended by what depends on them, times the combination.
    const auto                                before = values(v);
    std::map<types::global_dof_index, double> change;
    for (const auto &[row, column] : pivots_)
      for (unsigned int k = 0; k < targets.size(); ++k)
        change[columns_[column]] +=
          combination_(row, k) * (targets[k] - before[k]);
    const IndexSet &owned = discretization_->locally_owned_dofs();
    for (const auto &[i, value] : change)
      if (owned.is_element(i))
        v(i) += value;
    for (const auto &line : others_.get_lines())
      if (owned.is_element(line.index))
        for (const auto &[j, weight] : line.entries)
          if (const auto pivot = change.find(j); pivot != change.end())
            v(line.index) += weight * pivot->second;
    v.compress(VectorOperation::add);
  }
} // namespace Nacre
