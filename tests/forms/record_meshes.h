// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_tests_record_meshes_h
#define nacre_tests_record_meshes_h

// Meshes of the nodes of conformance/*.json: S8, Q9 and T6.

#include "records.h"

#include <deal.II/distributed/shared_tria.h>

#include <map>

/** What the type of a record says. */
struct RecordType
{
  explicit RecordType(const std::string &name)
  {
    if (name == "S8")
      element.type = ElementType::serendipity;
    else if (name == "T6")
      {
        element.type = ElementType::triangle;
        scale        = 1.;
        nodes   = {{0., 0.}, {1., 0.}, {0., 1.}, {.5, 0.}, {.5, .5}, {0., .5}};
        corners = {0, 1, 2};
      }
    else
      AssertThrow(name == "Q9", ExcMessage("No such element: " + name));
  }

  explicit RecordType(const Json &record)
    : RecordType(record.get<std::string>("type"))
  {}

  /** Ours of the record's point. */
  Point<2>
  unit_point(const Point<2> &xi) const
  {
    return element.type == ElementType::triangle ?
             xi :
             Point<2>(.5 * (xi[0] + 1.), .5 * (xi[1] + 1.));
  }

  /** The record's number of the node at a unit point. */
  unsigned int
  node(const Point<2> &unit) const
  {
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (unit.distance(unit_point(nodes[k])) < 1e-12)
        return k;
    AssertThrow(false, ExcInternalError());
    return 0;
  }

  Element element = {ElementType::lagrange, 2};
  /** Derivatives along the record's coordinates by those along ours. */
  double scale = .5;
  /** Corners, mid-sides, centre; 8-node cells lack the last. */
  std::vector<Point<2>> nodes = {{-1., -1.},
                                 {1., -1.},
                                 {1., 1.},
                                 {-1., 1.},
                                 {0., -1.},
                                 {1., 0.},
                                 {0., 1.},
                                 {-1., 0.},
                                 {0., 0.}};
  /** The nodes at the vertices of deal.II's cell. */
  std::vector<unsigned int> corners = {0, 1, 3, 2};
};

/** Quadrilaterals on p4est, triangles as nacre does on a shared mesh. */
inline std::unique_ptr<parallel::TriangulationBase<2, 3>>
make_triangulation(const RecordType               &type,
                   const std::vector<Point<3>>    &vertices,
                   const std::vector<CellData<2>> &cells)
{
  std::unique_ptr<parallel::TriangulationBase<2, 3>> triangulation;
  if (type.element.type == ElementType::triangle)
    triangulation =
      std::make_unique<parallel::shared::Triangulation<2, 3>>(MPI_COMM_WORLD);
  else
    triangulation =
      std::make_unique<parallel::distributed::Triangulation<2, 3>>(
        MPI_COMM_WORLD);
  triangulation->create_triangulation(vertices, cells, SubCellData());
  return triangulation;
}

/** A mesh of the record's nodes with the nodes of each of its cells. */
inline std::unique_ptr<Discretization>
make_discretization(const RecordType                             &type,
                    const std::vector<double>                    &nodes,
                    const std::vector<std::vector<unsigned int>> &cells)
{
  const auto node = [&](const unsigned int k) {
    return Point<3>(nodes[3 * k], nodes[3 * k + 1], nodes[3 * k + 2]);
  };
  std::vector<Point<3>>                vertices;
  std::vector<CellData<2>>             cell_data;
  std::map<unsigned int, unsigned int> vertex_of_node;
  for (const auto &cell : cells)
    {
      cell_data.emplace_back(type.corners.size());
      for (unsigned int v = 0; v < type.corners.size(); ++v)
        {
          const unsigned int k = cell[type.corners[v]];
          if (vertex_of_node.emplace(k, vertices.size()).second)
            vertices.push_back(node(k));
          cell_data.back().vertices[v] = vertex_of_node[k];
        }
    }
  return std::make_unique<Discretization>(
    make_triangulation(type, vertices, cell_data),
    [&](const auto &cell, const Point<2> &unit) {
      return node(cells[cell->index()][type.node(unit)]);
    },
    type.element,
    0);
}

/** Local dof of the record's dof 3 k + c, k counted within the cell. */
inline std::vector<unsigned int>
record_dofs(const RecordType &type, const Discretization &discretization)
{
  const auto               &fe = discretization.scalar_fe();
  std::vector<unsigned int> dofs(3 * fe.n_dofs_per_cell());
  for (unsigned int a = 0; a < fe.n_dofs_per_cell(); ++a)
    for (unsigned int c = 0; c < 3; ++c)
      dofs[3 * type.node(fe.unit_support_point(a)) + c] =
        discretization.node_dofs()[3 * a + c];
  return dofs;
}

#endif
