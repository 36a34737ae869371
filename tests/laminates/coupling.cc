// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Sections that couple membrane forces and bending, in the forms: the fast
// assembly equals the textbook's, the numbering and orientation of cells don't
// matter, an isotropic stack is the isotropic section, patch tests.

#include "laminate_mesh.h"
#include "laminate_parameters.h"
#include <nacre/discretization/displacement_conditions.h>
#include <nacre/forms/reference_assembly.h>
#include <nacre/problem/midsurface.h>
#include <nacre/solvers/direct_solver.h>

using namespace Tests;

/** The dense matrix, without constraints. */
FullMatrix<double>
matrix_of(const Discretization        &discretization,
          const SectionLaw            &section,
          const BoundaryConditions    &conditions,
          const Loads                 &loads,
          const MembraneStrain         strain,
          const std::optional<double> &eta = {})
{
  const Assembly            fast(discretization,
                      ShellParts(section, conditions, loads, strain, eta));
  AffineConstraints<double> none;
  none.close();
  return dense_system(discretization, fast, none).first;
}

void
test_assembly(const std::string        &name,
              const LaminateParameters &p,
              const Mesh               &mesh,
              const Element            &element,
              const MembraneStrain      strain)
{
  const auto                discretization = make_discretization(mesh, element);
  const ShellParts          parts(p.section, p.conditions, p.loads, strain);
  const Assembly            fast(*discretization, parts);
  const ReferenceAssembly   reference(*discretization, parts, fast.penalty());
  AffineConstraints<double> none;
  none.close();
  const auto K = dense_system(*discretization, fast, none).first;
  TrilinosWrappers::SparseMatrix matrix;
  TrilinosVector load(discretization->locally_owned_dofs(), MPI_COMM_WORLD);
  reference.reinit_matrix(none, matrix);
  reference.assemble_system(none, matrix, load);
  FullMatrix<double> K_reference(K.m(), K.n());
  for (unsigned int i = 0; i < K.m(); ++i)
    for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
      K_reference(i, entry->column()) = entry->value();
  const std::string full_name =
    name + ", " + label(element) + ", " + name_of(strain);
  check_below(full_name + ": matrices",
              relative_difference(K, K_reference),
              1e-12);

  // The residual is the matrix times u, and the energy u . K u / 2.
  const auto     u = interpolate(*discretization, some_field);
  TrilinosVector f(u);
  fast.residual(u, f);
  double energy = 0., error = 0.;
  for (unsigned int i = 0; i < K.m(); ++i)
    {
      double sum = 0.;
      for (unsigned int j = 0; j < K.n(); ++j)
        sum += K(i, j) * u(j);
      energy += 0.5 * u(i) * sum;
      error = std::max(error, std::abs(sum - f(i)));
    }
  check_below(full_name + ": residual", error / f.linfty_norm(), 1e-12);
  check_below(full_name + ": energy",
              std::abs(fast.energies(u).total() / energy - 1.),
              1e-11);
}

void
test_assemblies()
{
  const LaminateParameters p(coupled_stack);
  const auto               curved = make_mesh(bend);
  for (const auto &element : {lagrange(2), lagrange(3), serendipity, triangle})
    for (const auto strain :
         {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
      test_assembly("curved", p, curved, element, strain);
  test_assembly("creased",
                p,
                make_mesh(fold),
                lagrange(2),
                MembraneStrain::tied);
  auto hanging    = curved;
  hanging.refined = {1, 5};
  test_assembly("hanging", p, hanging, lagrange(3), MembraneStrain::tied);
  auto opposite = curved;
  for (const unsigned int k : {1, 5})
    std::swap(opposite.cells[k][1], opposite.cells[k][2]);
  test_assembly("opposite", p, opposite, lagrange(2), MembraneStrain::tied);
}

/** Energies of a displacement on meshes that number the same cells. */
void
test_orientation()
{
  const LaminateParameters p(coupled_stack);
  const auto energy_on = [&](const Mesh &mesh, const Element &element) {
    const auto     discretization = make_discretization(mesh, element);
    const Assembly assembly(*discretization,
                            ShellParts(p.section,
                                       p.conditions,
                                       p.loads,
                                       default_membrane_strain(element.type),
                                       {}));
    return assembly.energies(interpolate(*discretization, some_field)).total();
  };
  for (const auto &element : {lagrange(2), lagrange(3), serendipity})
    {
      const auto   mesh   = make_mesh(bend);
      const double energy = energy_on(mesh, element);
      auto         turned = mesh;
      for (auto &c : turned.cells)
        c = {{c[1], c[3], c[0], c[2]}};
      check_below("cells turned, " + label(element),
                  std::abs(energy_on(turned, element) / energy - 1.),
                  1e-12);
      for (const unsigned int n : {1, 6})
        {
          auto swapped = mesh;
          for (unsigned int k = 0; k < n; ++k)
            std::swap(swapped.cells[k][1], swapped.cells[k][2]);
          check_below(std::to_string(n) + " cells of the other orientation, " +
                        label(element),
                      std::abs(energy_on(swapped, element) / energy - 1.),
                      1e-12);
        }
    }
}

/** With a given penalty: eigenvalues amplify round-off. */
void
test_isotropic()
{
  for (const auto &element : {lagrange(3), serendipity, triangle})
    {
      const auto strain         = default_membrane_strain(element.type);
      const auto discretization = make_discretization(make_mesh(bend), element);
      FullMatrix<double> expected;
      {
        const Parameters p(section_text(100., 0.3, 0.2));
        expected = matrix_of(*discretization,
                             p.section,
                             p.conditions,
                             p.loads,
                             strain,
                             5.);
      }
      const LaminateParameters p(
        laminate_text("[0/17/-33/90]",
                      "0.2",
                      "",
                      "a: E1 = 100, E2 = 100, nu12 = 0.3, G12 = 100/2.6"));
      check_below("isotropic stack, " + label(element),
                  relative_difference(matrix_of(*discretization,
                                                p.section,
                                                p.conditions,
                                                p.loads,
                                                strain,
                                                5.),
                                      expected),
                  1e-12);
    }
}

/** Positive but for the six rigid motions, with the default penalty. */
void
test_definite()
{
  const LaminateParameters  p(laminate_text("[0/90]", "0.05"));
  AffineConstraints<double> none;
  none.close();
  for (const auto &element : {lagrange(2), lagrange(3)})
    {
      const auto discretization = make_discretization(make_mesh(bend), element);
      const auto values         = eigenvalues(matrix_of(*discretization,
                                                p.section,
                                                p.conditions,
                                                p.loads,
                                                MembraneStrain::tied),
                                      none);
      const double largest      = values[values.size() - 1];
      check_below("rigid motions, " + label(element),
                  std::max(std::abs(values[0]), std::abs(values[5])) / largest,
                  1e-13);
      check_above("seventh eigenvalue, " + label(element),
                  values[6] / largest,
                  1e-9);
      // At the bound itself nothing is negative yet.
      const Assembly assembly(
        *discretization,
        ShellParts(p.section, p.conditions, p.loads, MembraneStrain::tied, {}));
      const auto at_bound = eigenvalues(matrix_of(*discretization,
                                                  p.section,
                                                  p.conditions,
                                                  p.loads,
                                                  MembraneStrain::tied,
                                                  assembly.penalty().bound()),
                                        none);
      check_above("lowest eigenvalue at the bound, " + label(element),
                  at_bound[0] / largest,
                  -1e-13);
    }
}

/** An isotropic section that says it couples, with a share of its A. */
struct CoupledIsotropic : LinearElasticSection
{
  CoupledIsotropic(const double share)
    : LinearElasticSection(100., 0.3, 0.05)
    , share(share)
  {}

  SectionStiffness
  stiffness(const SurfaceFrame<> &frame,
            const SectionPoint   &point) const override
  {
    SectionStiffness result = LinearElasticSection::stiffness(frame, point);
    result.membrane *= share;
    return result;
  }

  bool
  is_coupled() const override
  {
    return true;
  }

  double share;
};

/**
 * The bound of sections that couple takes the membrane energy, too. On a
 * curved surface it is the lower for it, and still above the penalty that the
 * matrix needs, which is the same whatever the section says of itself.
 */
void
test_bound_on_cylinder(const Element &element)
{
  const auto discretization =
    make_discretization(make_mesh([](const Point<3> &x) {
                          return Point<3>(2. * std::sin(x[0] / 2.),
                                          x[1],
                                          2. * std::cos(x[0] / 2.));
                        }),
                        element);
  const BoundaryConditions conditions;
  const Loads              loads;
  const auto               bound = [&](const SectionLaw &section) {
    return EdgePenalty(*discretization,
                       section,
                       element.full_quadrature(),
                       std::nullopt)
      .bound();
  };
  const LinearElasticSection isotropic(100., 0.3, 0.05);
  AffineConstraints<double>  none;
  none.close();
  const auto is_positive = [&](const double eta) {
    const auto values = eigenvalues(matrix_of(*discretization,
                                              isotropic,
                                              conditions,
                                              loads,
                                              MembraneStrain::tied,
                                              eta),
                                    none);
    return values[0] > -1e-12 * values[values.size() - 1];
  };
  const double whole = bound(CoupledIsotropic(1.));
  double       low = 0., high = whole;
  for (unsigned int k = 0; k < 8; ++k)
    {
      const double middle                = 0.5 * (low + high);
      (is_positive(middle) ? high : low) = middle;
    }
  const std::string name = "cylinder, " + label(element) + ": ";
  check_below(name + "bound over that of bending alone",
              whole / bound(isotropic),
              0.5);
  check_above(name + "positive at that bound", is_positive(whole), 0.5);
  check_above(name + "least penalty over that bound", high / whole, 0.3);
  check_below(name + "bound of a third of A over the default penalty",
              bound(CoupledIsotropic(1. / 3.)) / (2. * whole),
              1.);
}

/**
 * Membrane and bending strains are constant: u linear in the plane, w
 * quadratic; displacements on all edges, rotations on three, the moment on the
 * fourth, m_nn = nu . (B^T eps + D rho) . nu.
 */
void
test_patch(const Element &element)
{
  const std::string stack = laminate_text("[0/90/30]", "0.4");
  // nu = (1, -0.3)/sqrt(1.09) on u = 1
  const auto frame =
    make_surface_frame(Vector3({1., 0., 0.}), Vector3({0., 1., 0.}), {});
  const Voigt<> m = LaminateParameters(stack)
                      .section
                      .response(Voigt<>({0.01, 0.02, 0.02}),
                                Voigt<>({-0.02, 0.06, -0.04}),
                                frame,
                                Point<3>())
                      .moment;
  const std::string u   = "x = 0.01*x + 0.03*y, y = 0.02*y - 0.01*x, "
                          "z = 0.01*x^2 + 0.02*x*y - 0.03*y^2";
  const std::string w_x = "(0.02*x + 0.02*y)", w_y = "(0.02*x - 0.06*y)";
  TextModelOf<LaminateSectionParameters> text(
    stack +
      "subsection Mid-surface\n set Surface = expression\n"
      " set Subdivisions = 3, 3\n subsection expression\n"
      "  set Position = u + 0.3*v, v, 0\n end\nend\n"
      "subsection Boundary conditions\n set Edges = v=0: " +
      u + ", rotation = -" + w_y + "; v=1: " + u + ", rotation = " + w_y +
      "; u=0: " + u + ", rotation = (-" + w_x + " + 0.3*" + w_y +
      ")/sqrt(1.09); u=1: " + u +
      "\nend\nsubsection Loads\n set Edge moments = u=1: M\nend\n",
    {{"M", (m[0] + 0.09 * m[1] - 0.6 * m[2]) / 1.09}});
  ShellModel &model                = text.model;
  model.element                    = element;
  model.kinematics.membrane_strain = default_membrane_strain(element.type);

  const Discretization           discretization(model.midsurface,
                                      MPI_COMM_WORLD,
                                      element,
                                      0,
                                      0);
  const DisplacementConditions   displacements(discretization, model.supports);
  const Assembly                 assembly(discretization, model);
  const auto                    &constraints = displacements.constraints();
  TrilinosWrappers::SparseMatrix matrix;
  TrilinosVector load(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  TrilinosVector solution(load);
  assembly.reinit_matrix(constraints, matrix);
  assembly.assemble_system(constraints, matrix, load);
  DirectSolver solver(MPI_COMM_WORLD);
  solver.factorize(matrix);
  solver.solve(solution, load);
  constraints.distribute(solution);
  const auto exact = interpolate(discretization, [](const Point<3> &x) {
    return Vector3(
      {0.01 * x[0] + 0.03 * x[1],
       0.02 * x[1] - 0.01 * x[0],
       0.01 * x[0] * x[0] + 0.02 * x[0] * x[1] - 0.03 * x[1] * x[1]});
  });
  solution.add(-1., exact);
  check_below("patch of constant strains, " + label(element),
              solution.linfty_norm() / exact.linfty_norm(),
              1e-11);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_assemblies();
  test_orientation();
  test_isotropic();
  test_definite();
  test_bound_on_cylinder(lagrange(2));
  for (const auto &element : {lagrange(2), lagrange(3), serendipity, triangle})
    test_patch(element);
  return n_failures > 0;
}
