// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Sections with coupling in large rotations: no force under rigid motions, the
// linear matrix at rest, the tangent by differences of the forces, and the same
// body whatever the numbering of cells.

#include "laminate_mesh.h"
#include "laminate_parameters.h"
#include <nacre/forms/mass_terms.h>

using namespace Tests;

KinematicsOptions
options(const MembraneStrain strain, const KinematicsModel model)
{
  return {strain, EdgeForm::rotation_jump, model, TangentType::consistent};
}

/** A shell of six cells with a laminate that couples everything. */
struct Shell
{
  Shell(const Mesh &mesh, const Element &element, const KinematicsModel model)
    : parameters(coupled_stack)
    , discretization(make_discretization(mesh, element))
    , assembly(*discretization,
               ShellParts(parameters.section,
                          parameters.conditions,
                          parameters.loads,
                          options(default_membrane_strain(element.type), model),
                          7.))
  {
    none.close();
  }

  FullMatrix<double>
  tangent(const TrilinosVector &u) const
  {
    TrilinosWrappers::SparseMatrix matrix;
    TrilinosVector                 force(u);
    assembly.reinit_matrix(none, matrix);
    assembly.assemble(u, none, matrix, force);
    FullMatrix<double> K(matrix.m(), matrix.n());
    for (unsigned int i = 0; i < K.m(); ++i)
      for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
        K(i, entry->column()) = entry->value();
    return K;
  }

  TrilinosVector
  residual(const TrilinosVector &u) const
  {
    TrilinosVector force(u);
    assembly.residual(u, force);
    return force;
  }

  LaminateParameters              parameters;
  std::unique_ptr<Discretization> discretization;
  Assembly                        assembly;
  AffineConstraints<double>       none;
};

/** Turns about an axis by 2 rad, and moves. */
Vector3
rigid_motion(const Point<3> &x)
{
  const Vector3 axis = Vector3({1., -2., 0.5}) / std::sqrt(5.25);
  const double  c = std::cos(2.), s = std::sin(2.);
  const Vector3 turned = c * x + s * cross_product_3d(axis, Vector3(x)) +
                         ((1. - c) * (axis * x)) * axis;
  return turned - x + Vector3({0.3, 1., -2.});
}

std::string
label(const KinematicsModel model, const std::string &mesh, const Element &cell)
{
  return (model == KinematicsModel::finite ? "finite, " : "") + mesh + ", " +
         label(cell);
}

void
test_element(const KinematicsModel model,
             const std::string    &name,
             const Mesh           &mesh,
             const Element        &element)
{
  const std::string  full_name = label(model, name, element) + ": ";
  FullMatrix<double> linear;
  {
    const Shell    shell(mesh, element, KinematicsModel::linear);
    TrilinosVector u = interpolate(*shell.discretization, some_field);
    u                = 0.;
    linear           = shell.tangent(u);
  }
  const Shell    shell(mesh, element, model);
  TrilinosVector u = interpolate(*shell.discretization, some_field);
  TrilinosVector rest(u);
  rest = 0.;
  check_below(full_name + "tangent at rest",
              relative_difference(shell.tangent(rest), linear),
              1e-13);
  const double size =
    linear.linfty_norm() *
    interpolate(*shell.discretization, rigid_motion).linfty_norm();
  check_below(full_name + "force of a rigid motion",
              shell.residual(interpolate(*shell.discretization, rigid_motion))
                  .linfty_norm() /
                size,
              1e-13);

  // Displacements of the size of the cells, in a direction of many
  u *= 0.4;
  const auto     K = shell.tangent(u);
  TrilinosVector direction(u);
  for (unsigned int i = 0; i < u.size(); ++i)
    direction(i) = std::sin(3. * i + 1.);
  direction.compress(VectorOperation::insert);
  shell.discretization->node_constraints().distribute(direction);
  // Central differences of two steps, extrapolated: an error of step^4
  const auto slope = [&](const double step) {
    TrilinosVector plus(u), minus(u);
    plus.add(step, direction);
    minus.add(-step, direction);
    TrilinosVector difference = shell.residual(plus);
    difference.add(-1., shell.residual(minus));
    difference /= 2. * step;
    return difference;
  };
  TrilinosVector slopes = slope(1e-4);
  slopes *= 4. / 3.;
  slopes.add(-1. / 3., slope(2e-4));
  // At the dofs that are free: the angle at an edge is one of surfaces that
  // meet there, and so are its derivatives.
  std::vector<double> error(u.size()), size_of(u.size());
  const auto         &constraints = shell.discretization->node_constraints();
  for (unsigned int i = 0; i < u.size(); ++i)
    {
      double sum = 0.;
      for (unsigned int j = 0; j < u.size(); ++j)
        sum += K(i, j) * direction(j);
      const auto add = [&](const unsigned int k, const double weight) {
        error[k] += weight * (sum - slopes(i));
        size_of[k] += weight * sum;
      };
      if (!constraints.is_constrained(i))
        add(i, 1.);
      else
        for (const auto &[k, weight] : *constraints.get_constraint_entries(i))
          add(k, weight);
    }
  const auto largest = [](const std::vector<double> &values) {
    double result = 0.;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  };
  check_below(full_name + "tangent by differences",
              largest(error) / largest(size_of),
              1e-8);
}

/**
 * The energy-momentum forces of a large step do the work that the strain energy
 * changes by; the work on a rigid translation is zero, and on the rotation
 * about the mean positions, v = axis x (x + u_mean).
 */
void
test_step(const KinematicsModel model,
          const std::string    &name,
          const Mesh           &mesh,
          const Element        &element)
{
  const std::string full_name = label(model, name, element) + ", step: ";
  const Shell       shell(mesh, element, model);
  const auto       &discretization = *shell.discretization;
  const auto     u_start = interpolate(discretization, [](const Point<3> &x) {
    return 0.2 * some_field(x);
  });
  const auto     u_end   = interpolate(discretization, [](const Point<3> &x) {
    return rigid_motion(x) - 0.3 * some_field(x);
  });
  TrilinosVector mean(u_start), change(u_end), force(u_start);
  mean.sadd(0.5, 0.5, u_end);
  change -= u_start;
  const MassTerms mass(discretization);
  TrilinosVector  zero(u_start);
  zero = 0.;
  const StepStart start{u_start, {}};
  const Inertia   inertia{mass, zero, 0., &start};
  shell.assembly.residual(mean,
                          shell.assembly.actions(Instant()),
                          force,
                          &inertia);
  const double U_start = shell.assembly.energies(u_start).total();
  const double U_end   = shell.assembly.energies(u_end).total();
  check_below(full_name + "work",
              std::abs(force * change - (U_end - U_start)) / (U_start + U_end),
              1e-12);
  const auto translation = interpolate(discretization, [](const Point<3> &) {
    return Vector3({1., -2., 0.5});
  });
  check_below(full_name + "resultant",
              std::abs(force * translation) / force.l1_norm(),
              1e-13);
  // A linear map of the nodes' positions
  TrilinosVector rotation(mean);
  rotation.add(1., interpolate(discretization, [](const Point<3> &x) {
                 return Vector3(x);
               }));
  std::vector<types::global_dof_index> dofs(discretization.node_dofs().size());
  TrilinosVector                       turned(rotation);
  for (const auto &cell : discretization.dof_handler().active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int a = 0; a < dofs.size() / 3; ++a)
        {
          Vector3 x;
          for (unsigned int c = 0; c < 3; ++c)
            x[c] = rotation(dofs[discretization.node_dofs()[3 * a + c]]);
          const auto v = cross_product_3d(Vector3({1., -2., 0.5}), x);
          for (unsigned int c = 0; c < 3; ++c)
            turned(dofs[discretization.node_dofs()[3 * a + c]]) = v[c];
        }
    }
  turned.compress(VectorOperation::insert);
  check_below(full_name + "moment",
              std::abs(force * turned) / force.l1_norm(),
              1e-12);
}

void
test_orientation(const KinematicsModel model, const Element &element)
{
  const auto energy_on = [&](const Mesh &mesh) {
    const Shell    shell(mesh, element, model);
    TrilinosVector u = interpolate(*shell.discretization, some_field);
    u *= 0.4;
    return shell.assembly.energies(u).total();
  };
  const auto   mesh   = make_mesh(bend);
  const double energy = energy_on(mesh);
  for (const unsigned int n : {1, 6})
    {
      auto swapped = mesh;
      for (unsigned int k = 0; k < n; ++k)
        std::swap(swapped.cells[k][1], swapped.cells[k][2]);
      check_below(label(model,
                        std::to_string(n) + " cells of the other orientation",
                        element),
                  std::abs(energy_on(swapped) / energy - 1.),
                  1e-12);
    }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto model :
       {KinematicsModel::corotational, KinematicsModel::finite})
    {
      const std::vector<Element> elements{lagrange(2),
                                          lagrange(3),
                                          serendipity,
                                          triangle};
      for (const auto &element : elements)
        test_element(model, "curved", make_mesh(bend), element);
      test_element(model, "creased", make_mesh(fold), lagrange(2));
      auto hanging    = make_mesh(bend);
      hanging.refined = {1, 5};
      std::swap(hanging.cells[2][1], hanging.cells[2][2]);
      test_element(model, "hanging", hanging, lagrange(2));
      test_orientation(model, lagrange(2));
      for (const auto &element : elements)
        test_step(model, "curved", make_mesh(bend), element);
      test_step(model, "creased", make_mesh(fold), lagrange(2));
    }
  return n_failures > 0;
}
