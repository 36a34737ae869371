// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Surfaces of mesh files: cells turned and turned over at random give the same
// surface, edges and regions; middles of sides, projection, triangles.

#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_file.h>
#include <nacre/problem/midsurface.h>
#include <nacre/problem/surfaces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/tria_base.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <sstream>

using namespace Nacre;

namespace
{
  constexpr unsigned int n_u = 3, n_v = 2;
  const std::string      file_name = "mesh_files.msh";

  unsigned int n_failures = 0;

  bool
  is_root()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  void
  report(const bool good, const std::string &text)
  {
    n_failures += good ? 0 : 1;
    if (is_root())
      std::cout << (good ? "OK   " : "FAIL ") << text << std::endl;
  }

  void
  check_below(const std::string &name, const double value, const double limit)
  {
    std::ostringstream text;
    text << name;
    if (!(value < limit) || std::getenv("NACRE_TEST_VALUES") != nullptr)
      text << ": " << value;
    text << " (< " << limit << ')';
    report(value < limit, text.str());
  }

  Point<3>
  bend(const double u, const double v)
  {
    return {u + 0.1 * v * v, v - 0.2 * std::sin(u), 0.3 * u * u - 0.2 * u * v};
  }

  Point<3>
  on_cylinder(const double u, const double v)
  {
    return {2. * std::cos(0.5 * u), 2. * std::sin(0.5 * u), v};
  }

  using Map = Point<3> (*)(double, double);

  /** Counterclockwise nodes of the grid of half cells, from (0, 0) on. */
  std::vector<std::vector<std::array<unsigned int, 2>>>
  cells_of(const unsigned int n_nodes)
  {
    using Nodes       = std::vector<std::array<unsigned int, 2>>;
    const Nodes quad  = {{{0, 0}},
                         {{2, 0}},
                         {{2, 2}},
                         {{0, 2}},
                         {{1, 0}},
                         {{2, 1}},
                         {{1, 2}},
                         {{0, 1}},
                         {{1, 1}}};
    const Nodes lower = {quad[0], quad[1], quad[2], quad[4], quad[5], quad[8]};
    const Nodes upper = {quad[0], quad[2], quad[3], quad[8], quad[6], quad[7]};
    std::vector<Nodes> of_cell = {quad};
    if (n_nodes == 3 || n_nodes == 6)
      of_cell = {lower, upper};
    for (Nodes &nodes : of_cell)
      nodes.resize(n_nodes);
    return of_cell;
  }

  /** Begin with another corner, and go the other way round. */
  template <typename Node>
  void
  shuffle(std::vector<Node> &nodes, const unsigned int start, const bool over)
  {
    const bool triangle = nodes.size() % 3 == 0 && nodes.size() != 9;
    const int  n        = triangle ? 3 : 4;
    const auto old      = nodes;
    for (int i = 0; i < n; ++i)
      {
        const int corner = (over ? start + n - i : start + i) % n;
        nodes[i]         = old[corner];
        if (static_cast<int>(nodes.size()) > n)
          nodes[n + i] = old[n + (over ? (corner + n - 1) % n : corner)];
      }
  }

  /** A gmsh file of the surface; @p turn_over: how many cells in ten. */
  std::string
  make_file(const Map map, const unsigned int n_nodes, const int turn_over)
  {
    std::mt19937       random(7);
    std::ostringstream nodes, elements;
    nodes.precision(17);
    std::map<std::array<unsigned int, 2>, unsigned int> numbers;
    unsigned int                                        n_elements = 0;
    const auto number = [&](const unsigned int i, const unsigned int j) {
      const auto [entry, is_new] =
        numbers.emplace(std::array<unsigned int, 2>{{i, j}},
                        10 + 3 * numbers.size());
      if (is_new)
        nodes << entry->second << ' ' << map(0.5 * i, 0.5 * j) << '\n';
      return entry->second;
    };
    static const std::map<unsigned int, unsigned int> types = {{3, 2},
                                                               {6, 9},
                                                               {4, 3},
                                                               {8, 16},
                                                               {9, 10}};
    for (unsigned int j = 0; j < n_v; ++j)
      for (unsigned int i = 0; i < n_u; ++i)
        for (auto cell : cells_of(n_nodes))
          {
            shuffle(cell,
                    random() % 4,
                    static_cast<int>(random() % 10) < turn_over);
            elements << ++n_elements << ' ' << types.at(n_nodes) << " 2 "
                     << (i == 0 ? 5 : 6) << " 1";
            for (const auto &[a, b] : cell)
              elements << ' ' << number(2 * i + a, 2 * j + b);
            elements << '\n';
          }
    // One side has a name, one a number, with lines given backward.
    const bool quadratic = n_nodes > 4;
    for (const unsigned int i : {0u, n_u})
      for (unsigned int j = 0; j < n_v; ++j)
        {
          elements << ++n_elements << ' ' << (quadratic ? 8 : 1) << " 2 "
                   << (i == 0 ? 3 : 4) << " 1 " << number(2 * i, 2 * j + 2)
                   << ' ' << number(2 * i, 2 * j);
          if (quadratic)
            elements << ' ' << number(2 * i, 2 * j + 1);
          elements << '\n';
        }
    std::ostringstream out;
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n"
        << "1 3 \"the left\"\n2 5 \"first\"\n2 6 \"rest\"\n$EndPhysicalNames\n"
        << "$Nodes\n"
        << numbers.size() << '\n'
        << nodes.str() << "$EndNodes\n$Elements\n"
        << n_elements << '\n'
        << elements.str() << "$EndElements\n";
    return out.str();
  }

  SurfaceInput::Values
  values(const std::string &curvature)
  {
    return {{"file",
             {{"File name", file_name},
              {"Curvature", curvature},
              {"Merge distance", "0"},
              {"Slits", "refused"}}},
            {"cylinder",
             {{"Radius", "2"},
              {"Axis", "z"},
              {"Angle range", "-10, 100"},
              {"Axial range", "0, 2"}}}};
  }

  void
  write(const std::string &content)
  {
    if (is_root())
      std::ofstream(file_name) << content;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  ParametricSurface
  make_surface(const std::string &content, const std::string &curvature)
  {
    write(content);
    const SurfaceInput input("Mid-surface",
                             "file",
                             values(curvature),
                             {"4", {{"s", "s"}}},
                             {},
                             {MPI_COMM_WORLD, "."});
    return {make_file_surface(input), input.where()};
  }

  double
  area(const ParametricSurface &surface, const unsigned int region)
  {
    const Quadrature<2> quadrature = surface.has_triangles() ?
                                       Quadrature<2>(QGaussSimplex<2>(4)) :
                                       Quadrature<2>(QGauss<2>(6));
    double              sum        = 0.;
    for (const auto &cell : surface.cells())
      if (cell.region == region)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const auto t =
              CoarseCell::tangents(cell.chart, quadrature.point(q));
            sum += quadrature.weight(q) * cross_product_3d(t[0], t[1]).norm();
          }
    return sum;
  }

  /** Lengths of the boundary's chords by the names of edges. */
  std::map<std::string, double>
  chords(const ParametricSurface &surface)
  {
    std::map<std::string, double> sums;
    const auto                    x = surface.vertices();
    for (const auto &line : surface.boundary_lines())
      sums[surface.edges()[line.edge].name] +=
        x[line.vertices[0]].distance(x[line.vertices[1]]);
    return sums;
  }

  void
  test_turned_cells(const unsigned int n_nodes)
  {
    const std::string name = std::to_string(n_nodes) + " nodes: ";
    const auto        good = make_surface(make_file(bend, n_nodes, 0), "file");
    const auto turned      = make_surface(make_file(bend, n_nodes, 4), "file");
    report(good.has_triangles() == (n_nodes % 3 == 0 && n_nodes != 9),
           name + "shape");
    bool regions = true;
    for (const auto *const surface : {&good, &turned})
      {
        const auto &found = surface->regions().regions;
        regions = regions && found.size() == 3 && found[0].names.empty() &&
                  found[1].names == std::vector<std::string>{"first"} &&
                  found[2].names == std::vector<std::string>{"rest"};
      }
    report(regions, name + "regions");
    for (const unsigned int region : {1u, 2u})
      check_below(name + "area of region " + std::to_string(region),
                  std::abs(area(turned, region) / area(good, region) - 1.),
                  1e-5);
    const auto   lengths = chords(good);
    double       left    = 0.;
    const double h       = 1.;
    for (unsigned int j = 0; j < n_v; ++j)
      left += bend(0., j * h).distance(bend(0., (j + 1) * h));
    report(lengths.size() == 3 && lengths.count("the left") == 1 &&
             lengths.count("4") == 1 && lengths.count("boundary") == 1,
           name + "edges");
    check_below(name + "left edge",
                std::abs(lengths.at("the left") - left),
                1e-14);
    double difference = 0.;
    for (const auto &[edge, length] : chords(turned))
      difference = std::max(difference, std::abs(lengths.at(edge) - length));
    check_below(name + "edges of the turned one", difference, 1e-14);

    // One orientation, that of most of the cells.
    bool upward = true;
    for (unsigned int k = 0; k < turned.cells().size(); ++k)
      {
        const auto t =
          CoarseCell::tangents(turned.cells()[k].chart, Point<2>(0.3, 0.3));
        upward = upward && cross_product_3d(t[0], t[1])[2] > 0.;
      }
    report(upward, name + "orientation");
  }

  /** The nodes that were given lie on the surface of the cells. */
  void
  test_middles(const unsigned int n_nodes)
  {
    const auto surface = make_surface(make_file(bend, n_nodes, 4), "file");
    const bool tri     = surface.has_triangles();
    double     largest = 0.;
    std::vector<Point<2>> units = {{0.5, 0.}, {0., 0.5}, {0.5, 0.5}};
    if (!tri)
      units = {{0.5, 0.}, {0., 0.5}, {0.5, 1.}, {1., 0.5}};
    for (unsigned int k = 0; k < surface.cells().size(); ++k)
      for (const auto &unit : units)
        {
          double smallest = 1.;
          for (unsigned int i = 0; i <= 2 * n_u; ++i)
            for (unsigned int j = 0; j <= 2 * n_v; ++j)
              smallest = std::min(smallest,
                                  surface.position(k, unit).distance(
                                    bend(0.5 * i, 0.5 * j)));
          largest = std::max(largest, smallest);
        }
    check_below(std::to_string(n_nodes) + " nodes: middles", largest, 1e-14);
  }

  void
  test_curvature(const unsigned int n_nodes)
  {
    const std::string name     = std::to_string(n_nodes) + " nodes, ";
    const auto        content  = make_file(on_cylinder, n_nodes, 4);
    const auto        distance = [](const ParametricSurface &surface) {
      double largest = 0.;
      for (unsigned int k = 0; k < surface.cells().size(); ++k)
        for (const auto &unit : {Point<2>(0.2, 0.1),
                                 Point<2>(0.5, 0.5),
                                 Point<2>(0., 0.7),
                                 Point<2>(1., 0.)})
          {
            const Point<3> x = surface.position(k, unit);
            largest = std::max(largest, std::abs(std::hypot(x[0], x[1]) - 2.));
          }
      return largest;
    };
    check_below(name + "on the cylinder",
                distance(make_surface(content, "cylinder")),
                1e-14);
    const double flat = distance(make_surface(content, "flat"));
    report(std::abs(flat - 2. * (1. - std::cos(0.25))) < 2e-3 * 2.,
           name + "flat: sagitta");
    const double file = distance(make_surface(content, "file"));
    report(n_nodes > 4 ? file < 1e-3 : std::abs(file - flat) < 1e-12,
           name + "as the file says");

    // The nearest point lies straight outward.
    const auto curved = make_surface(content, "cylinder");
    const auto as_is  = make_surface(content, "file");
    double     aside  = 0.;
    for (unsigned int k = 0; k < curved.cells().size(); ++k)
      {
        const Point<3> x = as_is.position(k, Point<2>(0.2, 0.3));
        const double   r = std::hypot(x[0], x[1]);
        aside            = std::max(aside,
                         curved.position(k, Point<2>(0.2, 0.3))
                           .distance({2. * x[0] / r, 2. * x[1] / r, x[2]}));
      }
    check_below(name + "nearest", aside, 1e-11);
  }

  using Cell = Triangulation<2, 3>::active_cell_iterator;

  /** The point of a cell at @p t from the vertex @p begin of a side on. */
  Point<2>
  point_of_side(const Cell        &cell,
                const unsigned int side,
                const unsigned int begin,
                const double       t)
  {
    const auto type = cell->reference_cell();
    Point<2>   unit;
    for (const unsigned int end : {0, 1})
      {
        const unsigned int v = type.face_to_cell_vertices(side, end, 1);
        unit += (cell->vertex_index(v) == begin ? 1. - t : t) *
                Tensor<1, 2>(type.vertex<2>(v));
      }
    return unit;
  }

  /** Between the positions that a cell and its neighbour give. */
  double
  distance_at(const Midsurface  &surface,
              const Cell        &cell,
              const unsigned int side,
              const double       t)
  {
    const unsigned int begin      = cell->face(side)->vertex_index(0);
    const Cell         other      = cell->neighbor(side);
    const unsigned int other_side = cell->neighbor_of_neighbor(side);
    return surface.position(cell, point_of_side(cell, side, begin, t))
      .distance(
        surface.position(other, point_of_side(other, other_side, begin, t)));
  }

  /** The mesh of deal.II, on any number of ranks. */
  void
  test_triangulation(const unsigned int n_nodes)
  {
    write(make_file(bend, n_nodes, 4));
    ParameterAcceptor::clear();
    MidsurfaceParameters parameters;
    ParameterAcceptor::declare_all_parameters();
    ParameterAcceptor::prm.parse_input_from_string(
      "subsection Mid-surface\nset Surface = file\nsubsection file\n"
      "set File name = " +
      file_name + "\nend\nend\n");
    ParameterAcceptor::parse_all_parameters();
    parameters.set_files(MPI_COMM_WORLD, "no such folder");
    const Midsurface surface = parameters.make({});

    const bool triangles = surface.has_triangles();
    const auto mesh =
      surface.create_triangulation(MPI_COMM_WORLD,
                                   triangles ? ReferenceCells::Triangle :
                                               ReferenceCells::Quadrilateral,
                                   2);
    double                    mismatch = 0.;
    std::vector<double>       edges(surface.edge_names().size(), 0.);
    std::vector<unsigned int> n_cells(surface.regions().regions.size(), 0);
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          ++n_cells.at(cell->material_id());
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f))
              edges.at(cell->face(f)->boundary_id()) +=
                cell->face(f)->vertex(0).distance(cell->face(f)->vertex(1));
            else
              for (const double t : {0., 0.3, 0.5, 1.})
                mismatch = std::max(mismatch, distance_at(surface, cell, f, t));
        }
    const std::string name = std::to_string(n_nodes) + " nodes refined: ";
    check_below(name + "sides meet",
                Utilities::MPI::max(mismatch, MPI_COMM_WORLD),
                1e-14);
    const unsigned int n_column = (triangles ? 32 : 16) * n_v;
    report(Utilities::MPI::sum(n_cells[1], MPI_COMM_WORLD) == n_column &&
             Utilities::MPI::sum(n_cells[2], MPI_COMM_WORLD) ==
               n_column * (n_u - 1),
           name + "regions");
    std::ostringstream text;
    text.precision(6);
    text << name << "edges";
    for (unsigned int e = 0; e < edges.size(); ++e)
      text << ' ' << surface.edge_names()[e] << " = "
           << Utilities::MPI::sum(edges[e], MPI_COMM_WORLD);
    report(true, text.str());
  }
} // namespace


int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int n_nodes : {3, 4, 6, 8, 9})
    test_turned_cells(n_nodes);
  for (const unsigned int n_nodes : {6, 8, 9})
    test_middles(n_nodes);
  for (const unsigned int n_nodes : {3, 4, 6, 8, 9})
    test_curvature(n_nodes);
  for (const unsigned int n_nodes : {3, 4, 6, 8, 9})
    test_triangulation(n_nodes);
  return n_failures == 0 ? 0 : 1;
}
