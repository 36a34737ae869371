// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Initial strains of a laminate that couples everything, and a foundation that
// doesn't pull: the forces are the gradient of the energy and the tangent is
// their derivative, by differences, on a mesh with hanging nodes and a cell of
// the other orientation. A plate that takes its initial strains has no forces.

#include "../laminates/laminate_mesh.h"
#include <nacre/mechanics/shell_section.h>
#include <nacre/problem/foundation.h>

using namespace Tests;

/** A laminate with initial strains, on a foundation. */
std::string
grown_text(const std::string &alphas, const std::string &others)
{
  return "subsection Section\n set Type = laminate\n subsection Laminate\n"
         "  set Materials = ply: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5, " +
         alphas +
         "\n  set Stack = [0/90/30]\n  set Thickness = 0.3\n"
         "  set Material direction = 1, 0.3, 0.2\n"
         "  set Top = 0.1, 0.2, 1\n end\n subsection Initial strain\n"
         "  set Temperature gradient = 5\n" +
         others;
}

const std::string strange =
  grown_text("alpha1 = -1e-3, alpha2 = 2e-2",
             "  set Strain = 0.01*x, -0.02, 0.03*y\n"
             "  set Curvature = 0.3, 0.2*x, -0.1\n"
             "  set Direction = 1, 0.5, 0\n  set Temperature = 2 + x\n"
             " end\nend\nsubsection Foundation\n"
             " set Normal stiffness = 1 + x^2\n"
             " set Tangential stiffness = 0.7\n set Tension free = above\n"
             "end\n");

const std::string uniform =
  grown_text("alpha1 = 1e-2, alpha2 = 1e-2",
             "  set Strain = 0.01, -0.02, 0.03\n"
             "  set Curvature = 0.3, 0.2, -0.1\n  set Temperature = 2\n"
             " end\nend\n");

struct GrownShell : NoParameters
{
  GrownShell(const std::string    &text,
             const Mesh           &mesh,
             const KinematicsModel model)
    : discretization(make_discretization(mesh, lagrange(2)))
  {
    ParameterAcceptor::declare_all_parameters();
    ParameterAcceptor::prm.parse_input_from_string(text);
    ParameterAcceptor::parse_all_parameters();
    section.prepare({});
    springs = foundation.make({}, MeshRegions());
    ShellParts parts(section,
                     conditions,
                     loads,
                     {MembraneStrain::tied,
                      EdgeForm::rotation_jump,
                      model,
                      TangentType::consistent},
                     7.);
    parts.foundation = &springs;
    assembly         = std::make_unique<Assembly>(*discretization, parts);
    none.close();
  }

  ShellSection                    section;
  FoundationParameters            foundation;
  Foundation                      springs;
  BoundaryConditions              conditions;
  Loads                           loads;
  std::unique_ptr<Discretization> discretization;
  std::unique_ptr<Assembly>       assembly;
  AffineConstraints<double>       none;
};

/** w = -(kappa0 : x x)/2 and the strains E0 leave no force and no energy. */
void
test_free_growth()
{
  const GrownShell shell(uniform,
                         make_mesh([](const Point<3> &x) {
                           return Point<3>(x[0], x[1] + 0.2 * x[0], 0.);
                         }),
                         KinematicsModel::linear);
  const auto     u = interpolate(*shell.discretization, [](const Point<3> &x) {
    return Vector3(
      {0.03 * x[0] + 0.03 * x[1],
       0.03 * x[0],
       -0.5 * (0.35 * x[0] * x[0] + 0.25 * x[1] * x[1]) + 0.1 * x[0] * x[1]});
  });
  TrilinosVector force(u), held(u), zero(u);
  zero = 0.;
  shell.assembly->residual(zero, held);
  const double energy = shell.assembly->residual(u, force).total();
  check_below("free growth: force",
              force.linfty_norm() / held.linfty_norm(),
              1e-12);
  check_below("free growth: energy",
              std::abs(energy) / shell.assembly->energies(zero).total(),
              1e-12);
}

void
test(const KinematicsModel model)
{
  const std::string name =
    model == KinematicsModel::finite ? "finite: " : "linear: ";
  auto mesh    = make_mesh(bend);
  mesh.refined = {1, 5};
  std::swap(mesh.cells[2][1], mesh.cells[2][2]);
  const GrownShell shell(strange, mesh, model);
  TrilinosVector   u = interpolate(*shell.discretization, some_field);
  u *= 0.4;
  const auto    &hanging = shell.discretization->node_constraints();
  TrilinosVector direction(u);
  for (unsigned int i = 0; i < u.size(); ++i)
    direction(i) = std::sin(3. * i + 1.);
  direction.compress(VectorOperation::insert);
  hanging.distribute(direction);
  const auto moved = [&](const double step) {
    TrilinosVector result(u);
    result.add(step, direction);
    return result;
  };
  const auto residual = [&](const double step) {
    TrilinosVector force(u);
    shell.assembly->residual(moved(step), force);
    return force;
  };
  const auto energy = [&](const double step) {
    return shell.assembly->energies(moved(step)).total();
  };
  // Central differences of two steps, extrapolated: an error of step^4
  const double s = 2e-4;
  const double slope =
    (8. * (energy(s) - energy(-s)) - (energy(2. * s) - energy(-2. * s))) /
    (12. * s);
  const double expected = residual(0.) * direction;
  check_below(name + "force by differences of the energy",
              std::abs(slope / expected - 1.),
              1e-8);
  TrilinosVector slopes = residual(s);
  slopes.add(-1., residual(-s));
  slopes *= 8.;
  slopes.add(-1., residual(2. * s), 1., residual(-2. * s));
  slopes /= 12. * s;
  // At the dofs that are free, where hanging nodes follow
  TrilinosWrappers::SparseMatrix matrix;
  TrilinosVector                 unused(u), product(u);
  shell.assembly->reinit_matrix(shell.none, matrix);
  shell.assembly->assemble(u, shell.none, matrix, unused);
  matrix.vmult(product, direction);
  slopes.add(-1., product);
  const auto condensed_norm = [&](const TrilinosVector &v) {
    std::vector<double> sums(v.size());
    for (unsigned int i = 0; i < v.size(); ++i)
      if (!hanging.is_constrained(i))
        sums[i] += v(i);
      else
        for (const auto &[k, weight] : *hanging.get_constraint_entries(i))
          sums[k] += weight * v(i);
    double largest = 0.;
    for (const double sum : sums)
      largest = std::max(largest, std::abs(sum));
    return largest;
  };
  check_below(name + "tangent by differences of the force",
              condensed_norm(slopes) / condensed_norm(product),
              1e-8);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_free_growth();
  test(KinematicsModel::linear);
  test(KinematicsModel::finite);
  return n_failures > 0;
}
