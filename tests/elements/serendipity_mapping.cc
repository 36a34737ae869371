// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Geometry in the space of FE_Serendipity, conforming at hanging nodes, with
// the derivatives that shells need, by two mappings: MappingQCache(2), whose
// space contains the 8-node one, on cells and edges; MappingFE on cells only:
// deal.II 9.4's has no lengths on halves of edges (JxW, which normals bring
// along): an assertion fails in Debug, Release gives twice the length.

#include "element_tests.h"

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <deal.II/grid/grid_generator.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using namespace ElementTests;
using Triangulation3 = parallel::distributed::Triangulation<2, 3>;
using CellIterator   = Triangulation<2, 3>::cell_iterator;

/** A surface over the plane z = 0, curved every way. */
Point<3>
surface(const Point<3> &x)
{
  return {x[0] + .1 * std::sin(2. * x[1]),
          x[1] + .1 * x[0] * x[1],
          .5 * std::sin(x[0] + .3) * std::cos(1.5 * x[1])};
}

/** Positions of nodes, constrained at hanging ones. */
struct Geometry
{
  explicit Geometry(const Triangulation3 &tria)
    : dof_handler(tria)
  {
    dof_handler.distribute_dofs(FESystem<2, 3>(FE_Serendipity(2), 3));
    const auto &fe = dof_handler.get_fe();
    IndexSet    relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    positions.reinit(dof_handler.locally_owned_dofs(), relevant, comm);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (dof_handler.locally_owned_dofs().is_element(dofs[i]))
              {
                Point<3>   chart;
                const auto unit = fe.unit_support_point(i);
                for (const unsigned int v : cell->vertex_indices())
                  chart += GeometryInfo<2>::d_linear_shape_function(unit, v) *
                           Tensor<1, 3>(cell->vertex(v));
                positions(dofs[i]) =
                  surface(chart)[fe.system_to_component_index(i).first];
              }
        }
    AffineConstraints<double> constraints(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();
    n_constraints = constraints.n_constraints();
    constraints.distribute(positions);
    positions.update_ghost_values();
  }

  std::vector<Point<3>>
  nodes(const CellIterator &cell) const
  {
    const auto                                  &fe = dof_handler.get_fe();
    const DoFHandler<2, 3>::active_cell_iterator dof_cell(
      &dof_handler.get_triangulation(),
      cell->level(),
      cell->index(),
      &dof_handler);
    Vector<double> values(fe.n_dofs_per_cell());
    dof_cell->get_dof_values(positions, values);
    std::vector<Point<3>> nodes(8);
    for (unsigned int i = 0; i < values.size(); ++i)
      {
        const auto where                 = fe.system_to_component_index(i);
        nodes[where.second][where.first] = values[i];
      }
    return nodes;
  }

  DoFHandler<2, 3>                           dof_handler;
  LinearAlgebra::distributed::Vector<double> positions;
  unsigned int                               n_constraints;
};

/** The mapping that takes its nodes from a Geometry. */
class NodeMapping : public MappingFE<2, 3>
{
public:
  explicit NodeMapping(const Geometry &geometry)
    : MappingFE<2, 3>(FE_Serendipity(2))
    , geometry_(geometry)
  {}

  std::unique_ptr<Mapping<2, 3>>
  clone() const override
  {
    return std::make_unique<NodeMapping>(*this);
  }

  bool
  preserves_vertex_locations() const override
  {
    return false;
  }

protected:
  std::vector<Point<3>>
  compute_mapping_support_points(const CellIterator &cell) const override
  {
    return geometry_.nodes(cell);
  }

private:
  const Geometry &geometry_;
};

constexpr double step = 1e-4;

/** dx/dxi_a at a unit point by differences. */
Tensor<1, 3>
tangent(const Mapping<2, 3> &mapping,
        const CellIterator  &cell,
        const Point<2>      &unit,
        const unsigned int   a)
{
  const Tensor<1, 2> e = step * Point<2>::unit_vector(a);
  return (mapping.transform_unit_to_real_cell(cell, unit + e) -
          mapping.transform_unit_to_real_cell(cell, unit - e)) /
         (2. * step);
}

/** The same of tangents. */
Tensor<1, 3>
second_derivative(const Mapping<2, 3> &mapping,
                  const CellIterator  &cell,
                  const Point<2>      &unit,
                  const unsigned int   a,
                  const unsigned int   b)
{
  const Tensor<1, 2> e = step * Point<2>::unit_vector(b);
  return (tangent(mapping, cell, unit + e, a) -
          tangent(mapping, cell, unit - e, a)) /
         (2. * step);
}

/** Unit normal at the point of a covariant basis. */
Tensor<1, 3>
normal_of(const DerivativeForm<1, 2, 3> &jacobian)
{
  const auto columns = jacobian.transpose();
  const auto normal  = cross_product_3d(columns[0], columns[1]);
  return normal / normal.norm();
}

/** Points and derivatives of the mapping on cells. */
void
test_cells(const Mapping<2, 3> &mapping, const Geometry &geometry)
{
  const FE_Serendipity fe(2);
  const QGauss<2>      quadrature(3);
  FEValues<2, 3>       values(mapping,
                        fe,
                        quadrature,
                        update_values | update_gradients | update_hessians |
                          update_jacobians | update_jacobian_grads |
                          update_quadrature_points | update_JxW_values |
                          update_normal_vectors);
  double points = 0., jacobians = 0., second = 0., area = 0., normals = 0.,
         inverse = 0.;
  for (const auto &cell :
       geometry.dof_handler.get_triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        values.reinit(cell);
        const auto nodes = geometry.nodes(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto &unit = quadrature.point(q);
            Point<3>    x;
            for (unsigned int i = 0; i < 8; ++i)
              x += values.shape_value(i, q) * Tensor<1, 3>(nodes[i]);
            raise(points, x.distance(values.quadrature_point(q)));
            const auto &J = values.jacobian(q);
            for (unsigned int a = 0; a < 2; ++a)
              {
                const auto t = tangent(mapping, cell, unit, a);
                for (unsigned int c = 0; c < 3; ++c)
                  raise(jacobians, std::abs(J[c][a] - t[c]));
                for (unsigned int b = 0; b < 2; ++b)
                  {
                    const auto s = second_derivative(mapping, cell, unit, a, b);
                    for (unsigned int c = 0; c < 3; ++c)
                      raise(second,
                            std::abs(values.jacobian_grad(q)[c][a][b] - s[c]));
                  }
              }
            raise(area,
                  std::abs(values.JxW(q) / quadrature.weight(q) -
                           J.determinant()));
            raise(normals, (values.normal_vector(q) - normal_of(J)).norm());
            raise(inverse,
                  unit.distance(mapping.transform_real_to_unit_cell(cell, x)));
          }
      }
  check_below("points", points, 1e-14);
  check_below("Jacobians", jacobians, 1e-9);
  check_below("second derivatives", second, 1e-6);
  check_below("areas", area, 1e-14);
  check_below("normals of cells", normals, 1e-14);
  check_below("points back to the reference cell", inverse, 1e-8);
}

/**
 * Derivatives of the position x = sum N_i X_i: the gradient projects to the
 * tangent plane, covariant second derivatives are normal (Gauss).
 */
void
test_position_field(const Mapping<2, 3> &mapping, const Geometry &geometry)
{
  const FE_Serendipity fe(2);
  FEValues<2, 3>       values(mapping,
                        fe,
                        QGauss<2>(3),
                        update_gradients | update_hessians | update_jacobians);
  double               gradients = 0., hessians = 0.;
  for (const auto &cell :
       geometry.dof_handler.get_triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        values.reinit(cell);
        const auto nodes = geometry.nodes(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const auto   normal = normal_of(values.jacobian(q));
            Tensor<2, 3> gradient;
            Tensor<3, 3> hessian;
            for (unsigned int i = 0; i < 8; ++i)
              {
                const Tensor<1, 3> X(nodes[i]);
                gradient += outer_product(X, values.shape_grad(i, q));
                hessian += outer_product(X, values.shape_hessian(i, q));
              }
            gradient += outer_product(normal, normal);
            raise(gradients,
                  (gradient - Tensor<2, 3>(unit_symmetric_tensor<3>())).norm());
            const Tensor<2, 3> along = normal * hessian;
            raise(hessians, (hessian - outer_product(normal, along)).norm());
          }
      }
  check_below("gradient of the position", gradients, 1e-12);
  check_below("second derivatives of the position", hessians, 1e-11);
}

/** Conormals, and agreement of both sides, on edges and halves of edges. */
class EdgeTest
{
public:
  EdgeTest(const Mapping<2, 3> &mapping, const Geometry &geometry)
    : geometry_(geometry)
    , edge_(mapping,
            fe_,
            QGauss<1>(3),
            update_values | update_gradients | update_hessians |
              update_jacobians | update_quadrature_points | update_JxW_values |
              update_normal_vectors)
    , dof_handler_(geometry.dof_handler.get_triangulation())
  {
    dof_handler_.distribute_dofs(fe_);
  }

  void
  run()
  {
    for (const auto &cell : dof_handler_.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->is_locally_owned() && !cell->at_boundary(face) &&
            !cell->neighbor(face)->has_children())
          {
            reinit(cell, face);
            check_side(0, face);
            check_side(1,
                       cell->neighbor_is_coarser(face) ?
                         cell->neighbor_of_coarser_neighbor(face).first :
                         cell->neighbor_of_neighbor(face));
            check_sides(cell, cell->neighbor(face));
          }
    check_above("halves of edges", n_halves_, 0.);
    check_below("conormals", conormals_, 1e-13);
    check_below("outward", -outward_, 0.);
    check_below("both sides' points", points_, 1e-14);
    check_below("both sides' lengths", lengths_, 1e-14);
    check_below("both sides' values", values_, 1e-14);
    check_below("both sides' tangential derivatives", tangential_, 1e-12);
  }

private:
  void
  reinit(const DoFHandler<2, 3>::active_cell_iterator &cell,
         const unsigned int                            face)
  {
    constexpr auto whole    = numbers::invalid_unsigned_int;
    const auto     neighbor = cell->neighbor(face);
    if (!cell->neighbor_is_coarser(face))
      {
        const auto other = cell->neighbor_of_neighbor(face);
        edge_.reinit(cell, face, whole, neighbor, other, whole);
        return;
      }
    const auto where = cell->neighbor_of_coarser_neighbor(face);
    edge_.reinit(cell, face, whole, neighbor, where.first, where.second);
    n_halves_ += 1.;
  }

  /** Tangent of the edge at the side's point. */
  Tensor<1, 3>
  edge_tangent(const unsigned int side,
               const unsigned int face,
               const unsigned int q) const
  {
    const auto columns = edge_.get_fe_face_values(side).jacobian(q).transpose();
    return columns[face < 2 ? 1 : 0] / columns[face < 2 ? 1 : 0].norm();
  }

  /** The conormal: a unit vector, tangent to the surface, across the edge. */
  void
  check_side(const unsigned int side, const unsigned int face)
  {
    const auto &values = edge_.get_fe_face_values(side);
    faces_[side]       = face;
    for (const unsigned int q : values.quadrature_point_indices())
      {
        const auto &J  = values.jacobian(q);
        const auto  nu = values.normal_vector(q);
        raise(conormals_, std::abs(nu.norm() - 1.));
        raise(conormals_, std::abs(nu * normal_of(J)));
        raise(conormals_, std::abs(nu * edge_tangent(side, face, q)));
        // Across the edge, away from the cell.
        const auto   across = J.transpose()[face < 2 ? 0 : 1];
        const double sign   = (face % 2 == 1 ? 1. : -1.);
        outward_ = std::min(outward_, sign * (nu * across) / across.norm());
      }
  }

  void
  check_sides(const CellIterator &cell, const CellIterator &neighbor)
  {
    const std::array<std::vector<Point<3>>, 2> nodes = {
      {geometry_.nodes(cell), geometry_.nodes(neighbor)}};
    const auto &minus = edge_.get_fe_face_values(0);
    const auto &plus  = edge_.get_fe_face_values(1);
    for (const unsigned int q : edge_.quadrature_point_indices())
      {
        raise(points_,
              minus.quadrature_point(q).distance(plus.quadrature_point(q)));
        raise(lengths_, std::abs(minus.JxW(q) - plus.JxW(q)));
        Tensor<1, 3> position_jump, derivative_jump;
        for (unsigned int side = 0; side < 2; ++side)
          for (unsigned int i = 0; i < 8; ++i)
            {
              const auto        &values = edge_.get_fe_face_values(side);
              const Tensor<1, 3> X(nodes[side][i]);
              const double       sign = (side == 0 ? 1. : -1.);
              position_jump += sign * values.shape_value(i, q) * X;
              derivative_jump +=
                sign *
                (values.shape_grad(i, q) * edge_tangent(0, faces_[0], q)) * X;
            }
        raise(values_, position_jump.norm());
        raise(tangential_, derivative_jump.norm());
      }
  }

  const Geometry         &geometry_;
  const FE_Serendipity    fe_{2};
  FEInterfaceValues<2, 3> edge_;
  DoFHandler<2, 3>        dof_handler_;
  std::array<unsigned, 2> faces_{};
  double                  n_halves_ = 0., conormals_ = 0., outward_ = 1.;
  double points_ = 0., lengths_ = 0., values_ = 0., tangential_ = 0.;
};

void
heading(const std::string &name)
{
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    std::cout << name << std::endl;
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Triangulation3                   tria(comm);
  GridGenerator::subdivided_hyper_cube(tria, 3);
  for (unsigned int step = 0; step < 3; ++step)
    {
      for (const auto &cell : tria.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->center().distance(Point<3>(.4, .7, 0.)) < cell->diameter())
          cell->set_refine_flag();
      tria.execute_coarsening_and_refinement();
    }
  const Geometry geometry(tria);
  check_above("hanging nodes", geometry.n_constraints, 0.);

  MappingQCache<2, 3> cache(2);
  cache.initialize(MappingQ<2, 3>(1),
                   geometry.dof_handler,
                   geometry.positions,
                   false);
  heading("MappingQCache");
  test_cells(cache, geometry);
  test_position_field(cache, geometry);
  EdgeTest(cache, geometry).run();

  const NodeMapping mapping(geometry);
  heading("MappingFE");
  test_cells(mapping, geometry);
  test_position_field(mapping, geometry);
  return n_failures > 0;
}
