// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// FE_Serendipity on distributed meshes with hanging nodes: numbers of dofs,
// interpolation, continuity, transfer between meshes, output.

#include "element_tests.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <array>
#include <functional>

using namespace ElementTests;
using TrilinosVector = TrilinosWrappers::MPI::Vector;
using Triangulation3 = parallel::distributed::Triangulation<2, 3>;

/** Three components, each a function of the position. */
class Field : public Function<3>
{
public:
  explicit Field(const std::function<Tensor<1, 3>(const Point<3> &)> &field)
    : Function<3>(3)
    , field_(field)
  {}

  double
  value(const Point<3> &p, const unsigned int component) const override
  {
    return field_(p)[component];
  }

  void
  vector_value(const Point<3> &p, Vector<double> &values) const override
  {
    for (unsigned int c = 0; c < 3; ++c)
      values[c] = field_(p)[c];
  }

private:
  const std::function<Tensor<1, 3>(const Point<3> &)> field_;
};

const Field linear([](const Point<3> &p) {
  return Tensor<1, 3>(
    {1. + p[0] - 2. * p[1], p[1] + 3. * p[2], .5 * p[0] - p[2]});
});
const Field quadratic([](const Point<3> &p) {
  return Tensor<1, 3>({p[0] * p[0] + p[1],
                       p[1] * p[1] - 2. * p[0] * p[1],
                       p[2] * p[0] + p[2] * p[2] + 1.});
});
const Field smooth([](const Point<3> &p) {
  return Tensor<1, 3>({std::sin(3. * p[0] + 5. * p[1]),
                       std::cos(4. * p[1] - p[2]),
                       std::exp(p[0] * p[2]) * p[1]});
});

/** n cells around and m along a cylinder of radius 1, closed. */
void
make_cylinder(Triangulation3 &tria, const unsigned int n, const unsigned int m)
{
  std::vector<Point<3>>    vertices;
  std::vector<CellData<2>> cells;
  for (unsigned int j = 0; j <= m; ++j)
    for (unsigned int i = 0; i < n; ++i)
      {
        const double angle = 2. * numbers::PI * i / n;
        vertices.emplace_back(std::cos(angle), std::sin(angle), j);
        if (j == m)
          continue;
        const unsigned int next = (i + 1) % n;
        cells.emplace_back();
        cells.back().vertices = {j * n + i,
                                 j * n + next,
                                 (j + 1) * n + i,
                                 (j + 1) * n + next};
      }
  tria.create_triangulation(vertices, cells, SubCellData());
}

/** Refine towards the corner of @p target, so that levels differ. */
void
refine_towards(Triangulation3 &tria, const Point<3> &target)
{
  for (unsigned int step = 0; step < 3; ++step)
    {
      for (const auto &cell : tria.active_cell_iterators())
        if (cell->is_locally_owned() &&
            cell->center().distance(target) < 2. * cell->diameter())
          cell->set_refine_flag();
      tria.execute_coarsening_and_refinement();
    }
}

/** A mesh's dofs for three components, and constraints of hanging nodes. */
struct Space
{
  explicit Space(const Triangulation3 &tria)
    : fe(FE_Serendipity(2), 3)
    , dof_handler(tria)
  {
    distribute();
  }

  void
  distribute()
  {
    dof_handler.distribute_dofs(fe);
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    owned_vector.reinit(dof_handler.locally_owned_dofs(), comm);
    ghosted_vector.reinit(dof_handler.locally_owned_dofs(), relevant, comm);
    constraints.clear();
    constraints.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();
  }

  /** The field at the nodes, constrained; returns what that changed. */
  double
  interpolate(const Field &field)
  {
    VectorTools::interpolate(mapping, dof_handler, field, owned_vector);
    ghosted_vector      = owned_vector;
    TrilinosVector free = owned_vector;
    constraints.distribute(owned_vector);
    ghosted_vector = owned_vector;
    free -= owned_vector;
    return free.linfty_norm();
  }

  /** Numbers without any pattern. */
  void
  fill_randomly(const bool constrain)
  {
    for (const auto i : dof_handler.locally_owned_dofs())
      owned_vector(i) = std::fmod(1e3 * std::sin(1. + 7. * i), 1.);
    owned_vector.compress(VectorOperation::insert);
    if (constrain)
      constraints.distribute(owned_vector);
    ghosted_vector = owned_vector;
  }

  const MappingQ<2, 3>      mapping{1};
  const FESystem<2, 3>      fe;
  DoFHandler<2, 3>          dof_handler;
  AffineConstraints<double> constraints;
  TrilinosVector            owned_vector;
  TrilinosVector            ghosted_vector;
};

/** Largest jump at quadrature points of all interior edges. */
double
largest_jump(const Space &space)
{
  FEInterfaceValues<2, 3> edge(space.mapping,
                               space.fe,
                               QGauss<1>(4),
                               update_values);
  double                  largest = 0.;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      {
        // From the finer cell, or from both.
        if (!cell->is_locally_owned() || cell->at_boundary(face) ||
            cell->neighbor(face)->has_children())
          continue;
        const auto neighbor = cell->neighbor(face);
        if (cell->neighbor_is_coarser(face))
          {
            const auto where = cell->neighbor_of_coarser_neighbor(face);
            edge.reinit(cell,
                        face,
                        numbers::invalid_unsigned_int,
                        neighbor,
                        where.first,
                        where.second);
          }
        else
          edge.reinit(cell,
                      face,
                      numbers::invalid_unsigned_int,
                      neighbor,
                      cell->neighbor_of_neighbor(face),
                      numbers::invalid_unsigned_int);
        const auto dofs = edge.get_interface_dof_indices();
        for (const unsigned int q : edge.quadrature_point_indices())
          for (unsigned int c = 0; c < 3; ++c)
            {
              double jump = 0.;
              for (unsigned int i = 0; i < dofs.size(); ++i)
                jump += space.ghosted_vector(dofs[i]) *
                        edge.jump_in_shape_values(i, q, c);
              raise(largest, std::abs(jump));
            }
      }
  return largest;
}

/** Largest difference from a field at points within the cells. */
double
largest_error(const Space &space, const Field &field)
{
  FEValues<2, 3>              values(space.mapping,
                        space.fe,
                        QGauss<2>(4),
                        update_values | update_quadrature_points);
  std::vector<Vector<double>> u(values.n_quadrature_points, Vector<double>(3));
  Vector<double>              expected(3);
  double                      largest = 0.;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        values.reinit(cell);
        values.get_function_values(space.ghosted_vector, u);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            field.vector_value(values.quadrature_point(q), expected);
            expected -= u[q];
            raise(largest, expected.linfty_norm());
          }
      }
  return largest;
}

/** The integral of |u|^2, exact. */
double
square_integral(const Space &space)
{
  FEValues<2, 3>              values(space.mapping,
                        space.fe,
                        QGauss<2>(5),
                        update_values | update_JxW_values);
  std::vector<Vector<double>> u(values.n_quadrature_points, Vector<double>(3));
  double                      sum = 0.;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        values.reinit(cell);
        values.get_function_values(space.ghosted_vector, u);
        for (const unsigned int q : values.quadrature_point_indices())
          sum += u[q].norm_sqr() * values.JxW(q);
      }
  return Utilities::MPI::sum(sum, comm);
}

/** The mesh of the report's figure: 31 x 31 cells. */
void
test_numbers()
{
  Triangulation3 tria(comm);
  make_cylinder(tria, 31, 31);
  DoFHandler<2, 3> dof_handler(tria);
  dof_handler.distribute_dofs(FE_Serendipity(2));
  check_equal("cells", tria.n_global_active_cells(), 961);
  check_equal("nodes, 8 a cell", dof_handler.n_dofs(), 2945);
  dof_handler.distribute_dofs(FESystem<2, 3>(FE_Serendipity(2), 3));
  check_equal("dofs", dof_handler.n_dofs(), 8835);
  dof_handler.distribute_dofs(FE_Q<2, 3>(2));
  check_equal("nodes, 9 a cell", dof_handler.n_dofs(), 3906);
}

/** A plane, cut into parallelograms, that isn't parallel to any axis. */
Point<3>
skew(const Point<3> &x)
{
  return {x[0] + .3 * x[1], .8 * x[1] - .2 * x[0], .4 * x[0] + .5 * x[1]};
}

/** The same plane; lines y = const. are no longer parallel. */
Point<3>
taper(const Point<3> &x)
{
  return skew({x[0], x[1] * (1. + .4 * x[0]), 0.});
}

void
test_interpolation()
{
  Triangulation3 affine(comm), tapered(comm);
  GridGenerator::subdivided_hyper_cube(affine, 3);
  GridGenerator::subdivided_hyper_cube(tapered, 3);
  GridTools::transform(skew, affine);
  GridTools::transform(taper, tapered);
  refine_towards(affine, Point<3>());
  refine_towards(tapered, Point<3>());

  Space space(affine);
  check_above("hanging nodes, affine", space.constraints.n_constraints(), 2.);
  check_below("constraints keep linear fields",
              space.interpolate(linear),
              1e-14);
  check_below("linear fields on affine cells",
              largest_error(space, linear),
              1e-14);
  check_below("constraints keep quadratic fields",
              space.interpolate(quadratic),
              1e-14);
  check_below("quadratic fields on affine cells",
              largest_error(space, quadratic),
              1e-14);
  check_below("quadratic fields are continuous", largest_jump(space), 1e-14);

  Space other(tapered);
  other.interpolate(linear);
  check_below("linear fields on tapered cells",
              largest_error(other, linear),
              1e-14);
  // The centre node would be needed.
  other.interpolate(quadratic);
  check_above("no quadratic fields on tapered cells",
              largest_error(other, quadratic),
              1e-5);
}

void
test_continuity()
{
  Triangulation3 tria(comm);
  make_cylinder(tria, 6, 3);
  refine_towards(tria, Point<3>(1., 0., 0.));
  Space space(tria);
  space.fill_randomly(false);
  check_above("unconstrained random fields jump", largest_jump(space), .1);
  space.fill_randomly(true);
  check_below("constrained random fields don't", largest_jump(space), 1e-14);
  check_above("and aren't zero", space.owned_vector.linfty_norm(), .5);
}

/** To another mesh: what @p flag does with each cell. */
void
transfer(Triangulation3 &tria,
         Space          &space,
         const std::function<void(const Triangulation3::cell_iterator &)> &flag)
{
  for (const auto &cell : tria.active_cell_iterators())
    if (cell->is_locally_owned())
      flag(cell);
  parallel::distributed::SolutionTransfer<2, TrilinosVector, 3> transfer(
    space.dof_handler);
  tria.prepare_coarsening_and_refinement();
  transfer.prepare_for_coarsening_and_refinement(space.ghosted_vector);
  tria.execute_coarsening_and_refinement();
  space.distribute();
  transfer.interpolate(space.owned_vector);
  space.ghosted_vector = space.owned_vector;
}

void
test_solution_transfer(const std::string &name, const bool is_adaptive)
{
  Triangulation3 tria(comm);
  make_cylinder(tria, 6, 3);
  if (is_adaptive)
    refine_towards(tria, Point<3>(1., 0., 0.));
  Space      space(tria);
  const auto n_cells = tria.n_global_active_cells();
  space.interpolate(smooth);
  const double integral = square_integral(space);

  transfer(tria, space, [](const auto &cell) { cell->set_refine_flag(); });
  check_equal(name + "four times as many cells",
              tria.n_global_active_cells() / n_cells,
              4);
  check_below(name + "the same field on the finer mesh",
              std::abs(square_integral(space) / integral - 1.),
              1e-13);
  check_below(name + "continuous", largest_jump(space), 1e-13);

  // Beside a hanging node of another rank families stay as they are.
  transfer(tria, space, [](const auto &cell) { cell->set_coarsen_flag(); });
  check_below(name + "coarse again",
              double(tria.n_global_active_cells()) / n_cells,
              is_adaptive ? 2. : 1.0001);
  check_below(name + "the same field",
              std::abs(square_integral(space) / integral - 1.),
              1e-13);
  check_below(name + "continuous", largest_jump(space), 1e-13);
  if (is_adaptive)
    return;
  TrilinosVector back = space.owned_vector;
  space.interpolate(smooth);
  back -= space.owned_vector;
  check_below(name + "the same nodal values", back.linfty_norm(), 1e-13);
}

/** DataOut with its patches laid open. */
struct OpenDataOut : DataOut<2, 3>
{
  using DataOut<2, 3>::get_patches;
};

void
test_output()
{
  Triangulation3 tria(comm);
  GridGenerator::subdivided_hyper_cube(tria, 3);
  GridTools::transform(skew, tria);
  refine_towards(tria, Point<3>());
  Space space(tria);
  space.interpolate(quadratic);
  OpenDataOut data_out;
  data_out.attach_dof_handler(space.dof_handler);
  data_out.add_data_vector(
    space.ghosted_vector,
    std::vector<std::string>(3, "u"),
    DataOut<2, 3>::type_dof_data,
    std::vector<DataComponentInterpretation::DataComponentInterpretation>(
      3,
      DataComponentInterpretation::component_is_part_of_vector));
  data_out.build_patches(space.mapping, 2);
  double error = (data_out.get_patches().empty() ? 1. : 0.);
  for (const auto &patch : data_out.get_patches())
    for (unsigned int k = 0; k < 9; ++k)
      {
        const Point<2> unit(.5 * (k % 3), .5 * (k / 3));
        Point<3>       p;
        for (unsigned int v = 0; v < 4; ++v)
          p += GeometryInfo<2>::d_linear_shape_function(unit, v) *
               Tensor<1, 3>(patch.vertices[v]);
        for (unsigned int c = 0; c < 3; ++c)
          raise(error, std::abs(patch.data(c, k) - quadratic.value(p, c)));
      }
  // Written in single precision.
  check_below("output", error, 1e-6);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_numbers();
  test_interpolation();
  test_continuity();
  test_solution_transfer("uniform mesh: ", false);
  test_solution_transfer("hanging nodes: ", true);
  test_output();
  return n_failures > 0;
}
