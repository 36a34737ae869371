// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Initial strains of a laminate that couples everything, and a foundation that
// doesn't pull: the forces are the gradient of the energy and the tangent is
// their derivative, by differences, on a mesh with hanging nodes and a cell of
// the other orientation; the forces of a step do the work that the energy
// changes by. A plate that takes its initial strains has no forces.

#include "../laminates/laminate_mesh.h"
#include <nacre/mechanics/shell_section.h>
#include <nacre/problem/foundation.h>

using namespace Tests;

const std::string coupled   = "[0/90/30]";
const std::string symmetric = "[0/90]s";

/** A laminate with initial strains, on a foundation. */
std::string
grown_text(const std::string &stack,
           const std::string &alphas,
           const std::string &others)
{
  return "subsection Section\n set Type = laminate\n subsection Laminate\n"
         "  set Materials = ply: E1 = 25, E2 = 1, nu12 = 0.25, G12 = 0.5, " +
         alphas + "\n  set Stack = " + stack +
         "\n  set Thickness = 0.3\n"
         "  set Material direction = 1, 0.3, 0.2\n"
         "  set Top = 0.1, 0.2, 1\n end\n subsection Initial strain\n"
         "  set Temperature gradient = 5\n" +
         others;
}

std::string
strange(const std::string &stack)
{
  return grown_text(stack,
                    "alpha1 = -1e-3, alpha2 = 2e-2",
                    "  set Strain = 0.01*x, -0.02, 0.03*y\n"
                    "  set Curvature = 0.3, 0.2*x, -0.1\n"
                    "  set Direction = 1, 0.5, 0\n  set Temperature = 2 + x\n"
                    " end\nend\nsubsection Foundation\n"
                    " set Normal stiffness = 1 + x^2\n"
                    " set Tangential stiffness = 0.7\n"
                    " set Tension free = above\nend\n");
}

std::string
uniform(const std::string &stack)
{
  return grown_text(stack,
                    "alpha1 = 1e-2, alpha2 = 1e-2",
                    "  set Strain = 0.01, -0.02, 0.03\n"
                    "  set Curvature = 0.3, 0.2, -0.1\n  set Temperature = 2\n"
                    " end\nend\n");
}

KinematicsOptions
options_of(const KinematicsModel model,
           const MembraneStrain  strain = MembraneStrain::tied,
           const EdgeForm        form   = EdgeForm::rotation_jump)
{
  return {strain, form, model, TangentType::consistent};
}

struct GrownShell : NoParameters
{
  GrownShell(const std::string       &text,
             const Mesh              &mesh,
             const KinematicsOptions &options)
    : discretization(make_discretization(mesh, lagrange(2)))
  {
    read_text(text);
    law     = section.make({}, {}, MeshRegions());
    springs = foundation.make({}, MeshRegions());
    ShellParts parts(*law, conditions, loads, options, 7.);
    parts.foundation = &springs;
    assembly         = std::make_unique<Assembly>(*discretization, parts);
    none.close();
  }

  ShellSectionParameters            section;
  std::shared_ptr<const SectionLaw> law;
  FoundationParameters              foundation;
  Foundation                        springs;
  BoundaryConditions                conditions;
  Loads                             loads;
  std::unique_ptr<Discretization>   discretization;
  std::unique_ptr<Assembly>         assembly;
  AffineConstraints<double>         none;
};

/** w = -(kappa0 : x x)/2 and the strains E0 leave no force and no energy. */
void
test_free_growth(const std::string       &name,
                 const std::string       &stack,
                 const KinematicsOptions &options)
{
  const GrownShell shell(uniform(stack),
                         make_mesh([](const Point<3> &x) {
                           return Point<3>(x[0], x[1] + 0.2 * x[0], 0.);
                         }),
                         options);
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
  check_below("free growth, " + name + ": force",
              force.linfty_norm() / held.linfty_norm(),
              1e-12);
  check_below("free growth, " + name + ": energy",
              std::abs(energy) / shell.assembly->energies(zero).total(),
              1e-12);
}

/** Hanging nodes, a cell of the other orientation. */
Mesh
strange_mesh()
{
  auto mesh    = make_mesh(bend);
  mesh.refined = {1, 5};
  std::swap(mesh.cells[2][1], mesh.cells[2][2]);
  return mesh;
}

/** Co-rotational forces are the gradient of no energy. */
void
test(const std::string       &name,
     const std::string       &stack,
     const KinematicsOptions &options)
{
  const GrownShell shell(strange(stack), strange_mesh(), options);
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
  if (options.model != KinematicsModel::corotational)
    check_below(name + ": force by differences of the energy",
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
  check_below(name + ": tangent by differences of the force",
              condensed_norm(slopes) / condensed_norm(product),
              1e-8);
}

void
test_step(const KinematicsModel model, const MembraneStrain strain)
{
  const GrownShell shell(strange(strain == MembraneStrain::tied ? coupled :
                                                                  symmetric),
                         strange_mesh(),
                         options_of(model, strain));
  const auto       field = [&](const double factor) {
    return interpolate(*shell.discretization, [&](const Point<3> &x) {
      return factor * some_field(x);
    });
  };
  const TrilinosVector start = field(0.4), end = field(-0.5);
  TrilinosVector       force(start), change(end), mean(start), rest(start);
  rest = 0.;
  change -= start;
  mean.sadd(0.5, 0.5, end);
  const StepStart    step_start{start, {}};
  const MassTerms    mass(*shell.discretization);
  const Inertia      inertia{mass, rest, 0., &step_start};
  const ShellActions actions{Instant{1.5, 0.7}, {}};
  shell.assembly->residual(mean, actions, force, &inertia);
  const double U_start = shell.assembly->energies(start, actions).total();
  const double U_end   = shell.assembly->energies(end, actions).total();
  check_below(name_of(model) + ", " + name_of(strain) + ": work of a step",
              std::abs(force * change - (U_end - U_start)) / (U_start + U_end),
              1e-12);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                       linear = options_of(KinematicsModel::linear);
  const auto averaged                     = options_of(KinematicsModel::linear,
                                   MembraneStrain::tied,
                                   EdgeForm::averaged_normal);
  const auto reduced =
    options_of(KinematicsModel::linear, MembraneStrain::reduced);
  test_free_growth("tied", coupled, linear);
  test_free_growth("reduced", coupled, reduced);
  test_free_growth("averaged normal", symmetric, averaged);
  test("linear", coupled, linear);
  test("linear, reduced", coupled, reduced);
  test("averaged normal", symmetric, averaged);
  test("finite", coupled, options_of(KinematicsModel::finite));
  const auto corotational = KinematicsModel::corotational;
  test("corotational", coupled, options_of(corotational));
  test("corotational, reduced",
       symmetric,
       options_of(corotational, MembraneStrain::reduced));
  for (const auto model :
       {KinematicsModel::linear, corotational, KinematicsModel::finite})
    for (const auto strain : {MembraneStrain::tied, MembraneStrain::reduced})
      test_step(model, strain);
  return n_failures > 0;
}
