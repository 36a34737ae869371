// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// A section whose law isn't linear, in finite rotations and in small
// displacements: forces are the gradient of the energy, the tangent is
// symmetric and exact but for the third derivatives of the section's energy at
// edges that bend.

#include "finite_shell.h"
#include "power_section.h"

#include <random>

/** A law of a linear one, no conditions and no loads. */
struct PowerParameters
{
  PowerParameters(const double beta, const bool has_memory = false)
    : section(beta, has_memory, 100., 0.3, 0.2)
  {}

  PowerSection<LinearElasticSection> section;
  BoundaryConditions                 conditions;
  Loads                              loads;
};

template <typename AnyParameters>
Assembly
make_assembly(const Discretization &discretization,
              const AnyParameters  &parameters,
              const KinematicsModel model  = KinematicsModel::finite,
              const MembraneStrain  strain = MembraneStrain::tied)
{
  KinematicsOptions options = finite(strain);
  options.model             = model;
  return Assembly(discretization,
                  ShellParts(parameters.section,
                             parameters.conditions,
                             parameters.loads,
                             options,
                             7.));
}

/** Of order one, and noise; hanging nodes follow. */
TrilinosVector
direction(const Discretization &discretization, const unsigned int seed)
{
  auto                                   v = zero_vector(discretization);
  std::mt19937                           generator(seed);
  std::uniform_real_distribution<double> noise(-1., 1.);
  for (unsigned int i = 0; i < v.size(); ++i)
    v(i) = noise(generator);
  v.compress(VectorOperation::insert);
  discretization.node_constraints().distribute(v);
  return v;
}

/** By central differences of the order 8 along @p v. */
template <typename Value>
Value
derivative(const TrilinosVector                               &u,
           const TrilinosVector                               &v,
           const std::function<Value(const TrilinosVector &)> &function)
{
  constexpr double                h = 1e-4;
  constexpr std::array<double, 4> weights{
    {4. / 5., -1. / 5., 4. / 105., -1. / 280.}};
  Value sum = function(u);
  sum *= 0.;
  for (unsigned int k = 0; k < weights.size(); ++k)
    for (const double sign : {1., -1.})
      {
        TrilinosVector place(u);
        place.add(sign * (k + 1) * h, v);
        Value value = function(place);
        value *= sign * weights[k] / h;
        sum += value;
      }
  return sum;
}

TrilinosVector
force_at(const Assembly &assembly, const TrilinosVector &u)
{
  TrilinosVector force(u);
  assembly.residual(u, force);
  return force;
}

void
test_gradient(const std::string    &name,
              const Discretization &discretization,
              const Assembly       &assembly,
              const TrilinosVector &u)
{
  const auto force = force_at(assembly, u);
  double     error = 0., scale = 0.;
  for (unsigned int seed = 1; seed <= 3; ++seed)
    {
      const auto   v    = direction(discretization, seed);
      const double work = force * v;
      error =
        std::max(error,
                 std::abs(
                   derivative<double>(u,
                                      v,
                                      [&](const auto &w) {
                                        return assembly.energies(w).total();
                                      }) -
                   work));
      scale = std::max(scale, std::abs(work));
    }
  check_below(name + "force is the gradient of the energy",
              error / scale,
              1e-10);
}

/** K v of a condensed @p matrix, at the dofs that aren't constrained. */
Vector<double>
product(const Discretization     &discretization,
        const FullMatrix<double> &matrix,
        const TrilinosVector     &v)
{
  const auto    &constraints = discretization.node_constraints();
  Vector<double> result(v.size());
  for (unsigned int i = 0; i < v.size(); ++i)
    for (unsigned int j = 0; j < v.size(); ++j)
      if (!constraints.is_constrained(i) && !constraints.is_constrained(j))
        result[i] += matrix(i, j) * v(j);
  return result;
}

/** |K v - dF(v)| / |dF(v)|, and whether K is symmetric. */
double
tangent_error(const std::string    &name,
              const Discretization &discretization,
              const Assembly       &assembly,
              const TrilinosVector &u)
{
  const auto &constraints = discretization.node_constraints();
  const auto  matrix =
    dense_tangent(discretization, assembly, u, constraints).first;
  FullMatrix<double> transposed(matrix);
  transposed.copy_transposed(matrix);
  check_below(name + "symmetry of the tangent",
              relative_difference(matrix, transposed),
              1e-12);
  const auto v = direction(discretization, 5);
  const auto exact =
    derivative<TrilinosVector>(u, v, [&](const TrilinosVector &w) {
      return force_at(assembly, w);
    });
  // Forces of hanging nodes are those of the nodes that they follow.
  const auto free_entries = [&](const auto &full) {
    Vector<double> result(full.size());
    for (unsigned int i = 0; i < full.size(); ++i)
      if (!constraints.is_constrained(i))
        result[i] += full(i);
      else
        for (const auto &[j, weight] : *constraints.get_constraint_entries(i))
          result[j] += weight * full(i);
    return result;
  };
  Vector<double>       found    = product(discretization, matrix, v);
  const Vector<double> expected = free_entries(exact);
  found -= expected;
  return found.l2_norm() / expected.l2_norm();
}

/** Linear strains don't see a small rotation v, whatever the strains: K v. */
void
test_small_rotation(const std::string    &name,
                    const Discretization &discretization,
                    const Assembly       &assembly,
                    const TrilinosVector &u)
{
  const auto matrix = dense_tangent(discretization,
                                    assembly,
                                    u,
                                    discretization.node_constraints())
                        .first;
  const auto v = interpolate(discretization, [](const Point<3> &x) {
    return cross_product_3d(Vector3{{0.3, -0.5, 0.8}}, Vector3(x));
  });
  check_below(name + "a small rotation has no stiffness",
              product(discretization, matrix, v).l2_norm() /
                (matrix.frobenius_norm() * v.l2_norm()),
              1e-12);
}

/** A creased and curved mesh, hanging nodes, opposite orientations. */
void
test_difficult_mesh(const double beta, const KinematicsModel model)
{
  const PowerParameters parameters(beta);
  for (unsigned int degree = 2;
       degree <= (model == KinematicsModel::linear ? 2 : 3);
       ++degree)
    {
      const auto discretization =
        make_discretization(difficult_mesh(true), degree);
      const auto assembly = make_assembly(*discretization, parameters, model);
      auto       u        = interpolate(*discretization, some_field);
      u.add(0.05, direction(*discretization, 3));
      const std::string name =
        name_of(model) + ", p = " + std::to_string(degree) + ": ";
      test_gradient(name, *discretization, assembly, u);
      const double missing = tangent_error(name, *discretization, assembly, u);
      check_above(name + "third derivatives that edges leave out",
                  missing,
                  1e-5);
      if (model == KinematicsModel::linear)
        test_small_rotation(name, *discretization, assembly, u);
      else
        check_below(name + "rigid motion",
                    relative_force(*discretization,
                                   assembly,
                                   rigid_motion(Vector3{{1.9, -1.2, 0.8}},
                                                Vector3{{0.3, -2., 1.}})),
                    1e-12);
    }
}

/** Edges without a jump of rotations leave nothing out. */
void
test_smooth_field(const double beta, const KinematicsModel model)
{
  const PowerParameters parameters(beta);
  Mesh                  mesh = difficult_mesh(false);
  mesh.map                   = [](const Point<3> &x) { return x; };
  // Cells of parallels: a quadratic field of the plane is one of the element.
  for (unsigned int i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i] = {i % 3 + 0.2 * (i / 3), 0.9 * (i / 3), 0.};
  const auto discretization = make_discretization(mesh, 2);
  const auto assembly       = make_assembly(*discretization, parameters, model);
  const auto u           = interpolate(*discretization, [](const Point<3> &x) {
    return Vector3{{0.2 * x[0] * x[1],
                    0.1 * x[0] * x[0] - 0.2 * x[1],
                    0.4 * x[0] * x[0] - 0.3 * x[0] * x[1] + 0.2 * x[1]}};
  });
  const std::string name = name_of(model) + ", smooth: ";
  check_below(name + "tangent is the derivative of the force",
              tangent_error(name, *discretization, assembly, u),
              1e-10);
}

/** The energies, the force at @p u and the matrix of an assembly. */
struct Answer
{
  template <typename AnyParameters>
  Answer(const Discretization &discretization,
         const AnyParameters  &parameters,
         const KinematicsModel model,
         const MembraneStrain  strain,
         const TrilinosVector &u)
  {
    const auto assembly =
      make_assembly(discretization, parameters, model, strain);
    energies = assembly.energies(u);
    force    = force_at(assembly, u);
    tangent  = dense_tangent(discretization,
                            assembly,
                            u,
                            discretization.node_constraints())
                .first;
  }

  Energies           energies;
  TrilinosVector     force;
  FullMatrix<double> tangent;
};

/**
 * With beta = 0 the law is linear: FiniteKinematics and, in small
 * displacements, LinearKinematics as before.
 */
void
test_linear_limit(const KinematicsModel model, const MembraneStrain strain)
{
  const auto discretization = make_discretization(difficult_mesh(true), 2);
  const auto u              = interpolate(*discretization, some_field);
  const auto answer         = [&](const auto &parameters) {
    return Answer(*discretization, *parameters, model, strain, u);
  };
  // One object with parameters at a time
  Answer linear =
    answer(std::make_unique<Parameters>(section_text(100., 0.3, 0.2)));
  const Answer power  = answer(std::make_unique<PowerParameters>(0.));
  const double scale  = linear.force.linfty_norm();
  const double energy = linear.energies.total();
  linear.force -= power.force;
  const std::string name =
    "linear limit, " + name_of(model) + ", " + name_of(strain) + ": ";
  check_below(name + "forces", linear.force.linfty_norm() / scale, 1e-12);
  check_below(name + "energies",
              (std::abs(power.energies.membrane - linear.energies.membrane) +
               std::abs(power.energies.bending - linear.energies.bending) +
               std::abs(power.energies.edge - linear.energies.edge)) /
                energy,
              1e-12);
  check_below(name + "tangent",
              relative_difference(power.tangent, linear.tangent),
              1e-12);
}

void
test_memory(const double beta)
{
  const PowerParameters parameters(beta, true);
  const auto discretization = make_discretization(difficult_mesh(true), 2);
  const auto assembly       = make_assembly(*discretization, parameters);
  const auto u              = interpolate(*discretization, some_field);
  const auto at_end         = force_at(assembly, u);
  assembly.update_section_states(u, assembly.actions(Instant()));
  auto difference = force_at(assembly, u);
  difference -= at_end;
  check_below("memory: the end of a step is the start of the next",
              difference.linfty_norm() / at_end.linfty_norm(),
              1e-12);
  TrilinosVector part(u);
  part *= 0.8;
  test_gradient("memory, unloaded: ", *discretization, assembly, part);
  tangent_error("memory, unloaded: ", *discretization, assembly, part);
}

void
test_refusal()
{
  const PowerParameters parameters(1.);
  const auto discretization = make_discretization(difficult_mesh(true), 2);
  bool       refused        = false;
  try
    {
      make_kinematics(*discretization,
                      parameters.section,
                      {MembraneStrain::tied,
                       EdgeForm::rotation_jump,
                       KinematicsModel::corotational,
                       TangentType::symmetric});
    }
  catch (const ExceptionBase &error)
    {
      refused =
        std::string(error.what()).find("choose finite") != std::string::npos;
    }
  check_above("corotational kinematics refuse the law", refused, 0.5);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_linear_limit(KinematicsModel::finite, MembraneStrain::tied);
  test_linear_limit(KinematicsModel::linear, MembraneStrain::tied);
  test_linear_limit(KinematicsModel::linear, MembraneStrain::full);
  for (const auto model : {KinematicsModel::finite, KinematicsModel::linear})
    {
      test_difficult_mesh(2e-3, model);
      test_smooth_field(0.05, model);
    }
  test_memory(2e-3);
  test_refusal();
  return n_failures > 0;
}
