// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Co-rotational kinematics: no force under finite rigid motions, the linear
// form at rest, the consistent tangent against complex steps.

#include "rigid_motions.h"
#include <nacre/forms/corotational_kinematics.h>

#include <complex>
#include <random>

using Complex = std::complex<double>;

const auto none = numbers::invalid_unsigned_int;

double
largest(const TrilinosVector &vector)
{
  return vector.linfty_norm();
}

// --------------------------------------------------------------------- at rest

void
test_linearisation()
{
  for (const auto &element : {Element{ElementType::lagrange, 2},
                              Element{ElementType::lagrange, 3},
                              Element{ElementType::serendipity, 2},
                              Element{ElementType::triangle, 2}})
    for (const auto strain :
         {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
      {
        const Shell shell(creased_text("u=0: clamped; v=0: rotation = 0"),
                          element);
        const auto  name = case_name(element, strain);
        const auto  u    = zero_vector(*shell.discretization);
        const auto  linear =
          dense_tangent(*shell.discretization, *shell.make_operator(strain), u);
        for (const auto tangent :
             {TangentType::frozen, TangentType::consistent})
          {
            const auto [matrix, force] =
              dense_tangent(*shell.discretization,
                            *shell.make_operator(corotational(strain, tangent)),
                            u);
            check_below(name + name_of(tangent) +
                          " tangent at rest is the linear matrix",
                        relative_difference(matrix, linear.first),
                        1e-13);
            check_below(name + "no force at rest",
                        force.linfty_norm() / matrix.linfty_norm(),
                        1e-15);
          }
      }
}

// --------------------------------------------------------------------- tangent

/** The internal forces of the whole shell, by the kernels' templates. */
class ComplexForces
{
public:
  ComplexForces(const Shell &shell, const KinematicsOptions &options)
    : shell_(shell)
    , penalty_(*shell.discretization,
               *shell.section,
               shell.discretization->element().full_quadrature(),
               7.)
    , values_(*shell.discretization,
              cell_quadrature(shell.discretization->element(),
                              options.membrane_strain),
              options.membrane_strain == MembraneStrain::tied)
    , edge_(*shell.discretization)
  {}

  std::vector<Complex>
  at(const std::vector<Complex> &u)
  {
    std::vector<Complex> force(u.size());
    for (const auto &cell :
         shell_.discretization->dof_handler().active_cell_iterators())
      {
        add_cell(cell, u, force);
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              edge_.reinit(cell, f);
              add_boundary(penalty_.boundary(cell),
                           cell->face(f)->boundary_id(),
                           u,
                           force);
            }
          else if (cell < cell->neighbor(f))
            {
              edge_.reinit(cell,
                           f,
                           none,
                           cell->neighbor(f),
                           cell->neighbor_of_neighbor(f),
                           none);
              add_edge(penalty_.interior(cell, cell->neighbor(f)),
                       nullptr,
                       u,
                       force);
            }
      }
    return force;
  }

private:
  void
  add_cell(const DoFHandler<2, 3>::active_cell_iterator &cell,
           const std::vector<Complex>                   &u,
           std::vector<Complex>                         &force)
  {
    values_.reinit_frames(cell);
    CellStiffness stiffness;
    stiffness.reinit(values_, *shell_.section, 1.);
    std::vector<types::global_dof_index> dofs(values_.n_dofs());
    cell->get_dof_indices(dofs);
    const unsigned int   n_nodes = values_.shapes().n_nodes();
    NodeVectors<Complex> local(n_nodes), local_force(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        local[a][c] = u[dofs[values_.dof(a, c)]];
    CorotationalMembrane<Complex> membrane;
    CorotationalBending<Complex>  bending;
    membrane.reinit(values_,
                    membrane_stiffness(values_, stiffness.membrane),
                    local);
    bending.reinit(values_, stiffness.bending, local);
    membrane.add_force(values_, local_force);
    bending.add_force(values_, local_force);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        force[dofs[values_.dof(a, c)]] += local_force[a][c];
  }

  void
  add_boundary(const double                penalty,
               const types::boundary_id    id,
               const std::vector<Complex> &u,
               std::vector<Complex>       &force)
  {
    const auto condition = shell_.conditions->edges().find(id);
    if (condition != shell_.conditions->edges().end() &&
        condition->second.rotation != nullptr)
      add_edge(penalty, condition->second.rotation.get(), u, force);
    const auto moment = shell_.loads->edge_moments().find(id);
    if (moment == shell_.loads->edge_moments().end())
      return;
    const auto               local = edge_nodes(0, u);
    NodeVectors<Complex>     local_force(local.size());
    FollowingMoment<Complex> load;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      {
        load.reinit(edge_, q, moment->second(edge_.point(q)), local);
        load.add_force(edge_, q, local_force);
      }
    add_nodes(0, local_force, force);
  }

  void
  add_edge(const double                penalty,
           const Expression           *rotation,
           const std::vector<Complex> &u,
           std::vector<Complex>       &force)
  {
    std::array<NodeVectors<Complex>, 2> local;
    for (unsigned int s = 0; s < edge_.n_sides(); ++s)
      local[s] = edge_nodes(s, u);
    CorotationalEdgePoint<Complex> point;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      {
        const double angle =
          rotation == nullptr ? 0. : (*rotation)(edge_.point(q));
        point.reinit(edge_, q, *shell_.section, penalty, angle, local);
        for (unsigned int s = 0; s < edge_.n_sides(); ++s)
          {
            NodeVectors<Complex> local_force(local[s].size());
            point.add_force(s, local_force);
            add_nodes(s, local_force, force);
          }
      }
  }

  NodeVectors<Complex>
  edge_nodes(const unsigned int side, const std::vector<Complex> &u) const
  {
    NodeVectors<Complex> nodes(edge_.shapes(side).n_nodes());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        nodes[a][c] = u[edge_.dof_indices()[edge_.dof(side, a, c)]];
    return nodes;
  }

  void
  add_nodes(const unsigned int          side,
            const NodeVectors<Complex> &nodes,
            std::vector<Complex>       &vector) const
  {
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        vector[edge_.dof_indices()[edge_.dof(side, a, c)]] += nodes[a][c];
  }

  const Shell      &shell_;
  const EdgePenalty penalty_;
  ShellCellValues   values_;
  ShellEdgeValues   edge_;
};

void
test_tangent(const Element &element, const MembraneStrain strain)
{
  const Shell shell(
    creased_text("u=0: rotation = 0.7 + 0.2*y; v=0: symmetry; "
                 "u=1: clamped") +
      "subsection Loads\n set Edge moments = v=1: 0.3 + x\nend\n",
    element);
  const auto options = corotational(strain);
  const auto name    = case_name(element, strain);

  // Of order one, and no symmetry left.
  auto         u = interpolate(*shell.discretization, some_field);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  for (unsigned int i = 0; i < u.size(); ++i)
    u(i) = u(i) + noise(generator);
  u.compress(VectorOperation::insert);
  const auto [matrix, force] =
    dense_tangent(*shell.discretization, *shell.make_operator(options), u);

  ComplexForces        forces(shell, options);
  std::vector<Complex> u_complex(u.size());
  for (unsigned int i = 0; i < u.size(); ++i)
    u_complex[i] = u(i);
  FullMatrix<double> derivative(u.size(), u.size());
  constexpr double   step = 1e-30;
  for (unsigned int j = 0; j < u.size(); ++j)
    {
      u_complex[j] += Complex(0., step);
      const auto f = forces.at(u_complex);
      u_complex[j] = u_complex[j].real();
      for (unsigned int i = 0; i < u.size(); ++i)
        derivative(i, j) = f[i].imag() / step;
    }
  const auto f     = forces.at(u_complex);
  double     error = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    error = std::max(error, std::abs(f[i].real() - force[i]));
  check_below(name + "force", error / force.linfty_norm(), 1e-13);
  check_below(name + "consistent tangent, largest error",
              relative_difference(matrix, derivative),
              1e-10);
  const auto symmetric =
    dense_tangent(*shell.discretization,
                  *shell.make_operator(
                    corotational(strain, TangentType::symmetric)),
                  u);
  FullMatrix<double> symmetric_part(derivative);
  symmetric_part.symmetrize();
  check_below(name + "symmetric tangent",
              relative_difference(symmetric.first, symmetric_part),
              1e-10);
  const auto frozen =
    dense_tangent(*shell.discretization,
                  *shell.make_operator(
                    corotational(strain, TangentType::frozen)),
                  u);
  FullMatrix<double> transposed(frozen.first);
  transposed.copy_transposed(frozen.first);
  check_below(name + "frozen tangent is symmetric",
              relative_difference(frozen.first, transposed),
              1e-13);
  check_above(name + "frozen tangent is another",
              relative_difference(frozen.first, derivative),
              1e-2);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  {
    const Parameters parameters(section_text(100., 0.3, 0.2));
    const auto       options = [](const MembraneStrain strain) {
      return corotational(strain);
    };
    test_rigid_motion(parameters, options);
  }
  test_rigid_motion_with_conditions(corotational(MembraneStrain::tied));
  test_linearisation();
  test_tangent({ElementType::lagrange, 2}, MembraneStrain::tied);
  test_tangent({ElementType::lagrange, 2}, MembraneStrain::full);
  test_tangent({ElementType::lagrange, 3}, MembraneStrain::tied);
  test_tangent({ElementType::triangle, 2}, MembraneStrain::tied);
  test_tangent({ElementType::serendipity, 2}, MembraneStrain::reduced);
  return n_failures > 0;
}
