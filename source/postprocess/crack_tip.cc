// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/postprocess/crack_tip.h>
#include <nacre/problem/cuts.h>

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

    /** The distance of a point from this rank's lines of all cuts but one. */
    double
    distance_of_other_cuts(const Discretization &discretization,
                           const unsigned int    cut,
                           const Point<3>       &x)
    {
      double nearest = std::numeric_limits<double>::max();
      for (const auto &line : discretization.cut_lines())
        if (line.cut != cut)
          for (unsigned int i = 0; i + 1 < line.points.size(); ++i)
            {
              const Tensor<1, 3> d = line.points[i + 1] - line.points[i];
              if (d.norm() == 0.)
                continue;
              const double part = ((x - line.points[i]) * d) / (d * d);
              const auto   place =
                line.points[i] + std::min(1., std::max(0., part)) * d;
              nearest = std::min(nearest, x.distance(place));
            }
      return nearest;
    }

    /** The other end of the cut's last line, which ends at the tip. */
    Point<3>
    begin_of_last_line(const Discretization &discretization,
                       const CutTrace::Tip  &tip)
    {
      std::vector<Point<3>> mine;
      for (const auto &line : discretization.cut_lines())
        {
          if (line.cut != tip.cut)
            continue;
          const auto  &a = line.points.front(), &b = line.points.back();
          const double near = 1e-6 * a.distance(b);
          if (b.distance(tip.position) <= near)
            mine.push_back(a);
          else if (a.distance(tip.position) <= near)
            mine.push_back(b);
        }
      for (const auto &of_rank :
           Utilities::MPI::all_gather(discretization.communicator(), mine))
        if (!of_rank.empty())
          return of_rank.front();
      return tip.position;
    }

    /** What the cell of the tip of a cut tells; of one rank. */
    struct TipCell
    {
      double longest_edge = 0.;
      /** Whether the cut ends inside the cell or along an edge of it. */
      bool ends_inside = false;
      /** The vertex behind the tip, where the cut runs along an edge. */
      std::vector<Point<3>> behind = {};
    };

    /** @param begin of the cut's last line */
    TipCell
    tip_cell(const Discretization &discretization,
             const CutTrace::Tip  &tip,
             const Point<3>       &begin)
    {
      TipCell result;
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        {
          if (!cell->is_locally_owned() || cell->id() != tip.cell)
            continue;
          const auto            reference = cell->reference_cell();
          const auto            nodes     = discretization.geometry_nodes(cell);
          GeometryTable::Values values;
          GeometryTable(discretization.geometry_fe(), {tip.unit})
            .evaluate(nodes, values);
          // An edge on which the cut ends, coming through the cell, ends the
          // crack. One along which it runs is closed as a whole.
          result.ends_inside  = true;
          result.longest_edge = discretization.longest_edge(cell);
          for (const unsigned int face : cell->face_indices())
            {
              const auto end = [&](const unsigned int i) {
                return reference.face_to_cell_vertices(face, i, 1);
              };
              const auto first = reference.template vertex<2>(end(0));
              const auto d     = reference.template vertex<2>(end(1)) - first;
              const auto y     = tip.unit - first;
              if (std::abs(d[0] * y[1] - d[1] * y[0]) > 1e-10)
                continue;
              const auto along =
                d[0] * values.tangent(0, 0) + d[1] * values.tangent(0, 1);
              const bool is_vertex =
                std::min(y * d, d * d - y * d) < 1e-10 * (d * d);
              // A cut that has been moved into a vertex runs along the edge in
              // the mesh, and beside it by its direction.
              const auto is_along = [&](const Tensor<1, 3> &line) {
                return std::abs(along * line) >=
                       (1. - 1e-6) * along.norm() * line.norm();
              };
              if (is_vertex ||
                  !(is_along(tip.direction) || is_along(tip.position - begin)))
                result.ends_inside = false;
              else
                result.behind.push_back(
                  nodes[end(along * tip.direction > 0. ? 0 : 1)]);
            }
        }
      return result;
    }

    /** The normal at a place, the same on all ranks. */
    Tensor<1, 3>
    normal_at(const Discretization &discretization, const SurfacePoint &place)
    {
      Tensor<1, 3> normal;
      if (place.is_mine)
        {
          GeometryTable::Values values;
          GeometryTable(discretization.geometry_fe(), {place.unit})
            .evaluate(discretization.geometry_nodes(place.part), values);
          normal = cross_product_3d(values.tangent(0, 0), values.tangent(0, 1));
          normal /= normal.norm();
        }
      return Utilities::MPI::sum(normal, discretization.communicator());
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

  const CutTrace::Tip &
  find_cut_tip(const Discretization &discretization,
               const Cuts           &cuts,
               const unsigned int    cut,
               const bool            at_end,
               const std::string    &where)
  {
    const auto       &curve = cuts.curves[cut];
    const std::string name  = "'" + curve.name + "'";
    const std::string end   = at_end ? "end" : "begin";
    AssertThrow(!curve.is_closed,
                ExcMessage(where + ": the cut " + name +
                           " is closed; it has no tips."));
    const auto &tips  = discretization.tips();
    const auto  found = std::find_if(tips.begin(), tips.end(), [&](auto &tip) {
      return tip.cut == cut && tip.at_end == at_end;
    });
    AssertThrow(found != tips.end(),
                ExcMessage(where + ": the " + end + " of the cut " + name +
                           " is no tip; it lies outside of the surface "
                           "or on another cut."));
    const MPI_Comm communicator = discretization.communicator();
    const double   distance     = Utilities::MPI::min(
      distance_of_other_cuts(discretization, cut, found->position),
      communicator);
    const double size = Utilities::MPI::max(
      tip_cell(discretization, *found, found->position).longest_edge,
      communicator);
    AssertThrow(distance > 1e-3 * size,
                ExcMessage(where + ": the " + end + " of the cut " + name +
                           " is no tip; it lies on another cut."));
    return *found;
  }

  CrackTip
  make_crack_tip(const Discretization &discretization,
                 const CutTrace::Tip  &tip,
                 const std::string    &where)
  {
    const MPI_Comm communicator = discretization.communicator();
    Point<3>       begin        = begin_of_last_line(discretization, tip);
    const TipCell  mine         = tip_cell(discretization, tip, begin);
    const double   size = Utilities::MPI::max(mine.longest_edge, communicator);
    const bool     ends_inside =
      Utilities::MPI::max(mine.ends_inside ? 1 : 0, communicator) == 1;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(communicator, mine.behind))
      if (!of_rank.empty())
        begin = of_rank.front();
    const auto place = discretization.nearest(
      ends_inside && !discretization.opens_tip(tip) ? begin : tip.position);
    const auto normal = normal_at(discretization, place);
    const auto region =
      Utilities::MPI::max(place.is_mine ? place.part.cell->material_id() : 0u,
                          communicator);

    CrackTip result{SectionPoint(place.position, region), {}, size};
    auto    &e = result.axes;
    e[2]       = normal;
    e[0]       = tip.direction - (tip.direction * normal) * normal;
    e[0] /= e[0].norm();
    e[1]                     = cross_product_3d(e[2], e[0]);
    const Tensor<1, 3> ahead = tip.position - place.position;
    result.has_functions     = discretization.has_tip_functions();
    result.closed            = std::max(0., ahead * e[0]);
    AssertThrow(std::abs(ahead * e[1]) <= 0.05 * size,
                ExcMessage(where +
                           ": the cut turns within the cell in which "
                           "it ends, at " +
                           coordinates(tip.position) +
                           ", where the mesh doesn't open it; refine the mesh "
                           "there."));
    return result;
  }
} // namespace Nacre
