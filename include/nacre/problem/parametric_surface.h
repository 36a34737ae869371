// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_parametric_surface_h
#define nacre_problem_parametric_surface_h

#include <nacre/base/mesh_region.h>
#include <nacre/base/types.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * The map phi0 from chart points to positions (length). Surfaces over a
   * rectangle have chart points (u, v, 0).
   */
  class ChartMap
  {
  public:
    virtual ~ChartMap() = default;

    /** The position of the chart point @p chart. */
    virtual Point<3>
    operator()(const Point<3> &chart) const = 0;
  };

  /** A ChartMap from a callable (const Point<3> &) -> Point<3>. */
  template <typename Function>
  std::unique_ptr<const ChartMap>
  make_chart_map(Function function)
  {
    class Map : public ChartMap
    {
    public:
      Map(Function &&function)
        : function_(std::move(function))
      {}

      Point<3>
      operator()(const Point<3> &chart) const override
      {
        return function_(chart);
      }

    private:
      Function function_;
    };

    return std::make_unique<const Map>(std::move(function));
  }

  /** What the names of edges mean beyond those of single edges. */
  struct EdgeNames
  {
    /** The name of the sides that no name in use holds; empty: none. */
    std::string rest = {};
    /** Whether "ROOT" and "Root" are one name. */
    bool ignore_case = false;
    /** Sets of the file that are no edges, and why, in a sentence. */
    std::map<std::string, std::string> no_edges = {};
    /** What is to be noted about an edge if a parameter names it. */
    std::map<std::string, std::string> notes = {};
  };

  /**
   * A surface as its makers describe it: coarse cells with the charts of
   * their corners, the map of the chart to space, and the boundary edges.
   */
  struct SurfaceDescription
  {
    /** All cells are quadrilaterals, or all are triangles. */
    struct Cell
    {
      /**
       * Three corners, or four in deal.II's lexicographic order: (0,0), (1,0),
       * (0,1), (1,1).
       */
      std::vector<unsigned int> vertices = std::vector<unsigned int>(4);
      /**
       * Charts of the corners, in cells of the second order also of the
       * middles of the sides and of the centre: see CoarseCell. A vertex of a
       * closed surface has another chart in each cell.
       */
      std::vector<Point<3>> chart = std::vector<Point<3>>(4);
      /** Index into the regions. */
      unsigned int region = 0;
    };

    /** A part of the boundary with a name and others for the same part. */
    struct Edge
    {
      std::string              name;
      std::vector<std::string> aliases;
      /** Whether a chart point lies on this edge. */
      std::function<bool(const Point<3> &chart)> contains;
      /** "the side between the nodes 1 and 2"; empty but for mesh files. */
      std::string example = {};
    };

    /** A line by its end vertices, the smaller first. */
    using Line = std::pair<unsigned int, unsigned int>;

    unsigned int                    n_vertices = 0;
    std::vector<Cell>               cells;
    std::vector<Edge>               edges;
    std::unique_ptr<const ChartMap> map;
    /**
     * The index of the edge of every boundary line, in place of
     * Edge::contains; for mesh files.
     */
    std::map<Line, unsigned int> edge_of_line;
    EdgeNames                    edge_names = {};
    MeshRegions                  regions    = {};
    /**
     * Whether the cells are rectangles of the chart (u, v), so that their sides
     * are parameter lines. Such a surface names no regions.
     */
    bool has_parameter_lines = false;
    /**
     * Whether the maker knows that no cell is degenerate and that cells meet,
     * where finding out here would be dear.
     */
    bool is_checked = false;
    /** What messages call a cell: "cell 17 of 'roof.msh'"; may be empty. */
    std::vector<std::string> cell_names;
    /** What a run should tell about the surface, a sentence each. */
    std::vector<std::string> notes;
  };

  /**
   * A surface that has passed the checks: a topology of coarse cells, all
   * quadrilaterals or all triangles and all of one orientation, that covers
   * the surface, and the exact position of every point of every coarse cell,
   *   x(K, xi) = map(sum_i N_i(xi) chart_i(K)),
   * N_i linear or quadratic (CoarseCell), xi in the reference cell: [0, 1]^2
   * or the triangle (0,0), (1,0), (0,1).
   */
  class ParametricSurface
  {
  public:
    /** A boundary line of the coarse mesh: its end vertices and its edge. */
    struct BoundaryLine
    {
      std::array<unsigned int, 2> vertices;
      /** Index into edges(). */
      unsigned int edge;
    };

    /**
     * Orders the cells consistently, finds the boundary and checks the
     * surface.
     *
     * @param description the surface
     * @param where the parameter (sub)section of the surface, for messages
     *
     * Throws an ExcMessage that names the chart point where a position isn't
     * finite, where the area Jacobian is zero, and where the joined sides of
     * a closed surface don't meet.
     */
    ParametricSurface(SurfaceDescription &&description,
                      const std::string   &where);

    /** Position (length) of @p unit in the coarse cell's reference cell. */
    Point<3>
    position(const unsigned int coarse_cell, const Point<2> &unit) const;

    /** The chart of @p unit in the reference cell of the coarse cell. */
    Point<3>
    chart(const unsigned int coarse_cell, const Point<2> &unit) const;

    /** SurfaceDescription::has_parameter_lines */
    bool
    has_parameter_lines() const
    {
      return description_.has_parameter_lines;
    }

    /** Whether the cells are triangles. */
    bool
    has_triangles() const;

    /** Exact positions of the coarse vertices. */
    std::vector<Point<3>>
    vertices() const;

    const std::vector<SurfaceDescription::Cell> &
    cells() const;

    const std::vector<SurfaceDescription::Edge> &
    edges() const;

    const std::vector<BoundaryLine> &
    boundary_lines() const;

    const EdgeNames &
    edge_names() const;

    /** The index of a region is SurfaceDescription::Cell::region. */
    const MeshRegions &
    regions() const;

    const std::vector<std::string> &
    notes() const;

  private:
    /** A line of a coarse cell as seen from that cell. */
    struct CellLine
    {
      unsigned int cell;
      /** Local vertices at the ends; their vertex indices ascend. */
      std::array<unsigned int, 2> corners;
      /** +1 if the cell lies to the left when one walks along the line. */
      int side;
    };

    void
    order_cells();

    void
    find_lines();

    /** Cells whose sides are other parameter lines make another region. */
    void
    find_parameter_lines();

    unsigned int
    edge_of(const CellLine &line) const;

    void
    check_not_degenerate(const std::string &where) const;

    /** x,u and x,v at a point of a coarse cell. */
    std::array<Tensor<1, 3>, 2>
    tangents(const unsigned int coarse_cell, const Point<2> &unit) const;

    void
    check_lines_meet(const std::string &where) const;

    std::string
    describe(const unsigned int coarse_cell, const Point<2> &unit) const;

    /** The point of the cell's reference cell at @p t of the line. */
    Point<2>
    unit_point(const CellLine &line, const double t) const;

    Point<3>
    line_point(const CellLine &line, const double t) const;

    SurfaceDescription                         description_;
    std::vector<std::pair<CellLine, CellLine>> interior_lines_;
    std::vector<BoundaryLine>                  boundary_lines_;
  };
} // namespace Nacre

#endif
