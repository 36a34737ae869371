// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_cut_graph_h
#define nacre_discretization_cut_graph_h

#include <nacre/discretization/cell_polygon.h>

#include <map>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * The plane graph of a polygon's sides and of the chains in it: edges meet
   * in nodes only. Its bounded faces are the parts.
   */
  class CutGraph
  {
  public:
    /** @param polygon has to outlive the graph */
    explicit CutGraph(const CellPolygon &polygon);

    void
    insert(const CutChain &chain);

    /** @throws ExcMessage if a closed chain makes a hole in a part */
    std::vector<CellPolygon>
    parts();

  private:
    using Side = CellPolygon::Side;
    /** From node to node. */
    using Edge = std::pair<unsigned int, unsigned int>;

    void
    insert(const Point<dim> &a, const Point<dim> &b, const Side &side);

    double
    distance(const Edge &edge, const Point<dim> &x) const;

    unsigned int
    node(Point<dim> x);

    void
    connect(const unsigned int a, const unsigned int b, const Side &side);

    void
    divide_edge(const Edge &edge, const unsigned int n);

    unsigned int
    node_on(const Edge &edge) const;

    Edge
    edge_across(const Edge &edge) const;

    void
    trace_cycles();

    bool
    drop_edges();

    CellPolygon
    part(const std::vector<unsigned int> &cycle) const;

    double
    area(const std::vector<unsigned int> &cycle) const;

    const CellPolygon      &polygon_;
    std::vector<Point<dim>> nodes_;
    /** The first node is the smaller one; sides are those of its way. */
    std::map<Edge, Side> edges_;
    /** Nodes around each face, which lies to the left. */
    std::vector<std::vector<unsigned int>> cycles_;
    /** Of both directions of an edge. */
    std::map<Edge, unsigned int> cycle_of_;
  };
} // namespace Nacre

#endif
