// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The energy-momentum forces of a step: they do the work that the strain
// energy changes by, and have neither a resultant nor a moment at the mean
// positions, however large the step is. A pressure that follows does the work
// p Delta V.

#include "../forms/corotational_shell.h"

#include <set>

/** A rotation by @p angle about (1, 2, -1) with some bending and stretch. */
VectorField
large_motion(const double angle, const double strain)
{
  return [=](const Point<3> &X) {
    const Vector3 X0(X);
    const Vector3 k = Vector3({1., 2., -1.}) / std::sqrt(6.);
    const Vector3 x = std::cos(angle) * X0 +
                      std::sin(angle) * cross_product_3d(k, X0) +
                      (1. - std::cos(angle)) * (k * X0) * k;
    return Vector3(x - X0 + strain * some_field(X));
  };
}

/** Moment of @p force about the origin at the positions X + u. */
Vector3
moment(const Discretization &discretization,
       const TrilinosVector &u,
       const TrilinosVector &force)
{
  const auto                          &node_dofs = discretization.node_dofs();
  std::vector<types::global_dof_index> dofs(node_dofs.size());
  std::set<types::global_dof_index>    visited;
  Vector3                              sum;
  for (const auto &cell : discretization.dof_handler().active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const auto nodes = discretization.node_positions(cell);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        if (visited.insert(dofs[node_dofs[3 * a]]).second)
          {
            Vector3 x(nodes[a]), f;
            for (unsigned int c = 0; c < 3; ++c)
              {
                x[c] += u(dofs[node_dofs[3 * a + c]]);
                f[c] = force(dofs[node_dofs[3 * a + c]]);
              }
            sum += cross_product_3d(x, f);
          }
    }
  return sum;
}

/** The forces of a step, and what they are compared with. */
struct Step
{
  Step(const Discretization &discretization,
       const Assembly       &assembly,
       const TrilinosVector &u_start,
       const TrilinosVector &u_end,
       const StepStart      &start,
       const ShellActions   &actions = {})
    : force(zero_vector(discretization))
    , mean(u_start)
    , change(u_end)
  {
    mean.sadd(0.5, 0.5, u_end);
    change -= u_start;
    const MassTerms mass(discretization);
    const auto      rest = zero_vector(discretization);
    const Inertia   inertia{mass, rest, 0., &start};
    assembly.residual(mean, actions, force, &inertia);
    work = force * change;
  }

  TrilinosVector force, mean, change;
  double         work;
};

void
check_free(const std::string    &name,
           const Discretization &discretization,
           const Assembly       &assembly)
{
  for (const double angle : {0.3, 1.5})
    {
      const auto u_start = interpolate(discretization, large_motion(0.4, 0.05));
      const auto u_end =
        interpolate(discretization, large_motion(0.4 + angle, -0.1));
      const Step step(discretization, assembly, u_start, u_end, {u_start, {}});
      const double U_start = assembly.energies(u_start).total();
      const double U_end   = assembly.energies(u_end).total();
      const auto   text    = name + ", turned by " + std::to_string(angle);
      check_below(text + ": work",
                  std::abs(step.work - (U_end - U_start)) / (U_start + U_end),
                  1e-12);
      Vector3    resultant;
      const auto translation = [&](const unsigned int c) {
        return interpolate(discretization, [c](const Point<3> &) {
          Vector3 e;
          e[c] = 1.;
          return e;
        });
      };
      for (unsigned int c = 0; c < 3; ++c)
        resultant[c] = step.force * translation(c);
      check_below(text + ": resultant",
                  resultant.norm() / step.force.l1_norm(),
                  1e-13);
      check_below(text + ": moment",
                  moment(discretization, step.mean, step.force).norm() /
                    step.force.l1_norm(),
                  1e-13);
    }
}

/** A crease, neighbours of opposite orientation, hanging nodes. */
void
test_free_shells()
{
  const Parameters parameters(section_text(100., 0.3, 0.2));
  Mesh             mesh;
  for (const double y : {0., 0.9, 2.})
    {
      mesh.vertices.emplace_back(-1. + 0.1 * y, y, 0.);
      mesh.vertices.emplace_back(0., y, 0.);
      mesh.vertices.emplace_back(std::cos(1.2), 1.1 * y, std::sin(1.2));
    }
  mesh.cells = {{{0, 1, 3, 4}}, {{1, 4, 2, 5}}, {{3, 4, 6, 7}}, {{4, 5, 7, 8}}};
  mesh.map   = bend;
  for (const auto &[element, strain] :
       {std::make_pair(Element{ElementType::lagrange, 2}, MembraneStrain::tied),
        std::make_pair(Element{ElementType::lagrange, 3},
                       MembraneStrain::reduced),
        std::make_pair(serendipity, MembraneStrain::reduced),
        std::make_pair(triangle, MembraneStrain::tied)})
    {
      mesh.refined.clear();
      if (element.type != ElementType::triangle)
        mesh.refined = {0};
      const auto discretization = make_discretization(mesh, element);
      for (const auto model :
           {KinematicsModel::corotational, KinematicsModel::finite})
        {
          KinematicsOptions options = corotational(strain);
          options.model             = model;
          check_free(case_name(element, strain) + name_of(model),
                     *discretization,
                     Assembly(*discretization,
                              ShellParts(parameters.section,
                                         parameters.conditions,
                                         parameters.loads,
                                         options,
                                         10.)));
        }
    }
}

/** A support that turns does the rest of the work. */
void
test_prescribed_rotation(const KinematicsModel model)
{
  const Shell shell(
    "subsection Mid-surface\n set Surface = expression\n"
    " set Subdivisions = 2, 2\n subsection expression\n"
    "  set Position = u, v + 0.2*v^2, 0.3*u^2 - 0.3*u*v\n"
    "  set Range u = -1, 1\n  set Range v = 0, 1\n"
    " end\nend\n" +
      edges_parameter +
      "v=0: rotation = 0.4*t + x*t; u=1: rotation = 0.2\nend\n" +
      section_text(100., 0.3, 0.2),
    {ElementType::lagrange, 2});
  KinematicsOptions options(corotational(MembraneStrain::tied));
  options.model         = model;
  const auto   assembly = shell.make_operator(options);
  const auto   u_start  = interpolate(*shell.discretization, [](const auto &X) {
    return 0.1 * some_field(X);
  });
  const auto   u_end    = interpolate(*shell.discretization, [](const auto &X) {
    return -0.2 * some_field(X);
  });
  const auto   before   = assembly->actions({0.5, 1.});
  const auto   after    = assembly->actions({1.5, 1.});
  const double U_start  = assembly->energies(u_start, before).total();
  const double U_end    = assembly->energies(u_end, after).total();
  const StepStart start{u_start, before.rotations};
  const Step      step(*shell.discretization,
                  *assembly,
                  u_start,
                  u_end,
                  start,
                  after);
  const double    rotation_work =
    assembly->rotation_conditions().work(start, u_end, after);
  const auto name = name_of(model) + ": prescribed rotation";
  check_below(name + ": work",
              std::abs(step.work + rotation_work - (U_end - U_start)) /
                (U_start + U_end),
              1e-12);
  check_above(name + ": the support's part of it",
              std::abs(rotation_work) / (U_start + U_end),
              1e-2);
}

/** The volume of a closed surface, 1/3 int x . n dA. */
void
test_following_pressure()
{
  const std::string text = "subsection Mid-surface\n set Surface = sphere\n"
                           " set Subdivisions = 2\nend\n"
                           "subsection Loads\n set Pressure = 2\n"
                           " set Pressure follows = true\nend\n";
  const Shell       shell(text, {ElementType::lagrange, 2});
  const auto assembly = shell.make_operator(corotational(MembraneStrain::tied));
  const auto volume_times_pressure = [&](const TrilinosVector &u) {
    TrilinosVector x = interpolate(*shell.discretization,
                                   [](const auto &X) { return Vector3(X); });
    x += u;
    TrilinosVector force(x);
    assembly->loads(u, force);
    return force * x / 3.;
  };
  const auto u_start =
    interpolate(*shell.discretization, large_motion(0.2, 0.2));
  const auto u_end =
    interpolate(*shell.discretization, large_motion(1.1, -0.2));
  TrilinosVector mean(u_start), change(u_end), force(u_start);
  mean.sadd(0.5, 0.5, u_end);
  change -= u_start;
  const StepStart step_start{u_start, {}};
  assembly->loads(mean, force, Instant(), &step_start);
  const double start = volume_times_pressure(u_start);
  check_below(
    "following pressure: work",
    std::abs(force * change - (volume_times_pressure(u_end) - start)) / start,
    1e-12);
}

int
main(int argc, char *argv[])
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_free_shells();
  test_prescribed_rotation(KinematicsModel::corotational);
  test_prescribed_rotation(KinematicsModel::linear);
  test_prescribed_rotation(KinematicsModel::finite);
  test_following_pressure();
  return n_failures > 0;
}
