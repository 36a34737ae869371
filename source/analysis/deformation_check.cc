// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/discretization/shell_edge_values.h>
#include <nacre/discretization/shell_values.h>
#include <nacre/forms/assembly.h>
#include <nacre/mechanics/corotational_strain.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace Nacre
{
  namespace
  {
    using TrilinosVector = TrilinosWrappers::MPI::Vector;
    using Vector3        = Tensor<1, spacedim>;
    using Dofs           = std::vector<types::global_dof_index>;

    constexpr double degrees = 180. / numbers::PI;

    /** Points of the reference cell, and which of them are next neighbours. */
    struct Lattice
    {
      /**
       * Twice as fine as the nodes of @p element: the normal of a polynomial
       * surface can't turn over and back between them.
       */
      explicit Lattice(const Element &element)
      {
        const unsigned int n         = 2 * element.degree;
        const bool         triangles = (element.type == ElementType::triangle);
        const auto         last      = [&](const unsigned int j) {
          return triangles ? n - j : n;
        };
        unsigned int below = 0;
        for (unsigned int j = 0; j <= n; ++j)
          {
            const unsigned int row = points.size();
            for (unsigned int i = 0; i <= last(j); ++i)
              {
                if (i > 0)
                  neighbors.emplace_back(points.size() - 1, points.size());
                if (j > 0)
                  neighbors.emplace_back(below + i, points.size());
                points.emplace_back(double(i) / n, double(j) / n);
              }
            below = row;
          }
      }

      std::vector<Point<dim>>                            points;
      std::vector<std::pair<unsigned int, unsigned int>> neighbors;
    };

    /** phi,1, phi,2 of a deformed cell at a point of a table. */
    template <typename Dof>
    std::array<Vector3, 2>
    deformed_basis(const SurfaceFrame<> &frame,
                   const ShapeTable     &shapes,
                   const unsigned int    q,
                   const TrilinosVector &u,
                   const Dofs           &dofs,
                   const Dof            &dof)
    {
      auto phi = frame.a_cov;
      for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            phi[alpha][c] += shapes.gradient(q, a)[alpha] * u(dofs[dof(a, c)]);
      return phi;
    }

    /** phi,1 and phi,2 at the point @p q of a cell. */
    std::array<Vector3, 2>
    deformed_basis(const ShellCellValues &values,
                   const unsigned int     q,
                   const TrilinosVector  &u,
                   const Dofs            &dofs)
    {
      const auto dof = [&](const unsigned int a, const unsigned int c) {
        return values.dof(a, c);
      };
      return deformed_basis(values.frame(q), values.shapes(), q, u, dofs, dof);
    }

    /** The rotation of the material at a point, by polar decomposition. */
    Tensor<2, spacedim>
    rotation(const SurfaceFrame<> &frame, const std::array<Vector3, 2> &phi)
    {
      const auto deformed = make_surface_frame<double>(phi[0], phi[1], {});
      const auto polar    = make_polar_rotation(frame, deformed);
      return outer_product(polar.q_cov[0], frame.a_con[0]) +
             outer_product(polar.q_cov[1], frame.a_con[1]) +
             outer_product(deformed.t0, frame.t0);
    }

    /** Points where the undeformed cell has an area: not a collapsed side. */
    std::vector<bool>
    regular_points(const ShellCellValues &values)
    {
      double largest = 0.;
      for (unsigned int q = 0; q < values.n_points(); ++q)
        largest = std::max(largest, values.frame(q).j0);
      std::vector<bool> regular(values.n_points());
      for (unsigned int q = 0; q < values.n_points(); ++q)
        regular[q] = values.frame(q).j0 > 1e-6 * largest;
      return regular;
    }

    std::string
    cell_at(const ShellCellValues &values, const unsigned int q)
    {
      std::ostringstream text;
      text << "the cell at (" << values.point(q)
           << ") of the undeformed surface ";
      return text.str();
    }

    /**
     * What is wrong with one cell, or "".
     * @param before null: whatever the step was
     */
    std::string
    check_cell(const ShellCellValues &values,
               const Lattice         &lattice,
               const TrilinosVector  *before,
               const TrilinosVector  &after,
               const double           allowed_bend,
               const Dofs            &dofs)
    {
      const auto                       regular = regular_points(values);
      std::vector<Tensor<2, spacedim>> turns(values.n_points());
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          if (!regular[q])
            continue;
          const auto         phi     = deformed_basis(values, q, after, dofs);
          const Vector3      normal  = cross_product_3d(phi[0], phi[1]);
          const double       stretch = normal.norm() / values.frame(q).j0;
          std::ostringstream text;
          if (!(stretch > 1e-3))
            {
              text << cell_at(values, q) << "has shrunk to " << stretch
                   << " of its area";
              return text.str();
            }
          if (before != nullptr)
            {
              const auto old = deformed_basis(values, q, *before, dofs);
              if (!(cross_product_3d(old[0], old[1]) * normal > 0.))
                return cell_at(values, q) +
                       "is turned over: its normal turns by more than 90 "
                       "degrees in one step";
            }
          turns[q] = rotation(values.frame(q), phi);
        }
      for (const auto &[p, q] : lattice.neighbors)
        {
          const double cosine = 0.5 * (scalar_product(turns[p], turns[q]) - 1.);
          if (!regular[p] || !regular[q] || cosine > std::cos(allowed_bend))
            continue;
          std::ostringstream text;
          text << cell_at(values, q) << "folds onto itself: it turns by "
               << degrees * std::acos(std::max(-1., cosine))
               << " degrees between two neighbouring points";
          return text.str();
        }
      return "";
    }

    /** The angle from t^- to t^+ about the edge (rad). */
    double
    fold_angle(const ShellEdgeValues &edge,
               const unsigned int     q,
               const TrilinosVector  &u)
    {
      std::array<Vector3, 2> t;
      Vector3                along;
      for (const unsigned int side : {0, 1})
        {
          const auto &frame = edge.frame(side, q);
          const auto  dof   = [&](const unsigned int a, const unsigned int c) {
            return edge.dof(side, a, c);
          };
          const auto phi = deformed_basis(frame,
                                          edge.shapes(side),
                                          q,
                                          u,
                                          edge.dof_indices(),
                                          dof);
          t[side] = edge.sigma(side, q) * cross_product_3d(phi[0], phi[1]);
          t[side] /= t[side].norm();
          if (side == 0)
            {
              const Vector3 undeformed =
                cross_product_3d(edge.conormal(0, q), frame.t0);
              for (unsigned int alpha = 0; alpha < dim; ++alpha)
                along += (frame.a_con[alpha] * undeformed) * phi[alpha];
            }
        }
      return std::atan2(cross_product_3d(t[0], t[1]) * along / along.norm(),
                        t[0] * t[1]);
    }

    /** What is wrong with one edge, or "". */
    std::string
    check_edge(const ShellEdgeValues &edge,
               const TrilinosVector  &before,
               const TrilinosVector  &after)
    {
      for (unsigned int q = 0; q < edge.n_points(); ++q)
        {
          const double jump =
            fold_angle(edge, q, after) - fold_angle(edge, q, before);
          if (std::abs(jump) < numbers::PI)
            continue;
          std::ostringstream text;
          text << "the fold angle of the edge at (" << edge.point(q)
               << ") of the undeformed surface jumps beyond 180 degrees";
          return text.str();
        }
      return "";
    }

    /** @param before null: whatever the step was */
    std::string
    check_all(const Discretization &discretization,
              const TrilinosVector *before,
              const TrilinosVector &after,
              const double          allowed_bend)
    {
      std::string     found;
      const Lattice   lattice(discretization.element());
      ShellCellValues values(discretization,
                             Quadrature<dim>(lattice.points),
                             false);
      values.use_tip_functions(false);
      ShellEdgeValues edge(discretization);
      Dofs            dofs(discretization.node_dofs().size());
      for (const CellPart &part : discretization.owned_parts())
        {
          if (!found.empty())
            break;
          // Beyond a part of a divided cell its polynomials mean nothing.
          if (!part.is_cut())
            {
              values.reinit_frames(part);
              discretization.get_dof_indices(part, dofs);
              found =
                check_cell(values, lattice, before, after, allowed_bend, dofs);
            }
          if (before == nullptr ||
              part.index() != part.cell->active_cell_index())
            continue;
          for (const auto f : part.cell->face_indices())
            edge.for_pieces_to_neighbor(part.cell, f, [&](const auto &piece) {
              if (found.empty())
                found = check_edge(piece, *before, after);
            });
        }
      for (const auto &text :
           Utilities::MPI::all_gather(discretization.communicator(), found))
        if (!text.empty())
          return text;
      return "";
    }
  } // namespace

  std::string
  find_impossible_deformation(const Discretization &discretization,
                              const TrilinosVector &before,
                              const TrilinosVector &after,
                              const double          allowed_bend)
  {
    return check_all(discretization, &before, after, allowed_bend);
  }

  std::string
  find_impossible_state(const Discretization &discretization,
                        const TrilinosVector &u,
                        const double          allowed_bend)
  {
    return check_all(discretization, nullptr, u, allowed_bend);
  }

  std::string
  find_torn_edge(const Assembly            &assembly,
                 const TrilinosVector      &u,
                 const PrescribedRotations &rotations,
                 const double               allowed)
  {
    const auto gap = assembly.rotation_conditions().largest_gap(u, rotations);
    if (gap.angle <= allowed)
      return "";
    std::ostringstream text;
    text << "the edge at (" << gap.position
         << ") of the undeformed surface is torn off its prescribed rotation, "
            "by "
         << degrees * gap.angle << " degrees";
    return text.str();
  }
} // namespace Nacre
