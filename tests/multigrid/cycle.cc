// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The V-cycle is symmetric, and few iterations solve what the direct solver
// does: all elements, hanging nodes, meshes without a coarser one, thin shells,
// co-rotational tangents, on any number of ranks. An indefinite matrix
// is found out.

#include "multigrid_case.h"
#include <nacre/solvers/direct_solver.h>

using namespace MultigridTests;

const std::string roof = R"(
subsection Mid-surface
  set Surface      = cylinder
  set Subdivisions = 2, 2
  subsection cylinder
    set Radius      = 25
    set Axis        = y
    set Angle range = 0, 40
    set Axial range = 0, 25
  end
end
subsection Section
  set Young's modulus = 4.32e8
  set Poisson's ratio = 0
  set Thickness       = 0.25
end
subsection Boundary conditions
  set Edges = u=0: symmetry; u=1: free; v=0: diaphragm; v=1: symmetry
end
subsection Loads
  set Force per area = 0, 0, -90
end
)";

const std::string hemisphere = R"(
subsection Mid-surface
  set Surface      = hemisphere
  set Subdivisions = 4, 4
  subsection hemisphere
    set Radius        = 10
    set Hole angle    = 18
    set Azimuth range = 0, 90
  end
end
subsection Section
  set Young's modulus = 6.825e7
  set Poisson's ratio = 0.3
  set Thickness       = 0.04
end
subsection Boundary conditions
  set Edges  = u=0, u=1: symmetry; equator, hole: free
  set Points = (10/sqrt(2), 10/sqrt(2), 0): z = 0
end
subsection Loads
  set Point forces = (10, 0, 0): 1, 0, 0; (0, 10, 0): 0, -1, 0
end
)";

/** Debug is twenty times slower: meshes are coarser by one there. */
unsigned int
refinements(const unsigned int n)
{
#ifdef DEBUG
  return n > 0 ? n - 1 : 0;
#else
  return n;
#endif
}

/** A shell's text with other coarse cells. */
std::string
subdivided(std::string text, const std::string &subdivisions)
{
  const std::string name  = "Subdivisions = ";
  const auto        begin = text.find(name) + name.size();
  return text.replace(begin, text.find('\n', begin) - begin, subdivisions);
}

TrilinosVector
some_vector(const System &system, const double seed)
{
  TrilinosVector v(system.b);
  for (const auto i : v.locally_owned_elements())
    v(i) = system.conditions.constraints().is_constrained(i) ?
             0. :
             std::sin(seed + 17. * i);
  v.compress(VectorOperation::insert);
  return v;
}

/** A ghosted displacement of the size of the shell's thickness. */
TrilinosVector
some_displacement(const Discretization &discretization,
                  const System         &linear,
                  const double          size)
{
  DirectSolver solver(MPI_COMM_WORLD);
  solver.factorize(linear.matrix);
  TrilinosVector u(linear.b);
  solver.solve(u, linear.b);
  u *= size / u.linfty_norm();
  linear.conditions.constraints().distribute(u);
  TrilinosVector ghosted(discretization.locally_owned_dofs(),
                         discretization.locally_relevant_dofs(),
                         MPI_COMM_WORLD);
  ghosted = u;
  return ghosted;
}

void
check_solution(const std::string    &name,
               const ShellModel     &model,
               const Discretization &discretization,
               const System         &system,
               const TrilinosVector *u,
               const unsigned int    max_iterations)
{
  MultigridSolver::Parameters parameters;
  parameters.coarse_dofs = 600;
  MultigridSolver solver(discretization, model, parameters);
  solver.prepare({system.matrix, system.conditions.constraints(), u});
  Tests::check_above(name + ": levels", solver.n_levels(), 1.5);

  const TrilinosVector v = some_vector(system, 1.), w = some_vector(system, 2.);
  TrilinosVector       Bv(v), Bw(w);
  solver.apply_cycle(Bv, v);
  solver.apply_cycle(Bw, w);
  Tests::check_below(name + ": symmetry",
                     std::abs(Bv * w - v * Bw) / std::sqrt((Bv * v) * (Bw * w)),
                     1e-5);

  TrilinosVector x(system.b), expected(system.b);
  const auto     accuracy = solver.solve(x, system.b);
  Tests::check_below(name + ": iterations",
                     accuracy.n_iterations,
                     max_iterations + 0.5);
  Tests::check_below(name + ": backward error", accuracy.backward_error, 1e-9);
  DirectSolver direct(MPI_COMM_WORLD);
  direct.factorize(system.matrix);
  direct.solve(expected, system.b);
  x -= expected;
  Tests::check_below(name + ": solution",
                     x.linfty_norm() / expected.linfty_norm(),
                     1e-6);
}

void
test(const std::string         &name,
     const std::string         &text,
     const Element             &element,
     const unsigned int         n_refinements,
     const unsigned int         max_iterations,
     const std::vector<Marker> &markers   = {},
     const double               thickness = 0.)
{
  Case shell(text, thickness);
  shell.model.kinematics.membrane_strain =
    default_membrane_strain(element.type);
  const auto discretization =
    shell.discretize(element, refinements(n_refinements), markers);
  const System system(shell.model, *discretization);
  check_solution(name + ", " + Tests::label(element),
                 shell.model,
                 *discretization,
                 system,
                 nullptr,
                 max_iterations);
}

void
test_large_rotations(const KinematicsModel model,
                     const Element        &element,
                     const unsigned int    max_iterations,
                     const std::string    &text          = roof,
                     const unsigned int    n_refinements = 3)
{
  Case       shell(text);
  const auto discretization =
    shell.discretize(element, refinements(n_refinements));
  auto &options           = shell.model.kinematics;
  options.membrane_strain = default_membrane_strain(element.type);
  const System linear(shell.model, *discretization);
  const auto   u  = some_displacement(*discretization, linear, 0.5);
  options.model   = model;
  options.tangent = TangentType::symmetric;
  const System system(shell.model, *discretization, &u);
  check_solution(name_of(model) + ", " + Tests::label(element),
                 shell.model,
                 *discretization,
                 system,
                 &u,
                 max_iterations);
}

/** A penalty far below its bound. */
void
test_indefinite()
{
  Case          shell(roof);
  const Element element{ElementType::lagrange, 3};
  const auto    discretization = shell.discretize(element, 2);
  shell.model.eta              = 0.01;
  const System system(shell.model, *discretization);
  bool         is_found = false;
  try
    {
      MultigridSolver solver(*discretization, shell.model, {});
      solver.prepare({system.matrix, system.conditions.constraints()});
      TrilinosVector x(system.b);
      solver.solve(x, system.b);
    }
  catch (const ExcIterationFailed &)
    {
      is_found = true;
    }
  Tests::check_below("indefinite", is_found ? 0. : 1., 0.5);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (!is_root())
    std::cout.setstate(std::ios::failbit);
  constexpr auto lagrange = ElementType::lagrange;
  test("roof", roof, {lagrange, 2}, 4, 12);
  test("roof", roof, {lagrange, 3}, 3, 12);
  test("roof", roof, {lagrange, 4}, 2, 12);
  test("roof", roof, Tests::serendipity, 4, 12);
  test("roof", roof, Tests::triangle, 4, 15);
  test("thin roof", roof, {lagrange, 3}, 3, 14, {}, 0.025);
  test("hemisphere", hemisphere, {lagrange, 2}, 2, 20);
  test("hemisphere", hemisphere, {lagrange, 3}, 2, 15);
  const Marker corner = [](const Point<spacedim> &x) {
    return x.distance(Point<spacedim>(0., 0., 25.)) < 8.;
  };
  test("hanging nodes", roof, {lagrange, 2}, 3, 16, {corner, corner});
  test("hanging nodes", roof, {lagrange, 3}, 2, 16, {corner, corner});
  test("hanging nodes", roof, Tests::serendipity, 3, 16, {corner, corner});
  constexpr auto corotational = KinematicsModel::corotational;
  test_large_rotations(corotational, {lagrange, 2}, 12);
  test_large_rotations(corotational, {lagrange, 3}, 12);
  test_large_rotations(corotational, Tests::triangle, 15);
  test_large_rotations(KinematicsModel::finite, {lagrange, 2}, 12);
  const std::string fine_roof = subdivided(roof, "12, 12");
  test("one mesh, roof", fine_roof, {lagrange, 3}, 0, 12);
  test("one mesh, roof", fine_roof, {lagrange, 4}, 0, 12);
  test("one mesh, hemisphere",
       subdivided(hemisphere, "12, 12"),
       {lagrange, 3},
       0,
       14);
  test_large_rotations(corotational, {lagrange, 3}, 12, fine_roof, 0);
  test_indefinite();
}
