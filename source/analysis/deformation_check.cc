// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/analysis/deformation_check.h>
#include <nacre/discretization/shell_values.h>

#include <array>
#include <cmath>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using TrilinosVector = TrilinosWrappers::MPI::Vector;
    using Vector3        = Tensor<1, spacedim>;

    /** phi,1, phi,2 of a deformed cell at a point of a table. */
    template <typename Dof>
    std::array<Vector3, 2>
    deformed_basis(const SurfaceFrame<>                       &frame,
                   const ShapeTable                           &shapes,
                   const unsigned int                          q,
                   const TrilinosVector                       &u,
                   const std::vector<types::global_dof_index> &dofs,
                   const Dof                                  &dof)
    {
      auto phi = frame.a_cov;
      for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
        for (unsigned int c = 0; c < spacedim; ++c)
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            phi[alpha][c] += shapes.gradient(q, a)[alpha] * u(dofs[dof(a, c)]);
      return phi;
    }

    /** What is wrong with one cell, or "". */
    std::string
    check_cell(const ShellCellValues                      &values,
               const TrilinosVector                       &before,
               const TrilinosVector                       &after,
               const std::vector<types::global_dof_index> &dofs)
    {
      const auto dof = [&](const unsigned int a, const unsigned int c) {
        return values.dof(a, c);
      };
      for (unsigned int q = 0; q < values.n_points(); ++q)
        {
          const auto area = [&](const TrilinosVector &u) {
            const auto phi =
              deformed_basis(values.frame(q), values.shapes(), q, u, dofs, dof);
            return cross_product_3d(phi[0], phi[1]);
          };
          const Vector3      n_before = area(before), n_after = area(after);
          const double       stretch = n_after.norm() / values.frame(q).j0;
          std::ostringstream text;
          if (!(stretch > 1e-3))
            text << "the cell at (" << values.point(q)
                 << ") of the undeformed surface has shrunk to " << stretch
                 << " of its area";
          else if (!(n_before * n_after > 0.))
            text << "the cell at (" << values.point(q)
                 << ") of the undeformed surface is turned over: its normal "
                    "turns by more than 90 degrees in one step";
          if (!text.str().empty())
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
  } // namespace

  std::string
  find_impossible_deformation(const Discretization &discretization,
                              const TrilinosVector &before,
                              const TrilinosVector &after)
  {
    std::string                          found;
    ShellCellValues                      values(discretization,
                           discretization.element().reduced_quadrature(),
                           false);
    ShellEdgeValues                      edge(discretization);
    const unsigned int                   none = numbers::invalid_unsigned_int;
    std::vector<types::global_dof_index> dofs(
      discretization.node_dofs().size());
    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && found.empty())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          found = check_cell(values, before, after, dofs);
          for (const auto f : cell->face_indices())
            if (found.empty() && !cell->at_boundary(f) &&
                cell->neighbor(f)->is_active() && !cell->neighbor_is_coarser(f))
              {
                edge.reinit(cell,
                            f,
                            none,
                            cell->neighbor(f),
                            cell->neighbor_of_neighbor(f),
                            none);
                found = check_edge(edge, before, after);
              }
        }
    for (const auto &text :
         Utilities::MPI::all_gather(discretization.communicator(), found))
      if (!text.empty())
        return text;
    return "";
  }
} // namespace Nacre
