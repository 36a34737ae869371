// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cut_graph.h>
#include <nacre/discretization/plane_geometry.h>

#include <algorithm>
#include <cmath>

// CGAL's arrangements do the same in exact numbers, but their licence is the
// GPL, and a tolerance is wanted here.

namespace Nacre
{
  using namespace PlaneGeometry;

  namespace
  {
    constexpr double smallest_part = 1e-14;

    /** The key of an edge in the map. */
    std::pair<unsigned int, unsigned int>
    sorted(const std::pair<unsigned int, unsigned int> &edge)
    {
      return std::minmax(edge.first, edge.second);
    }

    /**
     * The side of @p edge, if it is that of the sorted edge, and the reverse:
     * who walks back has the cut's left on the other hand.
     */
    CellPolygon::Side
    seen_along(CellPolygon::Side                            side,
               const std::pair<unsigned int, unsigned int> &edge)
    {
      if (side.face == numbers::invalid_unsigned_int &&
          edge.first > edge.second)
        side.is_left = !side.is_left;
      return side;
    }

    /** Where a part stands in the order: no symmetry prefers the direction. */
    double
    rank_along(const Point<dim> &x)
    {
      return x[0] + 0.6180339887 * x[1];
    }

    Point<dim>
    centroid(const CellPolygon &polygon)
    {
      Tensor<1, dim> moment;
      double         area = 0.;
      for (const auto &[a, b, c] : polygon.triangles())
        {
          moment += twice_area(a, b, c) / 3. * (a + Tensor<1, dim>(b) + c);
          area += twice_area(a, b, c);
        }
      return Point<dim>(moment / area);
    }
  } // namespace

  CutGraph::CutGraph(const CellPolygon &polygon)
    : polygon_(polygon)
  {
    for (unsigned int i = 0; i < polygon.n_vertices(); ++i)
      insert(polygon.vertex(i),
             polygon.vertex((i + 1) % polygon.n_vertices()),
             polygon.side(i));
  }

  void
  CutGraph::insert(const CutChain &chain)
  {
    Assert(chain.points.size() > 1, ExcMessage("A chain has two points."));
    for (unsigned int i = 1; i < chain.points.size(); ++i)
      insert(chain.points[i - 1],
             chain.points[i],
             {numbers::invalid_unsigned_int, chain.cut, true});
  }

  void
  CutGraph::insert(const Point<dim> &a, const Point<dim> &b, const Side &side)
  {
    const unsigned int start = node(a);
    connect(start, node(b), side);
  }

  double
  CutGraph::distance(const Edge &edge, const Point<dim> &x) const
  {
    return nearest_on_segment(nodes_[edge.first], nodes_[edge.second], x)
      .distance(x);
  }

  /** The node at @p x, which may be new and then divides the edges there. */
  unsigned int
  CutGraph::node(Point<dim> x)
  {
    const auto find = [&] {
      const auto same =
        std::find_if(nodes_.begin(), nodes_.end(), [&](const auto &y) {
          return x.distance(y) < snap_distance;
        });
      return static_cast<unsigned int>(same - nodes_.begin());
    };
    if (const unsigned int n = find(); n < nodes_.size())
      return n;
    // Put it on the edge rather than bend the edge.
    double     nearest = snap_distance;
    Point<dim> on      = x;
    for (const auto &[edge, side] : edges_)
      if (const double d = distance(edge, x); d < nearest)
        {
          nearest = d;
          on = nearest_on_segment(nodes_[edge.first], nodes_[edge.second], x);
        }
    x = on;
    if (const unsigned int n = find(); n < nodes_.size())
      return n;

    const unsigned int n = nodes_.size();
    nodes_.push_back(x);
    std::vector<Edge> crowded;
    for (const auto &[edge, side] : edges_)
      if (distance(edge, x) < 0.5 * snap_distance)
        crowded.push_back(edge);
    for (const auto &edge : crowded)
      divide_edge(edge, n);
    return n;
  }

  void
  CutGraph::divide_edge(const Edge &edge, const unsigned int n)
  {
    const auto found = edges_.find(edge);
    if (found == edges_.end() || n == edge.first || n == edge.second)
      return;
    const Side side = found->second;
    edges_.erase(found);
    connect(edge.first, n, side);
    connect(n, edge.second, side);
  }

  /** A node that lies on the @p edge between its ends, or invalid. */
  unsigned int
  CutGraph::node_on(const Edge &edge) const
  {
    for (unsigned int n = 0; n < nodes_.size(); ++n)
      if (n != edge.first && n != edge.second &&
          distance(edge, nodes_[n]) < 0.5 * snap_distance)
        return n;
    return numbers::invalid_unsigned_int;
  }

  /** An edge that crosses @p edge between both's ends, or invalid nodes. */
  CutGraph::Edge
  CutGraph::edge_across(const Edge &edge) const
  {
    const auto parted = [&](const Edge &line, const Edge &ends) {
      const auto side = [&](const unsigned int n) {
        return twice_area(nodes_[line.first], nodes_[line.second], nodes_[n]);
      };
      return side(ends.first) * side(ends.second) < 0.;
    };
    for (const auto &[other, side] : edges_)
      if (other.first != edge.first && other.first != edge.second &&
          other.second != edge.first && other.second != edge.second &&
          parted(edge, other) && parted(other, edge))
        return other;
    return {numbers::invalid_unsigned_int, numbers::invalid_unsigned_int};
  }

  /** Edges from @p a to @p b through all that lies between. */
  void
  CutGraph::connect(const unsigned int a,
                    const unsigned int b,
                    const Side        &side)
  {
    if (a == b)
      return;
    unsigned int between = node_on({a, b});
    if (between == numbers::invalid_unsigned_int)
      if (const Edge other = edge_across({a, b});
          other.first != numbers::invalid_unsigned_int)
        {
          const Point<dim> &start = nodes_[other.first];
          const Point<dim> &end   = nodes_[other.second];
          const double      from  = twice_area(nodes_[a], nodes_[b], start);
          const double      to    = twice_area(nodes_[a], nodes_[b], end);
          between = node(start + from / (from - to) * (end - start));
          divide_edge(other, between);
        }
    if (between != numbers::invalid_unsigned_int)
      {
        connect(a, between, side);
        connect(between, b, side);
      }
    else if (polygon_.contains(nodes_[a] + 0.5 * (nodes_[b] - nodes_[a]),
                               snap_distance))
      {
        // A face stays one, else the first lip to come.
        const auto place =
          edges_.emplace(sorted({a, b}), seen_along(side, {a, b})).first;
        if (side.face != numbers::invalid_unsigned_int)
          place->second = side;
      }
  }

  /** Walk around all faces, with the face to the left. */
  void
  CutGraph::trace_cycles()
  {
    std::vector<std::vector<std::pair<double, unsigned int>>> around(
      nodes_.size());
    for (const auto &[edge, side] : edges_)
      for (const auto &[a, b] : {edge, Edge(edge.second, edge.first)})
        {
          const Tensor<1, dim> ab = nodes_[b] - nodes_[a];
          around[a].emplace_back(std::atan2(ab[1], ab[0]), b);
        }
    for (auto &neighbours : around)
      std::sort(neighbours.begin(), neighbours.end());

    // At the end of an edge go on along the next one clockwise.
    const auto next = [&](const Edge &edge) {
      const auto &all = around[edge.second];
      const auto  back =
        std::find_if(all.begin(), all.end(), [&](const auto &neighbour) {
          return neighbour.second == edge.first;
        });
      return Edge(edge.second,
                  (back == all.begin() ? all.back() : *(back - 1)).second);
    };
    cycles_.clear();
    cycle_of_.clear();
    for (const auto &[edge, side] : edges_)
      for (Edge e : {edge, Edge(edge.second, edge.first)})
        {
          if (cycle_of_.count(e) != 0)
            continue;
          cycles_.emplace_back();
          for (; cycle_of_.emplace(e, cycles_.size() - 1).second; e = next(e))
            cycles_.back().push_back(e.first);
        }
  }

  double
  CutGraph::area(const std::vector<unsigned int> &cycle) const
  {
    double twice = 0.;
    for (unsigned int i = 2; i < cycle.size(); ++i)
      twice +=
        twice_area(nodes_[cycle[0]], nodes_[cycle[i - 1]], nodes_[cycle[i]]);
    return 0.5 * twice;
  }

  /**
   * Drop the edges that have the same face on both sides, which are the
   * chains' loose ends, or else the longest lip of a face that is too small.
   * @return whether any were dropped
   */
  bool
  CutGraph::drop_edges()
  {
    std::vector<Edge> dropped;
    for (const auto &[edge, side] : edges_)
      if (cycle_of_.at(edge) == cycle_of_.at({edge.second, edge.first}))
        dropped.push_back(edge);
    for (const auto &cycle : cycles_)
      if (dropped.empty() && std::abs(area(cycle)) < smallest_part)
        {
          double longest = 0.;
          for (unsigned int i = 0; i < cycle.size(); ++i)
            {
              const Edge edge =
                sorted({cycle[i], cycle[(i + 1) % cycle.size()]});
              const double length =
                nodes_[edge.first].distance(nodes_[edge.second]);
              if (edges_.at(edge).face == numbers::invalid_unsigned_int &&
                  length > longest)
                {
                  longest = length;
                  dropped = {edge};
                }
            }
        }
    for (const auto &edge : dropped)
      edges_.erase(edge);
    return !dropped.empty();
  }

  CellPolygon
  CutGraph::part(const std::vector<unsigned int> &cycle) const
  {
    // Start at a vertex that doesn't depend on the nodes' numbers.
    auto from = cycle;
    std::rotate(from.begin(),
                std::min_element(from.begin(),
                                 from.end(),
                                 [&](const auto a, const auto b) {
                                   return rank_along(nodes_[a]) <
                                          rank_along(nodes_[b]);
                                 }),
                from.end());
    std::vector<Point<dim>> vertices;
    std::vector<Side>       sides;
    for (unsigned int i = 0; i < from.size(); ++i)
      {
        const Edge edge(from[i], from[(i + 1) % from.size()]);
        vertices.push_back(nodes_[from[i]]);
        sides.push_back(seen_along(edges_.at(sorted(edge)), edge));
      }
    return {polygon_.reference_cell(), vertices, sides};
  }

  std::vector<CellPolygon>
  CutGraph::parts()
  {
    do
      trace_cycles();
    while (drop_edges());

    std::vector<CellPolygon> inside;
    unsigned int             n_outlines = 0;
    for (const auto &cycle : cycles_)
      if (area(cycle) < 0.)
        ++n_outlines;
      else if (const auto face = part(cycle);
               polygon_.contains(face.inner_point(), 0.))
        inside.push_back(face);
    AssertThrow(n_outlines == 1,
                ExcMessage("a closed cut lies inside one cell; refine the "
                           "mesh there"));

    std::sort(inside.begin(),
              inside.end(),
              [](const auto &first, const auto &second) {
                return rank_along(centroid(first)) <
                       rank_along(centroid(second));
              });
    return inside;
  }
} // namespace Nacre
