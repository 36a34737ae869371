// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The co-rotational records of conformance/corotational.json, written by an
// independent program: rotations, strains, energies and forces of cells and
// edges after a finite rotation and a deformation of order one.

#include "records.h"
#include <nacre/forms/corotational_kinematics.h>

#include <deal.II/distributed/shared_tria.h>

/** The mesh of a record: nodes, the nodes of each cell and their places. */
struct RecordMesh
{
  explicit RecordMesh(const Json &record)
    : type(record.get<std::string>("type"))
    , is_triangle(type == "T6")
    , nodes(points_of(record, "nodes"))
    , cells(cells_of(record))
    , discretization(make())
  {}

  static std::vector<Point<3>>
  points_of(const Json &record, const std::string &key)
  {
    const auto            numbers = numbers_of(record, key);
    std::vector<Point<3>> points;
    for (unsigned int k = 0; k < numbers.size(); k += 3)
      points.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    return points;
  }

  std::vector<std::vector<unsigned int>>
  cells_of(const Json &record) const
  {
    std::vector<std::vector<unsigned int>> result;
    if (record.count("conn") == 0)
      {
        result.emplace_back();
        for (unsigned int k = 0; k < nodes.size(); ++k)
          result.back().push_back(k);
        return result;
      }
    for (const auto &cell : record.get_child("conn"))
      {
        result.emplace_back();
        for (const double k : numbers_of(cell.second))
          result.back().push_back(static_cast<unsigned int>(k));
      }
    return result;
  }

  /** The record's number, within the cell, of the node at @p unit. */
  unsigned int
  node_at(const Point<2> &unit) const
  {
    const std::vector<Point<2>> places = is_triangle ?
                                           std::vector<Point<2>>{{0., 0.},
                                                                 {1., 0.},
                                                                 {0., 1.},
                                                                 {.5, 0.},
                                                                 {.5, .5},
                                                                 {0., .5}} :
                                           std::vector<Point<2>>{{0., 0.},
                                                                 {1., 0.},
                                                                 {1., 1.},
                                                                 {0., 1.},
                                                                 {.5, 0.},
                                                                 {1., .5},
                                                                 {.5, 1.},
                                                                 {0., .5},
                                                                 {.5, .5}};
    for (unsigned int k = 0; k < places.size(); ++k)
      if ((unit - places[k]).norm() < 1e-12)
        return k;
    AssertThrow(false, ExcInternalError());
    return 0;
  }

  std::unique_ptr<Discretization>
  make() const
  {
    std::vector<Point<3>>                vertices;
    std::vector<CellData<2>>             corners;
    std::map<unsigned int, unsigned int> found;
    for (const auto &cell : cells)
      {
        // deal.II counts the corners of quadrilaterals lexicographically.
        const std::vector<unsigned int> order =
          is_triangle ? std::vector<unsigned int>{0, 1, 2} :
                        std::vector<unsigned int>{0, 1, 3, 2};
        CellData<2> data(order.size());
        for (unsigned int v = 0; v < order.size(); ++v)
          {
            const unsigned int k = cell[order[v]];
            if (found.emplace(k, vertices.size()).second)
              vertices.push_back(nodes[k]);
            data.vertices[v] = found[k];
          }
        corners.push_back(data);
      }
    std::unique_ptr<parallel::TriangulationBase<2, 3>> triangulation;
    if (is_triangle)
      triangulation =
        std::make_unique<parallel::shared::Triangulation<2, 3>>(MPI_COMM_WORLD);
    else
      triangulation =
        std::make_unique<parallel::distributed::Triangulation<2, 3>>(
          MPI_COMM_WORLD);
    triangulation->create_triangulation(vertices, corners, SubCellData());
    const Element element{type == "Q9" ? ElementType::lagrange :
                          type == "S8" ? ElementType::serendipity :
                                         ElementType::triangle,
                          2};
    return std::make_unique<Discretization>(
      std::move(triangulation),
      [this](const auto &cell, const Point<2> &unit) {
        return nodes[cells[cell->index()][node_at(unit)]];
      },
      element,
      0);
  }

  /** The record's node of each node of the cell. */
  std::vector<unsigned int>
  cell_nodes(const unsigned int cell) const
  {
    const auto               &fe = discretization->scalar_fe();
    std::vector<unsigned int> result(fe.n_dofs_per_cell());
    for (unsigned int a = 0; a < result.size(); ++a)
      result[a] = cells[cell][node_at(fe.unit_support_point(a))];
    return result;
  }

  ShellEdgeValues::cell_iterator
  cell(const unsigned int index) const
  {
    for (const auto &cell :
         discretization->dof_handler().active_cell_iterators())
      if (static_cast<unsigned int>(cell->index()) == index)
        return cell;
    AssertThrow(false, ExcInternalError());
    return discretization->dof_handler().begin_active();
  }

  /** Strains of our reference cell relative to the record's. */
  double
  strain_factor() const
  {
    return is_triangle ? 1. : 0.25;
  }

  const std::string                            type;
  const bool                                   is_triangle;
  const std::vector<Point<3>>                  nodes;
  const std::vector<std::vector<unsigned int>> cells;
  const std::unique_ptr<Discretization>        discretization;
};

/** Displacements of the record's nodes. */
NodeVectors<double>
displacements(const RecordMesh &mesh)
{
  NodeVectors<double> u;
  const Vector3       w{{0.7, -1.1, 0.9}};
  const double        angle = w.norm();
  const Vector3       k     = w / angle;
  for (const auto &X : mesh.nodes)
    {
      const Vector3 X0(X);
      const Vector3 rotated = std::cos(angle) * X0 +
                              std::sin(angle) * cross_product_3d(k, X0) +
                              (1. - std::cos(angle)) * (k * X0) * k;
      Vector3 x = rotated + Vector3{{0.5, -0.2, 1.0}};
      x += 0.15 *
           Vector3{{std::sin(X[1]), X[0] * X[1], std::cos(X[0]) - X[2] * X[1]}};
      u.push_back(x - X0);
    }
  return u;
}

MembraneStrain
membrane_strain(const std::string &type, const unsigned int n_quad)
{
  // Two points a direction, or three on a triangle.
  const bool reduced = type == "S8" ? n_quad == 2 : type == "T6" && n_quad == 3;
  return reduced ? MembraneStrain::reduced : MembraneStrain::full;
}

void
add_numbers(const Tensor<2, 3> &R, std::vector<double> &numbers)
{
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int d = 0; d < 3; ++d)
      numbers.push_back(R[c][d]);
}

/** Rotations and strains at the record's points. */
void
test_points(const std::string         &name,
            const Json                &record,
            const RecordMesh          &mesh,
            const NodeVectors<double> &u)
{
  const auto            xi = numbers_of(record, "points");
  std::vector<Point<2>> points;
  for (unsigned int k = 0; k < xi.size(); k += 2)
    points.push_back(mesh.is_triangle ?
                       Point<2>(xi[k], xi[k + 1]) :
                       Point<2>(0.5 * (xi[k] + 1.), 0.5 * (xi[k + 1] + 1.)));
  ShellCellValues values(*mesh.discretization, Quadrature<2>(points), false);
  values.reinit_frames(mesh.discretization->dof_handler().begin_active());
  NodeVectors<double> u_cell;
  for (const unsigned int k : mesh.cell_nodes(0))
    u_cell.push_back(u[k]);
  CorotationalMembrane<double> membrane;
  CorotationalBending<double>  bending;
  const auto                   n = points.size();
  membrane.reinit(values, FullMatrix<double>(3 * n), u_cell);
  bending.reinit(values, std::vector<VoigtMatrix<>>(n), u_cell);

  std::vector<double> rotations, strains;
  for (unsigned int q = 0; q < n; ++q)
    {
      const auto &frame = values.frame(q);
      const auto &q_cov = membrane.polar(q).q_cov;
      add_numbers(outer_product(q_cov[0], frame.a_con[0]) +
                    outer_product(q_cov[1], frame.a_con[1]) +
                    outer_product(bending.deformed(q).t0, frame.t0),
                  rotations);
      for (unsigned int v = 0; v < 3; ++v)
        strains.push_back(mesh.strain_factor() *
                          membrane.tied_strain(values.tying(), q)[v]);
      for (unsigned int v = 0; v < 3; ++v)
        strains.push_back(mesh.strain_factor() * bending.strain(q)[v]);
    }
  compare(name + ": R",
          rotations,
          numbers_of(record, "R_per_quadrature_point"));
  compare(name + ": strains",
          strains,
          numbers_of(record,
                     "strain_voigt_per_quadrature_point_membrane3_bending3"));
}

/** Terms of a cell, their forces added to the record's nodes. */
Energies
add_cell_forces(const RecordMesh          &mesh,
                const unsigned int         index,
                CorotationalKinematics    &kinematics,
                const NodeVectors<double> &u,
                std::vector<double>       &force)
{
  const auto    &node_dofs = mesh.discretization->node_dofs();
  const auto     nodes     = mesh.cell_nodes(index);
  Vector<double> local(node_dofs.size());
  for (unsigned int a = 0; a < nodes.size(); ++a)
    for (unsigned int c = 0; c < 3; ++c)
      local[node_dofs[3 * a + c]] = u[nodes[a]][c];
  LocalTerms terms;
  terms.wants_tangent = false;
  terms.reinit(local.size());
  kinematics.add_cell_terms(mesh.cell(index), local, terms);
  for (unsigned int a = 0; a < nodes.size(); ++a)
    for (unsigned int c = 0; c < 3; ++c)
      force[3 * nodes[a] + c] += terms.residual[node_dofs[3 * a + c]];
  return terms.energies;
}

Parameters
parameters_of(const Json &record)
{
  return Parameters(section_text(record.get<double>("E"),
                                 record.get<double>("nu"),
                                 record.get<double>("h")));
}

void
test_element(const Json &record)
{
  const auto       name       = record.get<std::string>("name");
  const auto       parameters = parameters_of(record);
  const auto      &corot      = record.get_child("corot");
  const RecordMesh mesh(record);
  const auto       u = displacements(mesh);

  CorotationalKinematics kinematics(
    *mesh.discretization,
    parameters.section,
    membrane_strain(mesh.type, record.get<unsigned int>("n_quad")),
    TangentType::consistent);
  std::vector<double> force(3 * u.size());
  const auto          energies = add_cell_forces(mesh, 0, kinematics, u, force);
  compare(name + ": f_int", force, numbers_of(corot, "f_int"));
  compare(name + ": energy", {energies.total()}, numbers_of(corot, "energy"));
  Json points = corot;
  points.put_child("points", record.get_child("points"));
  test_points(name, points, mesh, u);
}

/** The edge of a record and the displacements of its nodes. */
struct RecordEdge
{
  RecordEdge(const Json &record, const RecordMesh &mesh)
    : edge(*mesh.discretization)
    , dofs(3 * mesh.nodes.size(), numbers::invalid_unsigned_int)
  {
    const auto   minus = mesh.cell(record.get<unsigned int>("K_minus"));
    const auto   plus  = mesh.cell(record.get<unsigned int>("K_plus"));
    const auto   whole = numbers::invalid_unsigned_int;
    unsigned int face  = 0;
    while (minus->at_boundary(face))
      ++face;
    edge.reinit(minus,
                face,
                whole,
                plus,
                minus->neighbor_of_neighbor(face),
                whole);

    const auto all_u = displacements(mesh);
    u.reinit(edge.n_dofs());
    for (unsigned int s = 0; s < 2; ++s)
      {
        const auto nodes = mesh.cell_nodes((s == 0 ? minus : plus)->index());
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            u_sides[s].push_back(all_u[nodes[a]]);
            for (unsigned int c = 0; c < 3; ++c)
              {
                dofs[3 * nodes[a] + c] = edge.dof(s, a, c);
                u[edge.dof(s, a, c)]   = all_u[nodes[a]][c];
              }
          }
      }
  }

  ShellEdgeValues edge;
  /** The edge's dof of the record's dof 3 k + c. */
  std::vector<unsigned int>          dofs;
  Vector<double>                     u;
  std::array<NodeVectors<double>, 2> u_sides;
};

void
test_edge_rotations(const std::string &name,
                    const Json        &record,
                    const RecordEdge  &mesh,
                    const SectionLaw  &section)
{
  std::vector<std::vector<double>> rotations;
  CorotationalEdgePoint<double>    point;
  for (unsigned int q = 0; q < mesh.edge.n_points(); ++q)
    {
      point.reinit(mesh.edge, q, section, 1., 0., mesh.u_sides);
      Tensor<2, 3> R;
      for (unsigned int d = 0; d < 3; ++d)
        {
          Vector3 unit;
          unit[d]           = 1.;
          const auto column = point.rotate(unit);
          for (unsigned int c = 0; c < 3; ++c)
            R[c][d] = column[c];
        }
      rotations.emplace_back();
      add_numbers(R, rotations.back());
    }
  // The record's points run with the neighbour's edge.
  const auto expected = numbers_of(record, "corot.R_edge_points");
  if (std::abs(rotations.back()[0] - expected[0]) <
      std::abs(rotations.front()[0] - expected[0]))
    std::reverse(rotations.begin(), rotations.end());
  std::vector<double> all;
  for (const auto &R : rotations)
    all.insert(all.end(), R.begin(), R.end());
  compare(name + ": R_edge_points", all, expected);
}

/**
 * The records' edge form is the report's, equal to the rotation-jump form
 * only where both cells have the same tangent plane: elsewhere, all @p creased
 * records (one mesh, its cells numbered and oriented in different ways) must
 * have one force.
 */
void
test_edge(const Json &record, std::vector<double> &creased)
{
  const auto             name       = record.get<std::string>("name");
  const auto             parameters = parameters_of(record);
  const RecordMesh       mesh(record);
  const RecordEdge       edge(record, mesh);
  CorotationalKinematics kinematics(
    *mesh.discretization,
    parameters.section,
    membrane_strain(mesh.type, record.get<unsigned int>("element_quad_n")),
    TangentType::consistent);

  std::vector<double> cell_force(edge.dofs.size()), edge_force;
  for (unsigned int k = 0; k < 2; ++k)
    add_cell_forces(mesh, k, kinematics, displacements(mesh), cell_force);
  compare(name + ": f_int_elements",
          cell_force,
          numbers_of(record, "corot.f_int_elements"));

  LocalTerms terms;
  terms.reinit(edge.u.size());
  kinematics.add_edge_terms(edge.edge,
                            record.get<double>("eta_e"),
                            edge.u,
                            terms);
  for (const unsigned int i : edge.dofs)
    edge_force.push_back(terms.residual[i]);
  const auto  &frames = edge.edge;
  const double kink =
    (frames.frame(0, 0).t0 - frames.sigma(1, 0) * frames.frame(1, 0).t0).norm();
  if (kink < 1e-10)
    compare(name + ": f_int_edge",
            edge_force,
            numbers_of(record, "corot.f_int_edge"));
  else if (creased.empty())
    creased = edge_force;
  else
    compare(name + ": same edge force", edge_force, creased);
  test_edge_rotations(name, record, edge, parameters.section);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Json                             records;
  boost::property_tree::read_json(SOURCE_DIR "/conformance/corotational.json",
                                  records);
  for (const auto &record : records.get_child("elements"))
    test_element(record.second);
  std::vector<double> creased;
  for (const auto &record : records.get_child("edges"))
    test_edge(record.second, creased);
  return n_failures > 0;
}
