// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The points of edges: ShellEdgeValues, which takes them from tables, against
// deal.II's FEInterfaceValues, which knows nothing of these tables. Both fill
// the same struct.

#include "../tests_common.h"
#include <nacre/base/cpu_timer.h>
#include <nacre/discretization/shell_edge_values.h>
#include <nacre/forms/reference_strains.h>

#include <deal.II/fe/fe_interface_values.h>

#include <deal.II/meshworker/mesh_loop.h>

#include <map>

using namespace Tests;

using Edge          = FEInterfaceValues<2, 3>;
using cell_iterator = DoFHandler<2, 3>::active_cell_iterator;

/** What the edge terms take of one side of an edge at a point. */
struct SidePoint
{
  SurfaceFrame<> frame;
  Point<3>       position;
  Vector3        conormal;
  double         sigma;
  /** Of each node: N; N,1, N,2; N,11, N,22, N,12. */
  std::vector<double>                values;
  std::vector<std::array<double, 2>> gradients;
  std::vector<std::array<double, 3>> hessians;
  /** Of each node and component: the number of the global dof. */
  std::vector<types::global_dof_index> dofs;

  void
  resize(const unsigned int n)
  {
    values.resize(n);
    gradients.resize(n);
    hessians.resize(n);
    dofs.resize(3 * n);
  }
};

/** The points of an edge: [side][point], and JxW of the side 0. */
struct EdgePoints
{
  std::vector<std::vector<SidePoint>> sides;
  std::vector<double>                 JxW;
};

void
fill(const ShellEdgeValues &edge, EdgePoints &points)
{
  points.sides.resize(edge.n_sides());
  points.JxW.resize(edge.n_points());
  for (unsigned int q = 0; q < edge.n_points(); ++q)
    points.JxW[q] = edge.JxW(q);
  for (unsigned int s = 0; s < edge.n_sides(); ++s)
    {
      points.sides[s].resize(edge.n_points());
      const auto &shapes = edge.shapes(s);
      for (unsigned int q = 0; q < edge.n_points(); ++q)
        {
          SidePoint &point = points.sides[s][q];
          point.frame      = edge.frame(s, q);
          point.position   = edge.point(q, s);
          point.conormal   = edge.conormal(s, q);
          point.sigma      = edge.sigma(s, q);
          point.resize(shapes.n_nodes());
          for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
            {
              point.values[a]    = shapes.value(q, a);
              point.gradients[a] = shapes.gradient(q, a);
              point.hessians[a]  = shapes.hessian(q, a);
              for (unsigned int c = 0; c < 3; ++c)
                point.dofs[3 * a + c] = edge.dof_indices()[edge.dof(s, a, c)];
            }
        }
    }
}

/** N,a = a_a . grad N, and N,ab = a_a . hess N . a_b + Gamma^c_ab N,c. */
void
fill_shapes(const FEValuesBase<2, 3>        &fe_values,
            const std::vector<unsigned int> &node_dofs,
            const unsigned int               q,
            SidePoint                       &point)
{
  const std::pair<unsigned int, unsigned int> pairs[] = {{0, 0},
                                                         {1, 1},
                                                         {0, 1}};
  const auto                                 &frame   = point.frame;
  for (unsigned int a = 0; a < point.values.size(); ++a)
    {
      const unsigned int i    = node_dofs[3 * a];
      const auto         grad = fe_values.shape_grad(i, q);
      const auto         hess = fe_values.shape_hessian(i, q);
      point.values[a]         = fe_values.shape_value(i, q);
      for (unsigned int alpha = 0; alpha < 2; ++alpha)
        point.gradients[a][alpha] = frame.a_cov[alpha] * grad;
      for (unsigned int v = 0; v < 3; ++v)
        {
          const auto [alpha, beta] = pairs[v];
          const auto d_jacobian    = fe_values.jacobian_grad(q);
          double     value = frame.a_cov[alpha] * (hess * frame.a_cov[beta]);
          for (unsigned int c = 0; c < 3; ++c)
            value += d_jacobian[c][alpha][beta] * grad[c];
          point.hessians[a][v] = value;
        }
    }
}

void
fill(const Discretization &discretization, const Edge &edge, EdgePoints &points)
{
  const auto        &node_dofs = discretization.node_dofs();
  const unsigned int n_sides   = edge.at_boundary() ? 1 : 2;
  points.sides.resize(n_sides);
  points.JxW                  = edge.get_JxW_values();
  const unsigned int n_points = points.JxW.size();
  for (unsigned int s = 0; s < n_sides; ++s)
    {
      const auto &fe_values = edge.get_fe_face_values(s);
      points.sides[s].resize(n_points);
      std::vector<types::global_dof_index> dofs(node_dofs.size());
      const auto                           plain = fe_values.get_cell();
      const cell_iterator                  cell(&plain->get_triangulation(),
                               plain->level(),
                               plain->index(),
                               &discretization.dof_handler());
      cell->get_dof_indices(dofs);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          SidePoint &point = points.sides[s][q];
          point.frame      = ReferenceStrains::frame_at(fe_values, q);
          point.position   = fe_values.quadrature_point(q);
          point.conormal   = (s == 0 ? 1. : -1.) * fe_values.normal_vector(q);
          point.resize(node_dofs.size() / 3);
          fill_shapes(fe_values, node_dofs, q, point);
          for (unsigned int k = 0; k < node_dofs.size(); ++k)
            point.dofs[k] = dofs[node_dofs[k]];
          const auto tangent = [&](const unsigned int side) {
            const SidePoint &p = points.sides[side][q];
            return cross_product_3d(p.conormal, p.frame.t0);
          };
          point.sigma = (s == 0 || tangent(1) * tangent(0) > 0.) ? 1. : -1.;
        }
    }
}

/** The largest difference of numbers of a kind, and the largest number. */
struct Difference
{
  double difference = 0.;
  double size       = 0.;

  void
  add(const double a, const double b)
  {
    // The negated comparison keeps NaN.
    if (!(std::abs(a - b) <= difference))
      difference = std::abs(a - b);
    size = std::max(size, std::abs(b));
  }

  template <typename Array>
  void
  add_all(const Array &a, const Array &b, const unsigned int n)
  {
    for (unsigned int k = 0; k < n; ++k)
      add(a[k], b[k]);
  }
};

/** Relative to the largest number of its kind. */
constexpr double tolerance = 1e-13;

using Differences = std::map<std::string, Difference>;

void
compare(const SidePoint &a, const SidePoint &b, Differences &result)
{
  const unsigned int n = b.values.size();
  result["sigma"].add(a.sigma, b.sigma);
  result["position"].add_all(a.position, b.position, 3);
  result["conormal"].add_all(a.conormal, b.conormal, 3);
  result["t0"].add_all(a.frame.t0, b.frame.t0, 3);
  for (unsigned int alpha = 0; alpha < 2; ++alpha)
    {
      result["a_cov"].add_all(a.frame.a_cov[alpha], b.frame.a_cov[alpha], 3);
      result["a_con"].add_all(a.frame.a_con[alpha], b.frame.a_con[alpha], 3);
    }
  for (unsigned int v = 0; v < 3; ++v)
    result["phi0,ab"].add_all(a.frame.a_cov_derivatives[v],
                              b.frame.a_cov_derivatives[v],
                              3);
  result["N"].add_all(a.values, b.values, n);
  for (unsigned int k = 0; k < n; ++k)
    {
      result["N,a"].add_all(a.gradients[k], b.gradients[k], 2);
      result["N,ab"].add_all(a.hessians[k], b.hessians[k], 3);
    }
  for (unsigned int k = 0; k < 3 * n; ++k)
    result["dofs"].add(a.dofs[k] == b.dofs[k] ? 0. : 1., 0.);
}

/** Call @p visit(edge arguments of mesh_loop) for all edges of a rank. */
template <typename Visit>
void
for_each_edge(const Discretization &discretization, const Visit &visit)
{
  struct Nothing
  {};
  const unsigned int whole = numbers::invalid_unsigned_int;
  MeshWorker::mesh_loop(
    discretization.dof_handler().begin_active(),
    discretization.dof_handler().end(),
    std::function<void(const cell_iterator &, Nothing &, Nothing &)>(),
    [](const Nothing &) {},
    Nothing(),
    Nothing(),
    MeshWorker::assemble_own_interior_faces_once |
      MeshWorker::assemble_ghost_faces_once |
      MeshWorker::assemble_boundary_faces,
    [&](const cell_iterator &cell, const unsigned int f, Nothing &, Nothing &) {
      visit(cell, f, whole, cell, whole, whole);
    },
    [&](const cell_iterator &cell,
        const unsigned int   f,
        const unsigned int   sf,
        const cell_iterator &neighbor,
        const unsigned int   nf,
        const unsigned int   nsf,
        Nothing &,
        Nothing &) { visit(cell, f, sf, neighbor, nf, nsf); });
}

/** Both at each edge of a mesh; a neighbour's face is invalid at borders. */
struct Both
{
  explicit Both(const Discretization &discretization)
    : tables(discretization)
    , library(discretization.mapping(),
              discretization.dof_handler().get_fe(),
              discretization.element().edge_quadrature(),
              update_values | update_gradients | update_hessians |
                update_JxW_values | update_normal_vectors |
                update_quadrature_points | update_jacobians |
                update_jacobian_grads)
  {}

  template <typename Values>
  static void
  reinit(Values              &values,
         const cell_iterator &cell,
         const unsigned int   f,
         const unsigned int   sf,
         const cell_iterator &neighbor,
         const unsigned int   nf,
         const unsigned int   nsf)
  {
    if (nf == numbers::invalid_unsigned_int)
      values.reinit(cell, f);
    else
      values.reinit(cell, f, sf, neighbor, nf, nsf);
  }

  ShellEdgeValues tables;
  Edge            library;
};

void
test(const std::string &name, const Mesh &mesh, const Element &element)
{
  const auto   discretization = make_discretization(mesh, element);
  Both         both(*discretization);
  EdgePoints   a, b;
  Differences  differences;
  unsigned int n_edges = 0;
  for_each_edge(*discretization, [&](const auto &...edge) {
    Both::reinit(both.tables, edge...);
    Both::reinit(both.library, edge...);
    fill(both.tables, a);
    fill(*discretization, both.library, b);
    AssertThrow(a.sides.size() == b.sides.size(), ExcInternalError());
    for (unsigned int s = 0; s < b.sides.size(); ++s)
      for (unsigned int q = 0; q < b.JxW.size(); ++q)
        compare(a.sides[s][q], b.sides[s][q], differences);
    differences["JxW"].add_all(a.JxW, b.JxW, b.JxW.size());
    ++n_edges;
  });
  // Sums of N,ab X, of which little remains on flat cells.
  auto &second = differences["phi0,ab"].size;
  second =
    std::max(second, differences["N,ab"].size * differences["position"].size);
  double worst = 0.;
  for (const auto &[kind, difference] : differences)
    {
      const double size = Utilities::MPI::max(difference.size, MPI_COMM_WORLD);
      const double relative =
        Utilities::MPI::max(difference.difference, MPI_COMM_WORLD) /
        (size > 0. ? size : 1.);
      if (!(relative < tolerance))
        std::cout << kind << " differs by " << relative << std::endl;
      worst = !(relative <= worst) ? relative : worst;
    }
  // An edge between two ranks is met by one of them.
  check_below(name + ", " + label(element) + ", " +
                std::to_string(Utilities::MPI::sum(n_edges, MPI_COMM_WORLD)) +
                " edges",
              worst,
              tolerance);
}

Mesh
make_mesh(const unsigned int                               n,
          const std::function<Point<3>(const Point<3> &)> &map)
{
  Mesh mesh;
  for (unsigned int j = 0; j <= n; ++j)
    for (unsigned int i = 0; i <= n; ++i)
      mesh.vertices.emplace_back(3. * i / n, 3. * j / n, 0.);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int v = j * (n + 1) + i;
        mesh.cells.push_back({{v, v + 1, v + n + 1, v + n + 2}});
      }
  mesh.map = map;
  return mesh;
}

/** A roof with a ridge at x = 2. */
Point<3>
fold(const Point<3> &x)
{
  return {x[0], x[1], -1.5 * std::abs(x[0] - 2.)};
}

void
test_meshes()
{
  const auto lagrange = [](const unsigned int p) {
    return Element{ElementType::lagrange, p};
  };
  const std::vector<Element> quadrilaterals = {lagrange(2),
                                               lagrange(3),
                                               lagrange(4),
                                               serendipity};

  const auto curved  = make_mesh(3, bend);
  auto       hanging = curved;
  hanging.refined    = {1, 5};
  auto opposite      = curved;
  for (const unsigned int k : {1, 5})
    std::swap(opposite.cells[k][1], opposite.cells[k][2]);
  for (const auto &element : quadrilaterals)
    {
      test("flat", make_mesh(3, [](const auto &x) { return x; }), element);
      test("curved", curved, element);
      test("creased", make_mesh(3, fold), element);
      test("hanging", hanging, element);
      test("opposite", opposite, element);
    }
  test("curved", curved, triangle);
  test("creased", make_mesh(3, fold), triangle);
}

/** What the points of edges cost, beside a whole assembly. */
void
print_costs()
{
  constexpr unsigned int n = 24;
  const Parameters       parameters(section_text(100., 0.3, 0.2));
  for (const unsigned int degree : {2, 3, 4})
    {
      const auto discretization =
        make_discretization(make_mesh(n, bend), degree);
      AffineConstraints<double> constraints;
      constraints.close();
      const Assembly                 assembly(*discretization,
                              ShellParts(parameters.section,
                                         parameters.conditions,
                                         parameters.loads,
                                         KinematicsOptions(),
                                         10.));
      TrilinosWrappers::SparseMatrix matrix;
      TrilinosVector f(discretization->locally_owned_dofs(), MPI_COMM_WORLD);
      assembly.reinit_matrix(constraints, matrix);
      Both                  both(*discretization);
      std::array<double, 3> seconds{{1e100, 1e100, 1e100}};
      for (unsigned int k = 0; k < 9; ++k)
        {
          const auto keep = [&](const unsigned int what, const double lap) {
            seconds[what] = std::min(seconds[what], lap);
          };
          CpuTimer timer(MPI_COMM_WORLD);
          for_each_edge(*discretization, [&](const auto &...edge) {
            Both::reinit(both.tables, edge...);
          });
          keep(0, timer.lap());
          for_each_edge(*discretization, [&](const auto &...edge) {
            Both::reinit(both.library, edge...);
          });
          keep(1, timer.lap());
          assembly.assemble_system(constraints, matrix, f);
          keep(2, timer.lap());
        }
      std::cout << "p = " << degree << ": microseconds a cell by tables "
                << 1e6 * seconds[0] / (n * n) << ", by FEInterfaceValues "
                << 1e6 * seconds[1] / (n * n) << "; assembly "
                << 1e6 * seconds[2] / (n * n) << std::endl;
    }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.setstate(std::ios::failbit);
  if (argc > 1 && std::string(argv[1]) == "costs")
    print_costs();
  else
    test_meshes();
  return n_failures > 0;
}
