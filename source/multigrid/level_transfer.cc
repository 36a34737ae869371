// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/discretization.h>
#include <nacre/multigrid/level_transfer.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Nacre
{
  namespace
  {
    using Dof = types::global_dof_index;
    /** A linear combination of dofs. */
    using Line = std::vector<std::pair<Dof, double>>;

    /** Where each rank's range of dofs begins, and the number of dofs. */
    std::vector<Dof>
    first_dofs(const Discretization &discretization)
    {
      const auto counts = Utilities::MPI::all_gather(
        discretization.communicator(),
        discretization.locally_owned_dofs().n_elements());
      std::vector<Dof> first(1, 0);
      for (const auto count : counts)
        first.push_back(first.back() + count);
      return first;
    }


    unsigned int
    owner_of(const Dof i, const std::vector<Dof> &first)
    {
      return std::upper_bound(first.begin(), first.end(), i) - first.begin() -
             1;
    }


    /** Constrained dofs among those of other ranks, expressed by others. */
    std::map<Dof, Line>
    constrained_lines(const std::vector<Dof>          &wanted,
                      const Discretization            &coarse,
                      const AffineConstraints<double> &constraints)
    {
      const auto                               comm  = coarse.communicator();
      const auto                               first = first_dofs(coarse);
      std::map<unsigned int, std::vector<Dof>> questions;
      for (const Dof i : wanted)
        questions[owner_of(i, first)].push_back(i);
      std::map<unsigned int, std::map<Dof, Line>> answers;
      for (const auto &[rank, dofs] :
           Utilities::MPI::some_to_some(comm, questions))
        {
          auto &lines = answers[rank];
          for (const Dof i : dofs)
            if (constraints.is_constrained(i))
              lines[i] = *constraints.get_constraint_entries(i);
        }
      std::map<Dof, Line> result;
      for (auto &[rank, lines] : Utilities::MPI::some_to_some(comm, answers))
        result.insert(lines.begin(), lines.end());
      return result;
    }


    /** Coarse dofs of this rank's parts, expressed by unconstrained ones. */
    class FreeDofs
    {
    public:
      /** Collective. The arguments must stay alive. */
      FreeDofs(const Discretization            &coarse,
               const AffineConstraints<double> &constraints,
               const std::vector<CoarsePart>   &parts)
        : known_(coarse.locally_relevant_dofs())
        , constraints_(constraints)
      {
        std::vector<Dof> unknown;
        for (const CoarsePart &part : parts)
          for (const Dof j : part.dofs)
            if (!known_.is_element(j))
              unknown.push_back(j);
        std::sort(unknown.begin(), unknown.end());
        unknown.erase(std::unique(unknown.begin(), unknown.end()),
                      unknown.end());
        foreign_lines_ = constrained_lines(unknown, coarse, constraints);
      }

      /** Add the dof @p j, times @p weight, to @p line. */
      void
      add(Line &line, const Dof j, const double weight) const
      {
        const Line *entries = nullptr;
        if (known_.is_element(j))
          entries = constraints_.get_constraint_entries(j);
        else if (const auto found = foreign_lines_.find(j);
                 found != foreign_lines_.end())
          entries = &found->second;
        if (entries == nullptr)
          line.emplace_back(j, weight);
        else
          for (const auto &[k, factor] : *entries)
            line.emplace_back(k, weight * factor);
      }

    private:
      const IndexSet                  &known_;
      const AffineConstraints<double> &constraints_;
      std::map<Dof, Line>              foreign_lines_;
    };


    /** The functions @p fe at @p points: a row for each point. */
    FullMatrix<double>
    shape_values(const FiniteElement<dim, spacedim> &fe,
                 const std::vector<Point<dim>>      &points)
    {
      FullMatrix<double> values(points.size(), fe.n_dofs_per_cell());
      for (unsigned int a = 0; a < values.m(); ++a)
        for (unsigned int b = 0; b < values.n(); ++b)
          values(a, b) = fe.shape_value(b, points[a]);
      return values;
    }


    /** The nodes of @p fe, by @p map of a child_maps(). */
    template <typename Map>
    std::vector<Point<dim>>
    mapped_nodes(const FiniteElement<dim, spacedim> &fe, const Map &map)
    {
      std::vector<Point<dim>> nodes;
      for (const auto &node : fe.get_unit_support_points())
        nodes.push_back(map(node));
      return nodes;
    }


    /** Distances in a reference cell that are round-off. */
    constexpr double same_point = 1e-8;


    /**
     * How well @p part stands for the displacement at @p node of its reference
     * cell, on or beside it. Beyond a cut its polynomials are continued ones.
     */
    double
    weight_at(const CellPart &part, const Point<dim> &node)
    {
      if (!part.is_cut())
        return 2.;
      return part.data->fraction +
             (part.polygon().contains(node, same_point) ? 1. : 0.);
    }


    /** Add up the terms of equal dofs, leave out zeros. */
    void
    simplify(Line &line)
    {
      std::sort(line.begin(), line.end());
      unsigned int n = 0;
      for (unsigned int k = 0; k < line.size(); ++k)
        if (n > 0 && line[n - 1].first == line[k].first)
          line[n - 1].second += line[k].second;
        else
          line[n++] = line[k];
      line.resize(n);
      line.erase(std::remove_if(line.begin(),
                                line.end(),
                                [](const auto &term) {
                                  return std::abs(term.second) < 1e-14;
                                }),
                 line.end());
    }
  } // namespace


  LevelTransfer::LevelTransfer(
    const Discretization            &fine,
    const AffineConstraints<double> &fine_constraints,
    const Discretization            &coarse,
    const AffineConstraints<double> &coarse_constraints)
    : fine_(fine)
    , coarse_(coarse)
    , maps_(child_maps(fine.element().reference_cell()))
    , coarse_parts_(find_coarse_parts(fine, coarse))
  {
    store(rows(fine_constraints, coarse_constraints));
  }


  std::vector<LevelTransfer::Row>
  LevelTransfer::rows(const AffineConstraints<double> &fine_constraints,
                      const AffineConstraints<double> &coarse_constraints) const
  {
    const FreeDofs   free_dofs(coarse_, coarse_constraints, coarse_parts_);
    const auto      &fe    = fine_.scalar_fe();
    const IndexSet  &owned = fine_.locally_owned_dofs();
    std::vector<Row> rows(owned.n_elements());
    // Parts of one node may lie in several coarse parts: beside a chord, and
    // ahead of a coarse tip.
    std::vector<double>             weights(rows.size(), 0.);
    std::vector<Dof>                dofs;
    const auto                     &node_dofs        = fine_.node_dofs();
    const auto                     &coarse_node_dofs = coarse_.node_dofs();
    std::vector<FullMatrix<double>> matrices;
    for (const ChildMap &map : maps_)
      matrices.push_back(
        shape_values(coarse_.scalar_fe(), mapped_nodes(fe, [&](const auto &x) {
                       return map.to_parent(x);
                     })));
    auto coarse_part = coarse_parts_.begin();
    for (const CellPart &part : fine_.owned_parts())
      {
        const CoarsePart &source = *coarse_part++;
        if (source.dofs.empty())
          continue;
        const FullMatrix<double> &P = matrices[source.map];
        fine_.get_dof_indices(part, dofs);
        for (unsigned int a = 0; a < P.m(); ++a)
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              const Dof i = dofs[node_dofs[spacedim * a + c]];
              if (!owned.is_element(i) || fine_constraints.is_constrained(i))
                continue;
              const auto   row    = owned.index_within_set(i);
              const double weight = weight_at(part, fe.unit_support_point(a));
              if (weight <= weights[row])
                continue;
              weights[row] = weight;
              rows[row].clear();
              for (unsigned int b = 0; b < P.n(); ++b)
                if (std::abs(P(a, b)) > 1e-13)
                  free_dofs.add(rows[row],
                                source.dofs[coarse_node_dofs[spacedim * b + c]],
                                P(a, b));
              simplify(rows[row]);
            }
      }
    return rows;
  }


  void
  LevelTransfer::store(const std::vector<Row> &rows)
  {
    std::vector<Dof> ghosts;
    row_start_.assign(1, 0);
    for (const Row &row : rows)
      {
        row_start_.push_back(row_start_.back() + row.size());
        for (const auto &term : row)
          if (!coarse_.locally_owned_dofs().is_element(term.first))
            ghosts.push_back(term.first);
      }
    std::sort(ghosts.begin(), ghosts.end());
    IndexSet ghost_set(coarse_.n_dofs());
    ghost_set.add_indices(ghosts.begin(), ghosts.end());
    coarse_vector_.reinit(coarse_.locally_owned_dofs(),
                          ghost_set,
                          coarse_.communicator());
    columns_.reserve(row_start_.back());
    weights_.reserve(row_start_.back());
    for (const Row &row : rows)
      for (const auto &[j, weight] : row)
        {
          columns_.push_back(
            coarse_vector_.get_partitioner()->global_to_local(j));
          weights_.push_back(weight);
        }
  }


  void
  LevelTransfer::prolongate_and_add(Vector &fine, const Vector &coarse) const
  {
    coarse_vector_.zero_out_ghost_values();
    std::copy(coarse.begin(), coarse.end(), coarse_vector_.begin());
    coarse_vector_.update_ghost_values();
    const double *values = coarse_vector_.begin();
    for (std::size_t i = 0; i + 1 < row_start_.size(); ++i)
      {
        double sum = 0.;
        for (std::size_t k = row_start_[i]; k < row_start_[i + 1]; ++k)
          sum += weights_[k] * values[columns_[k]];
        fine.begin()[i] += sum;
      }
  }


  void
  LevelTransfer::restrict_to(Vector &coarse, const Vector &fine) const
  {
    coarse_vector_.zero_out_ghost_values();
    coarse_vector_ = 0.;
    double *values = coarse_vector_.begin();
    for (std::size_t i = 0; i + 1 < row_start_.size(); ++i)
      for (std::size_t k = row_start_[i]; k < row_start_[i + 1]; ++k)
        values[columns_[k]] += weights_[k] * fine.begin()[i];
    coarse_vector_.compress(VectorOperation::add);
    std::copy(coarse_vector_.begin(), coarse_vector_.end(), coarse.begin());
  }


  std::vector<LevelTransfer::NodeValue>
  LevelTransfer::values_at_coarse_nodes(
    const TrilinosWrappers::MPI::Vector &fine) const
  {
    const auto  kind             = fine_.element().reference_cell();
    const auto  middle           = kind.barycenter<dim>();
    const auto &node_dofs        = fine_.node_dofs();
    const auto &coarse_node_dofs = coarse_.node_dofs();
    // The coarse nodes in the reference cell of the fine part
    std::vector<std::vector<Point<dim>>> nodes;
    std::vector<FullMatrix<double>>      matrices;
    for (const ChildMap &map : maps_)
      {
        nodes.push_back(mapped_nodes(coarse_.scalar_fe(), [&](const auto &x) {
          return map.to_child(x);
        }));
        matrices.push_back(shape_values(fine_.scalar_fe(), nodes.back()));
      }

    std::vector<NodeValue> values;
    std::vector<Dof>       dofs;
    auto                   coarse_part = coarse_parts_.begin();
    for (const CellPart &part : fine_.owned_parts())
      {
        const CoarsePart &target = *coarse_part++;
        if (target.dofs.empty())
          continue;
        const FullMatrix<double> &R = matrices[target.map];
        fine_.get_dof_indices(part, dofs);
        for (unsigned int b = 0; b < R.m(); ++b)
          {
            const Point<dim> &node      = nodes[target.map][b];
            const bool        is_inside = kind.contains_point(node, same_point);
            // No part may hold a node of a coarse part beyond a cut. There the
            // nearest part's polynomials go on.
            if (!is_inside && !target.is_cut)
              continue;
            const double weight =
              is_inside ? weight_at(part, node) : -node.distance(middle);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                double value = 0.;
                for (unsigned int a = 0; a < R.n(); ++a)
                  value += R(b, a) * fine(dofs[node_dofs[spacedim * a + c]]);
                values.push_back(
                  {target.dofs[coarse_node_dofs[spacedim * b + c]],
                   value,
                   weight});
              }
          }
      }
    return values;
  }


  TrilinosWrappers::MPI::Vector
  LevelTransfer::interpolate(const TrilinosWrappers::MPI::Vector &fine) const
  {
    const auto      comm  = coarse_.communicator();
    const IndexSet &owned = coarse_.locally_owned_dofs();
    const auto      first = first_dofs(coarse_);

    std::map<unsigned int, std::vector<NodeValue>> values_of_ranks;
    for (const NodeValue &value : values_at_coarse_nodes(fine))
      values_of_ranks[owner_of(value.dof, first)].push_back(value);
    std::vector<double>           weights(owned.n_elements(),
                                std::numeric_limits<double>::lowest());
    TrilinosWrappers::MPI::Vector own_values(owned, comm);
    for (const auto &[rank, values] :
         Utilities::MPI::some_to_some(comm, values_of_ranks))
      for (const NodeValue &value : values)
        if (double &weight = weights[owned.index_within_set(value.dof)];
            value.weight > weight)
          {
            weight                = value.weight;
            own_values(value.dof) = value.value;
          }
    own_values.compress(VectorOperation::insert);
    coarse_.node_constraints().distribute(own_values);

    TrilinosWrappers::MPI::Vector result(owned,
                                         coarse_.locally_relevant_dofs(),
                                         comm);
    result = own_values;
    return result;
  }
} // namespace Nacre
