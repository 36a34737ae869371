// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/edge_nodes.h>
#include <nacre/discretization/plane_geometry.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Nacre
{
  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    Vector3
    of_length_one(const Vector3 &v)
    {
      return v / v.norm();
    }

    /** Unit normal and outward conormal at a point of a face. */
    std::pair<Vector3, Vector3>
    edge_directions(const DerivativeForm<1, dim, spacedim> &jacobian,
                    const ReferenceCell                    &cell,
                    const unsigned int                      face)
    {
      Vector3 a_1, a_2;
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          a_1[c] = jacobian[c][0];
          a_2[c] = jacobian[c][1];
        }
      const auto    along    = cell.unit_tangential_vectors<dim>(face, 0);
      const auto    outward  = cell.unit_normal_vectors<dim>(face);
      const Vector3 normal   = of_length_one(cross_product_3d(a_1, a_2));
      Vector3       conormal = of_length_one(
        cross_product_3d(along[0] * a_1 + along[1] * a_2, normal));
      if (conormal * (outward[0] * a_1 + outward[1] * a_2) < 0.)
        conormal *= -1.;
      return {normal, conormal};
    }

    /** Largest angle (rad) between @p normal and those of the cell's nodes. */
    double
    largest_turn(const FEValuesBase<dim, spacedim> &fe_values,
                 const Vector3                     &normal)
    {
      double sine = 0.;
      for (unsigned int q = 0; q < fe_values.n_quadrature_points; ++q)
        {
          const auto   &J = fe_values.jacobian(q);
          const Vector3 a_1({J[0][0], J[1][0], J[2][0]});
          const Vector3 a_2({J[0][1], J[1][1], J[2][1]});
          sine =
            std::max(sine,
                     cross_product_3d(of_length_one(cross_product_3d(a_1, a_2)),
                                      normal)
                       .norm());
        }
      return std::asin(std::min(1., sine));
    }

    /** Where the edge of a part beside a cut is on the part's side. */
    class EdgeContinuation
    {
    public:
      EdgeContinuation(const Discretization &discretization,
                       const CellPart       &part,
                       const unsigned int    face)
        : fe_(discretization.scalar_fe())
      {
        for (const CutLip &lip : discretization.cell_parts().lips(part))
          lips_.push_back({{lip.begin, lip.begin + lip.along}});
        if (lips_.empty())
          return;
        const auto cell = part.cell->reference_cell();
        start_ = cell.vertex<dim>(cell.face_to_cell_vertices(face, 0, 1));
        along_ =
          cell.vertex<dim>(cell.face_to_cell_vertices(face, 1, 1)) - start_;
        nodes_ = discretization.node_positions(part);
        for (const auto &piece :
             discretization.cell_parts().pieces_of(part, face))
          intervals_.push_back(piece.sides[0].interval);
        const auto longest =
          std::max_element(intervals_.begin(),
                           intervals_.end(),
                           [](const auto &a, const auto &b) {
                             return a[1] - a[0] < b[1] - b[0];
                           });
        const double length = (*longest)[1] - (*longest)[0];
        // A polynomial of degree n magnifies round-off by length^-n; a short
        // interval, of a small part, continues with a lower degree.
        const double largest = 1e7;
        const double degree =
          std::min<double>(discretization.degree(),
                           std::log(largest) /
                             -std::log(std::min(length, 1. - 1e-9)));
        // Not at the cut, where an expression may be that of the other side
        const QGauss<1> rule(static_cast<unsigned int>(degree) + 1);
        for (const auto &x : rule.get_points())
          points_.emplace_back((*longest)[0] + x[0] * length);
      }

      /** The number of samples of the node @p a, their places and weights. */
      void
      append_samples(const unsigned int a, std::vector<double> &numbers) const
      {
        if (intervals_.empty())
          {
            numbers.push_back(0);
            return;
          }
        const Point<dim> &node = fe_.unit_support_point(a);
        const double      s = (node - start_) * along_ / along_.norm_square();
        const double      tolerance = 1e-9;
        // A node on the cut itself is one of either side.
        const bool is_on_lip =
          std::any_of(lips_.begin(), lips_.end(), [&](const auto &ends) {
            return PlaneGeometry::nearest_on_segment(ends[0], ends[1], node)
                     .distance(node) < tolerance;
          });
        const bool is_inside =
          !is_on_lip && std::any_of(intervals_.begin(),
                                    intervals_.end(),
                                    [&](const auto &interval) {
                                      return s > interval[0] - tolerance &&
                                             s < interval[1] + tolerance;
                                    });
        numbers.push_back(is_inside ? 0 : points_.size());
        if (is_inside)
          return;
        const auto basis =
          Polynomials::generate_complete_Lagrange_basis(points_);
        for (unsigned int j = 0; j < points_.size(); ++j)
          {
            const Point<dim> unit = start_ + points_[j][0] * along_;
            Point<spacedim>  x;
            for (unsigned int b = 0; b < nodes_.size(); ++b)
              x += fe_.shape_value(b, unit) * nodes_[b];
            numbers.insert(numbers.end(), x.begin_raw(), x.end_raw());
            numbers.push_back(basis[j].value(s));
          }
      }

    private:
      const FiniteElement<dim, spacedim> &fe_;
      Point<dim>                          start_;
      Tensor<1, dim>                      along_;
      std::vector<Point<spacedim>>        nodes_;
      std::vector<std::array<double, 2>>  intervals_;
      /** Both ends of each. */
      std::vector<std::array<Point<dim>, 2>> lips_;
      std::vector<Point<1>>                  points_;
    };

    std::vector<EdgeNode>
    gather(const std::vector<double> &mine, const MPI_Comm communicator)
    {
      std::vector<EdgeNode> nodes;
      for (const auto &numbers : Utilities::MPI::all_gather(communicator, mine))
        for (unsigned int k = 0; k < numbers.size();)
          {
            EdgeNode node;
            node.id = static_cast<types::boundary_id>(numbers[k + 3]);
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                node.dofs[c] =
                  static_cast<types::global_dof_index>(numbers[k + c]);
                node.position[c] = numbers[k + 4 + c];
                node.normal[c]   = numbers[k + 7 + c];
                node.conormal[c] = numbers[k + 10 + c];
              }
            node.turn = numbers[k + 13];
            const unsigned int n_samples =
              static_cast<unsigned int>(numbers[k + 14]);
            k += 15;
            for (unsigned int i = 0; i < n_samples; ++i, k += 4)
              node.samples.emplace_back(Point<spacedim>(numbers[k],
                                                        numbers[k + 1],
                                                        numbers[k + 2]),
                                        numbers[k + 3]);
            nodes.push_back(node);
          }
      // A node has the same mean directions on any number of ranks.
      std::sort(nodes.begin(), nodes.end(), [](const auto &a, const auto &b) {
        return std::lexicographical_compare(a.conormal.begin_raw(),
                                            a.conormal.end_raw(),
                                            b.conormal.begin_raw(),
                                            b.conormal.end_raw());
      });
      return nodes;
    }

    std::vector<EdgeNode>
    average(const std::vector<EdgeNode> &nodes)
    {
      std::map<std::pair<types::boundary_id, types::global_dof_index>, EdgeNode>
        means;
      for (const auto &node : nodes)
        {
          const auto [entry, is_new] =
            means.emplace(std::make_pair(node.id, node.dofs[0]), node);
          if (!is_new)
            {
              entry->second.normal += node.normal;
              entry->second.conormal += node.conormal;
              entry->second.turn = std::max(entry->second.turn, node.turn);
            }
        }
      std::vector<EdgeNode> result;
      for (auto &[key, node] : means)
        {
          node.normal   = of_length_one(node.normal);
          node.conormal = of_length_one(node.conormal);
          result.push_back(node);
        }
      return result;
    }
  } // namespace

  std::vector<EdgeNode>
  collect_edge_nodes(const Discretization     &discretization,
                     const BoundaryConditions &boundary_conditions)
  {
    const auto &fe        = discretization.scalar_fe();
    const auto &node_dofs = discretization.node_dofs();

    FE_Nothing<dim, spacedim> fe_nothing(
      discretization.element().reference_cell());
    FEValues<dim, spacedim> fe_values(discretization.mapping(),
                                      fe_nothing,
                                      fe.get_unit_support_points(),
                                      update_jacobians);
    // dofs, id, position, normal, conormal, turn, samples: plain numbers for
    // the exchange.
    std::vector<double>                  mine;
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const CellPart &part : discretization.owned_parts())
      if (part.cell->at_boundary())
        for (const auto face : part.cell->face_indices())
          {
            if (!part.cell->at_boundary(face))
              continue;
            const auto edge = boundary_conditions.edges().find(
              part.cell->face(face)->boundary_id());
            // A part without an interval of the edge isn't held by it.
            if (edge == boundary_conditions.edges().end() ||
                discretization.cell_parts().pieces_of(part, face).empty())
              continue;
            fe_values.reinit(
              static_cast<Triangulation<dim, spacedim>::cell_iterator>(
                part.cell));
            discretization.get_dof_indices(part, dofs);
            const auto positions = discretization.node_positions(part);
            const EdgeContinuation continuation(discretization, part, face);
            for (const unsigned int a : discretization.face_nodes(face))
              {
                const auto [normal, conormal] =
                  edge_directions(fe_values.jacobian(a),
                                  part.cell->reference_cell(),
                                  face);
                for (unsigned int c = 0; c < spacedim; ++c)
                  mine.push_back(dofs[node_dofs[spacedim * a + c]]);
                mine.push_back(edge->second.edge);
                for (const auto &v : {Vector3(positions[a]), normal, conormal})
                  mine.insert(mine.end(), v.begin_raw(), v.end_raw());
                mine.push_back(largest_turn(fe_values, normal));
                continuation.append_samples(a, mine);
              }
          }
    return average(gather(mine, discretization.communicator()));
  }
} // namespace Nacre
