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
    /** Unit directions of the edge's points at an instant. */
    Directions
    directions(const Discretization  &discretization,
               const ShellEdgeValues &edge,
               const EdgeConditions  &conditions,
               const Instant         &instant)
    {
      const auto nodes = discretization.node_positions(edge.part(0));
      // Other nodes don't move the edge.
      const auto &edge_nodes = discretization.face_nodes(edge.face(0));
      Directions  u;
      for (const unsigned int a : edge_nodes)
        u.push_back(conditions.displacement(nodes[a], instant));
      Directions result;
      for (unsigned int q = 0; q < edge.n_points(); ++q)
        {
          const auto   &frame = edge.frame(0, q);
          const Vector3 d0    = cross_product_3d(edge.conormal(0, q), frame.t0);
          Vector3       d     = d0;
          for (unsigned int k = 0; k < edge_nodes.size(); ++k)
            {
              const auto &dN = edge.shapes(0).gradient(q, edge_nodes[k]);
              d += (dN[0] * (d0 * frame.a_con[0]) +
                    dN[1] * (d0 * frame.a_con[1])) *
                   u[k];
            }
          result.push_back(d / d.norm());
        }
      return result;
    }
  } // namespace

  std::vector<Tensor<2, spacedim>>
  follow_edge_turns(const Discretization  &discretization,
                    const ShellEdgeValues &edge,
                    const EdgeConditions  &conditions,
                    const Expression      &load_factor,
                    const double           time)
  {
    Directions now;
    for (unsigned int q = 0; q < edge.n_points(); ++q)
      now.push_back(cross_product_3d(edge.conormal(0, q), edge.frame(0, q).t0));
    std::vector<Tensor<2, spacedim>> turns(now.size(),
                                           unit_symmetric_tensor<spacedim>());

    const std::function<void(double, double, unsigned int)> advance =
      [&](const double from, const double to, const unsigned int halvings) {
        const auto next = directions(discretization,
                                     edge,
                                     conditions,
                                     {to, load_factor(Point<3>(), to)});
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
      advance(time * k / n_parts, time * (k + 1) / n_parts, 0);
    return turns;
  }
} // namespace Nacre
