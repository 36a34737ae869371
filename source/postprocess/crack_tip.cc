// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/postprocess/crack_tip.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace Nacre
{
  namespace
  {
    /** What the cells of a rank know of a vertex. */
    struct VertexEdges
    {
      /** Tangents of the boundary's edges that begin there. */
      std::vector<Tensor<1, 3>> lips;
      /** Normals of the cells. */
      std::vector<Tensor<1, 3>> normals;
      double                    longest_edge = 0.;
      types::material_id        region       = 0;
    };

    /** The distance of the nearest vertex of all cells, and that vertex. */
    std::pair<double, Point<3>>
    nearest_vertex(const Discretization &discretization, const Point<3> &point)
    {
      std::pair<double, Point<3>> nearest(std::numeric_limits<double>::max(),
                                          {});
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto &x = discretization.geometry_nodes(cell)[v];
              nearest       = std::min(nearest,
                                 std::make_pair(x.distance(point), x),
                                 [](const auto &a, const auto &b) {
                                   return a.first < b.first;
                                 });
            }
      const auto all =
        Utilities::MPI::all_gather(discretization.communicator(), nearest);
      return *std::min_element(all.begin(),
                               all.end(),
                               [](const auto &a, const auto &b) {
                                 return a.first < b.first;
                               });
    }

    /** Add what a cell knows of its own vertex @p v. */
    void
    add_vertex(const Discretization                                  &mesh,
               const DoFHandler<dim, spacedim>::active_cell_iterator &cell,
               const unsigned int                                     v,
               VertexEdges                                           &edges)
    {
      const auto            reference = cell->reference_cell();
      const auto            nodes     = mesh.geometry_nodes(cell);
      const Point<2>        unit      = reference.template vertex<2>(v);
      const GeometryTable   table(mesh.geometry_fe(), {unit});
      GeometryTable::Values values;
      table.evaluate(nodes, values);
      const auto normal =
        cross_product_3d(values.tangent(0, 0), values.tangent(0, 1));
      edges.normals.push_back(normal / normal.norm());
      edges.region = cell->material_id();
      for (const unsigned int face : cell->face_indices())
        {
          const auto end = [&](const unsigned int i) {
            return reference.face_to_cell_vertices(face, i, 1);
          };
          if (end(0) != v && end(1) != v)
            continue;
          const unsigned int other = end(0) == v ? end(1) : end(0);
          edges.longest_edge =
            std::max(edges.longest_edge, nodes[v].distance(nodes[other]));
          if (!cell->at_boundary(face))
            continue;
          const auto d = reference.template vertex<2>(other) - unit;
          const auto tangent =
            d[0] * values.tangent(0, 0) + d[1] * values.tangent(0, 1);
          edges.lips.push_back(tangent / tangent.norm());
        }
    }

    /** The sum over all ranks. */
    VertexEdges
    edges_at(const Discretization &discretization, const Point<3> &vertex)
    {
      VertexEdges mine;
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (discretization.geometry_nodes(cell)[v].distance(vertex) <
                1e-6 * cell->diameter())
              add_vertex(discretization, cell, v, mine);

      VertexEdges all;
      for (const auto &[lips, normals, longest, region] :
           Utilities::MPI::all_gather(discretization.communicator(),
                                      std::make_tuple(mine.lips,
                                                      mine.normals,
                                                      mine.longest_edge,
                                                      mine.region)))
        {
          all.lips.insert(all.lips.end(), lips.begin(), lips.end());
          all.normals.insert(all.normals.end(), normals.begin(), normals.end());
          all.longest_edge = std::max(all.longest_edge, longest);
          all.region       = std::max(all.region, region);
        }
      return all;
    }

    std::string
    coordinates(const Point<3> &x)
    {
      return "(" + Text::number(x[0]) + ", " + Text::number(x[1]) + ", " +
             Text::number(x[2]) + ")";
    }
  } // namespace

  CrackTip
  find_crack_tip(const Discretization &discretization,
                 const Point<3>       &point,
                 const std::string    &where)
  {
    const auto [distance, vertex] = nearest_vertex(discretization, point);
    const auto        edges       = edges_at(discretization, vertex);
    const std::string there       = where + ": at " + coordinates(vertex) + " ";
    AssertThrow(distance <= 0.01 * edges.longest_edge,
                ExcMessage(where + ": no vertex of the mesh lies at " +
                           coordinates(point) + "; the nearest one is " +
                           coordinates(vertex) +
                           ". The tip of a crack is the vertex in which a "
                           "slit of the mesh ends."));
    const std::string advice =
      " Give the vertex in which a slit of the mesh file ends "
      "(Mid-surface/file/Slits = allowed).";
    AssertThrow(!edges.lips.empty(),
                ExcMessage(there +
                           "no crack ends: the point lies inside the "
                           "shell, away from its edges." +
                           advice));
    AssertThrow(edges.lips.size() == 2,
                ExcMessage(there + std::to_string(edges.lips.size()) +
                           " edges of the boundary meet; at the tip of a "
                           "crack two do." +
                           advice));
    const double cosine = edges.lips[0] * edges.lips[1];
    const double angle =
      std::acos(std::max(-1., std::min(1., cosine))) * 180. / numbers::PI;
    AssertThrow(angle < 1.,
                ExcMessage(there +
                           "no crack ends: the edges of the boundary "
                           "there enclose an angle of " +
                           Text::number(angle) +
                           " degrees, the lips of a crack none." + advice));

    CrackTip tip{SectionPoint(vertex, edges.region), {}, edges.longest_edge};
    Tensor<1, 3> normal;
    for (const auto &t0 : edges.normals)
      normal += t0;
    auto      &e = tip.axes;
    const auto d = edges.lips[0] + edges.lips[1];
    e[2]         = normal / normal.norm();
    e[0]         = (d * e[2]) * e[2] - d;
    e[0] /= e[0].norm();
    e[1] = cross_product_3d(e[2], e[0]);
    return tip;
  }
} // namespace Nacre
