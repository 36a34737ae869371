// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// What the forms must not depend on: which cell of an edge comes first, the
// orientation of a neighbour, a symmetry plane. Residual and energies belong
// to the matrix. The bound of the penalty makes the matrix positive.

#include "../tests_common.h"
#include <nacre/forms/linear_kinematics.h>
#include <nacre/problem/midsurface.h>

using namespace Tests;

const Element quadratic{ElementType::lagrange, 2};
const Element cubic{ElementType::lagrange, 3};

/** 2 x 2 cells with a fold by 1.2 rad along their middle. */
Mesh
creased_mesh()
{
  Mesh mesh;
  for (const double y : {0., 0.9, 2.})
    {
      mesh.vertices.emplace_back(-1. + 0.1 * y, y, 0.);
      mesh.vertices.emplace_back(0., y, 0.);
      mesh.vertices.emplace_back(std::cos(1.2), 1.1 * y, std::sin(1.2));
    }
  mesh.cells = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}, {{3, 4, 6, 7}}, {{4, 5, 7, 8}}};
  mesh.map   = bend;
  return mesh;
}

/** The edges' matrix with either cell first. */
FullMatrix<double>
edge_matrix(const Discretization &discretization,
            const SectionLaw     &section,
            const bool            swapped)
{
  const auto         none = numbers::invalid_unsigned_int;
  const EdgePenalty  penalty(discretization,
                            section,
                            discretization.element().full_quadrature(),
                            {});
  LinearKinematics   kinematics(discretization, section, MembraneStrain::tied);
  ShellEdgeValues    edge(discretization);
  LocalTerms         terms;
  const unsigned int n = discretization.dof_handler().n_dofs();
  FullMatrix<double> matrix(n, n);
  for (const auto &cell : discretization.dof_handler().active_cell_iterators())
    for (const auto face : cell->face_indices())
      {
        if (cell->at_boundary(face) || !cell->neighbor(face)->is_active())
          continue;
        const auto   neighbor      = cell->neighbor(face);
        unsigned int neighbor_face = 0, subface = none;
        if (cell->neighbor_is_coarser(face))
          std::tie(neighbor_face, subface) =
            cell->neighbor_of_coarser_neighbor(face);
        else if (neighbor < cell)
          continue;
        else
          neighbor_face = cell->neighbor_of_neighbor(face);

        if (swapped)
          edge.reinit(neighbor, neighbor_face, subface, cell, face, none);
        else
          edge.reinit(cell, face, none, neighbor, neighbor_face, subface);
        terms.reinit(edge.n_dofs());
        kinematics.add_edge_terms(edge,
                                  penalty.interior(cell, neighbor),
                                  Vector<double>(),
                                  terms);
        for (unsigned int i = 0; i < edge.n_dofs(); ++i)
          for (unsigned int j = 0; j < edge.n_dofs(); ++j)
            matrix(edge.dof_indices()[i], edge.dof_indices()[j]) +=
              terms.tangent(i, j);
      }
  return matrix;
}

void
test_side_swap(const Parameters &parameters)
{
  for (const Element &element : {quadratic, cubic, serendipity, triangle})
    {
      auto mesh = creased_mesh();
      if (element.type != ElementType::triangle)
        mesh.refined = {1};
      const auto discretization = make_discretization(mesh, element);
      check_below("sides swapped, " + label(element),
                  relative_difference(
                    edge_matrix(*discretization, parameters.section, true),
                    edge_matrix(*discretization, parameters.section, false)),
                  1e-12);
    }
}

/** The parts of the energy of a field. */
Energies
energies_of(const Mesh       &mesh,
            const Parameters &parameters,
            const Element    &element)
{
  const auto     discretization = make_discretization(mesh, element);
  const Assembly assembly(*discretization,
                          ShellParts(parameters.section,
                                     parameters.conditions,
                                     parameters.loads,
                                     MembraneStrain::tied,
                                     {}));
  return assembly.energies(interpolate(*discretization, some_field));
}

void
compare(const std::string &name, const Energies &found, const Energies &exact)
{
  check_below(name + ": membrane energy",
              std::abs(found.membrane / exact.membrane - 1.),
              1e-12);
  check_below(name + ": bending energy",
              std::abs(found.bending / exact.bending - 1.),
              1e-12);
  // The penalty's eigenvalue is that of a matrix nearly singular.
  check_below(name + ": edge energy",
              std::abs(found.edge / exact.edge - 1.),
              1e-9);
}

void
test_orientation(const Parameters &parameters, const Element &element)
{
  const auto name  = label(element) + ", ";
  auto       mesh  = creased_mesh();
  const auto exact = energies_of(mesh, parameters, element);
  mesh.cells[1]    = {{1, 4, 2, 5}};
  mesh.cells[3]    = {{4, 7, 5, 8}};
  compare(name + "neighbours reversed",
          energies_of(mesh, parameters, element),
          exact);
  mesh.cells = {{{4, 5, 7, 8}}, {{1, 2, 4, 5}}, {{3, 4, 6, 7}}, {{0, 1, 3, 4}}};
  compare(name + "cells in another order",
          energies_of(mesh, parameters, element),
          exact);
}

/** K u and 1/2 u . K u against residual() and energies(). */
void
test_residual(const Parameters &parameters, const Element &element)
{
  auto mesh = creased_mesh();
  if (element.type != ElementType::triangle)
    mesh.refined = {2};
  const auto discretization = make_discretization(mesh, element);
  for (const auto membrane_strain :
       {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
    {
      const Assembly            assembly(*discretization,
                              ShellParts(parameters.section,
                                         parameters.conditions,
                                         parameters.loads,
                                         membrane_strain,
                                         10.));
      AffineConstraints<double> none;
      none.close();
      const auto [matrix, load] = dense_system(*discretization, assembly, none);
      const auto     u          = interpolate(*discretization, some_field);
      Vector<double> values(u.size()), product(u.size());
      for (unsigned int i = 0; i < u.size(); ++i)
        values[i] = u(i);
      matrix.vmult(product, values);

      TrilinosVector residual(discretization->locally_owned_dofs(),
                              MPI_COMM_WORLD);
      const auto     energies = assembly.residual(u, residual);
      double         error    = 0.;
      for (unsigned int i = 0; i < u.size(); ++i)
        error = std::max(error, std::abs(residual(i) - product[i]));
      const auto name = label(element) + ", " + name_of(membrane_strain);
      check_below(name + ": residual is K u",
                  error / product.linfty_norm(),
                  1e-12);
      check_below(name + ": energy is u . K u / 2",
                  std::abs(0.5 * (product * values) / energies.total() - 1.),
                  1e-12);
      check_below(name + ": no load", load.linfty_norm(), 1e-300);
    }
}

/** The smallest eigenvalue relative to the largest. */
double
smallest_eigenvalue(const Discretization        &discretization,
                    const SectionLaw            &section,
                    const BoundaryConditions    &conditions,
                    const Loads                 &loads,
                    const std::optional<double> &eta)
{
  const auto membrane_strain =
    default_membrane_strain(discretization.element().type);
  const Assembly assembly(
    discretization,
    ShellParts(section, conditions, loads, membrane_strain, eta));
  const auto &constraints = discretization.node_constraints();
  const auto  values =
    eigenvalues(dense_system(discretization, assembly, constraints).first,
                constraints);
  return values[0] / values[values.size() - 1];
}

void
test_coercivity(const Parameters &parameters)
{
  for (const Element &element : {quadratic, cubic, serendipity, triangle})
    for (const bool hanging : {false, true})
      {
        auto mesh = creased_mesh();
        if (hanging && element.type == ElementType::triangle)
          continue;
        if (hanging)
          mesh.refined = {3};
        const auto discretization = make_discretization(mesh, element);
        const auto smallest       = [&](const std::optional<double> &eta) {
          return smallest_eigenvalue(*discretization,
                                     parameters.section,
                                     parameters.conditions,
                                     parameters.loads,
                                     eta);
        };
        const double bound =
          EdgePenalty(*discretization,
                      parameters.section,
                      discretization->element().full_quadrature(),
                      {})
            .bound();
        const auto name =
          label(element) + (hanging ? ", hanging nodes: " : ": ");
        check_above(name + "smallest eigenvalue at the bound",
                    smallest(bound),
                    -1e-13);
        check_above(name + "smallest eigenvalue, own penalty",
                    smallest({}),
                    -1e-13);
        check_below(name + "smallest eigenvalue at eta = 0.01",
                    smallest(0.01),
                    -1e-8);
      }
}

/** The bound on squares at nu = 0 is p (p - 1) / 8. */
void
test_bound()
{
  const Parameters parameters(section_text(100., 0., 0.2));
  Mesh             mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}};
  mesh.cells    = {{{0, 1, 2, 3}}};
  mesh.refined  = {0};
  for (const unsigned int degree : {2, 3, 4, 5})
    {
      const auto   discretization = make_discretization(mesh, degree);
      const double bound =
        EdgePenalty(*discretization,
                    parameters.section,
                    discretization->element().full_quadrature(),
                    {})
          .bound();
      check_below("bound on squares, p = " + std::to_string(degree),
                  std::abs(bound / (degree * (degree - 1.) / 8.) - 1.),
                  1e-6);
    }
}

/** A surface symmetric about x = 0, or its half x > 0. */
struct Panel
{
  explicit Panel(const bool half, const std::string &rotation = "symmetry")
    : parameters(
        "subsection Mid-surface\n set Surface = expression\n"
        " set Subdivisions = " +
        std::string(half ? "1, 2" : "2, 2") +
        "\n subsection expression\n"
        "  set Position = u, v + 0.1*u^2, 0.3*u^2 - 0.2*v^2 + 0.1*u^2*v\n"
        "  set Range u = " +
        (half ? "0" : "-1") +
        ", 1\n  set Range v = 0, 2\n end\nend\n"
        "subsection Boundary conditions\n set Edges = " +
        (half ? "u=0: " + rotation : "u=1: free") + "\nend\n" +
        section_text(100., 0.3, 0.2))
  {}

  Energies
  energies(const VectorField &field, const double eta)
  {
    parameters.model.eta = eta;
    const Discretization discretization(parameters.model.midsurface,
                                        MPI_COMM_WORLD,
                                        Element{ElementType::lagrange, 3},
                                        0,
                                        0);
    const Assembly       assembly(discretization, parameters.model);
    return assembly.energies(interpolate(discretization, field));
  }

  TextModel parameters;
};

void
test_mirror()
{
  // With a kink across the plane x = 0, so that its edge terms count.
  const VectorField field = [](const Point<3> &x) {
    const double s = std::abs(x[0]);
    Vector3      u;
    u[0] = (x[0] < 0. ? -1. : 1.) * (0.3 * s + 0.2 * s * s * x[1]);
    u[1] = std::sin(s + 0.5 * x[1]);
    u[2] = (0.4 + 0.3 * x[1]) * s - 0.2 * x[1] * x[1];
    return u;
  };
  const auto whole = Panel(false).energies(field, 7.);
  auto       half  = Panel(true).energies(field, 7.);
  half += Energies(half);
  compare("symmetry plane", half, whole);
  check_above("symmetry plane: share of the edges",
              whole.edge / whole.total(),
              1e-3);

  // theta = t0 . du/dn at x = 0 is -(0.4 + 0.3 y): prescribed so, no energy
  // is left on the plane.
  const VectorField linear = [](const Point<3> &x) {
    Vector3 u;
    u[2] = (0.4 + 0.3 * x[1]) * x[0];
    return u;
  };
  const auto free  = Panel(true, "free").energies(linear, 7.);
  const auto given = Panel(true, "rotation = -(0.4 + 0.3*y)/sqrt(1 + 0.16*y^2)")
                       .energies(linear, 7.);
  check_below("rotation that the field has: edge energy",
              std::abs(given.edge - free.edge) / given.total(),
              1e-12);
  const auto other = Panel(true, "rotation = 0.4").energies(linear, 7.);
  check_above("rotation that the field has not: edge energy",
              (other.edge - free.edge) / given.total(),
              1e-4);
}

/** The same bound with prescribed rotations on all edges. */
void
test_clamped_coercivity()
{
  const Panel        panel(true);
  const auto        &midsurface = panel.parameters.model.midsurface;
  const auto        &section    = *panel.parameters.model.section;
  BoundaryConditions conditions;
  for (const auto *const edge : {"u=0", "u=1", "v=0", "v=1"})
    conditions.prescribe_rotation(midsurface.edge_ids(edge, "test"));
  const Discretization discretization(midsurface,
                                      MPI_COMM_WORLD,
                                      Element{ElementType::lagrange, 2},
                                      0,
                                      1);
  const auto           smallest = [&](const std::optional<double> &eta) {
    return smallest_eigenvalue(discretization,
                               section,
                               conditions,
                               Loads(),
                               eta);
  };
  const double bound = EdgePenalty(discretization,
                                   section,
                                   discretization.element().full_quadrature(),
                                   {})
                         .bound();
  check_above("rotations fixed: smallest eigenvalue at the bound",
              smallest(bound),
              -1e-13);
  check_below("rotations fixed: smallest eigenvalue at eta = 0.01",
              smallest(0.01),
              -1e-8);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  {
    const Parameters parameters(section_text(100., 0.3, 0.2));
    test_side_swap(parameters);
    for (const Element &element : {cubic, serendipity, triangle})
      test_orientation(parameters, element);
    for (const Element &element : {quadratic, serendipity, triangle})
      test_residual(parameters, element);
    test_coercivity(parameters);
  }
  test_bound();
  test_mirror();
  test_clamped_coercivity();
  return n_failures > 0;
}
