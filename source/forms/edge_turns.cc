// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/edge_turns.h>
#include <nacre/mechanics/corotational_strain.h>
#include <nacre/problem/boundary_conditions.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Nacre
{
  namespace
  {
    using Vector3    = Tensor<1, spacedim>;
    using Directions = std::vector<Vector3>;

    /** Equal parts of the time that are looked at in any case. */
    constexpr unsigned int n_parts = 16;
    /** A part in which an edge turns by more is halved, this often. */
    const double           largest_turn = std::cos(numbers::PI / 60.);
    constexpr unsigned int n_halvings   = 12;

    /** Apply the smallest rotation that takes d0 to d to all of Q. */
    void
    turn_on(const Vector3 &d0, const Vector3 &d, Tensor<2, spacedim> &Q)
    {
      // Q = p d0^T + ... column by column; smallest() takes what is
      // orthogonal to d0, the rest goes along d.
      Tensor<2, spacedim> turned;
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          Vector3 column;
          for (unsigned int i = 0; i < spacedim; ++i)
            column[i] = Q[i][c];
          const double  along = column * d0;
          const Vector3 result =
            along * d +
            EdgeRotation::smallest<double>(d0, d, column - along * d0);
          for (unsigned int i = 0; i < spacedim; ++i)
            turned[i][c] = result[i];
        }
      Q = turned;
    }

    bool
    is_small_turn(const Directions &from, const Directions &to)
    {
      for (unsigned int q = 0; q < from.size(); ++q)
        if (from[q] * to[q] < largest_turn)
          return false;
      return true;
    }
  } // namespace

  EdgeTurns::EdgeTurns(const Discretization     &discretization,
                       const BoundaryConditions &boundary_conditions)
    : discretization_(discretization)
    , boundary_conditions_(boundary_conditions)
    , edge_(discretization)
  {}

  void
  EdgeTurns::update()
  {
    if (time_ == boundary_conditions_.time())
      return;
    turns_.clear();
    for (const auto &[id, conditions] : boundary_conditions_.edges())
      if (conditions.rotation != nullptr &&
          boundary_conditions_.may_turn(conditions))
        for (const auto &cell :
             discretization_.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto f : cell->face_indices())
              if (cell->at_boundary(f) && cell->face(f)->boundary_id() == id)
                turns_[{cell->active_cell_index(), f}] =
                  follow(cell, f, conditions);
    time_ = boundary_conditions_.time();
  }

  const EdgeTurns::Turns *
  EdgeTurns::find(const cell_iterator &cell, const unsigned int face) const
  {
    const auto found = turns_.find({cell->active_cell_index(), face});
    return found == turns_.end() ? nullptr : &found->second;
  }

  EdgeTurns::Turns
  EdgeTurns::follow(const cell_iterator  &cell,
                    const unsigned int    face,
                    const EdgeConditions &conditions)
  {
    edge_.reinit(cell, face);
    const double end = boundary_conditions_.time();
    Directions   now;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      now.push_back(
        cross_product_3d(edge_.conormal(0, q), edge_.frame(0, q).t0));
    Turns turns(now.size(), unit_symmetric_tensor<spacedim>());

    const std::function<void(double, double, unsigned int)> advance =
      [&](const double from, const double to, const unsigned int halvings) {
        const auto next = directions(cell, face, conditions, to);
        if (halvings < n_halvings && !is_small_turn(now, next))
          {
            const double middle = 0.5 * (from + to);
            advance(from, middle, halvings + 1);
            advance(middle, to, halvings + 1);
            return;
          }
        for (unsigned int q = 0; q < now.size(); ++q)
          turn_on(now[q], next[q], turns[q]);
        now = next;
      };
    advance(0., 0., n_halvings); // what is prescribed at the start
    for (unsigned int k = 0; k < n_parts; ++k)
      advance(end * k / n_parts, end * (k + 1) / n_parts, 0);
    return turns;
  }

  std::vector<Tensor<1, spacedim>>
  EdgeTurns::directions(const cell_iterator  &cell,
                        const unsigned int    face,
                        const EdgeConditions &conditions,
                        const double          time) const
  {
    const auto nodes = discretization_.node_positions(cell);
    // Other nodes don't move the edge.
    const auto &edge_nodes = discretization_.face_nodes(face);
    Directions  u;
    for (const unsigned int a : edge_nodes)
      u.push_back(
        boundary_conditions_.displacement(conditions, nodes[a], time));
    Directions result;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      {
        const auto   &frame = edge_.frame(0, q);
        const Vector3 d0    = cross_product_3d(edge_.conormal(0, q), frame.t0);
        Vector3       d     = d0;
        for (unsigned int k = 0; k < edge_nodes.size(); ++k)
          {
            const auto &dN = edge_.shapes(0).gradient(q, edge_nodes[k]);
            d +=
              (dN[0] * (d0 * frame.a_con[0]) + dN[1] * (d0 * frame.a_con[1])) *
              u[k];
          }
        result.push_back(d / d.norm());
      }
    return result;
  }
} // namespace Nacre
