// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Finite rotations: the internal forces are the gradient of the energy and the
// tangent is their derivative, both by complex steps, on creased, curved,
// hanging and oppositely oriented meshes with displacements as large as the
// cells.

#include "../laminates/laminate_parameters.h"
#include "finite_shell.h"
#include <nacre/forms/finite_kinematics.h>

#include <complex>
#include <random>

using Complex       = std::complex<double>;
using ComplexVector = std::vector<Complex>;

/** Energy and internal forces of the whole shell, by the kernels' templates. */
class ComplexShell
{
public:
  /** @param conditions, loads null: none */
  ComplexShell(const Discretization     &discretization,
               const SectionLaw         &section,
               const BoundaryConditions *conditions,
               const Loads              *loads,
               const MembraneStrain      strain)
    : discretization_(discretization)
    , section_(section)
    , conditions_(conditions)
    , loads_(loads)
    , penalty_(discretization,
               section,
               discretization.element().full_quadrature(),
               7.)
    , values_(discretization,
              cell_quadrature(discretization.element(), strain),
              strain == MembraneStrain::tied)
    , edge_(discretization)
  {}

  /** Set energy and force at @p u. */
  void
  evaluate(const ComplexVector &u)
  {
    energy = 0.;
    force.assign(u.size(), 0.);
    for (const auto &cell :
         discretization_.dof_handler().active_cell_iterators())
      {
        add_cell(cell, u);
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              edge_.reinit(cell, f);
              add_boundary(penalty_.boundary(cell),
                           cell->face(f)->boundary_id(),
                           u);
            }
          else if (cell->neighbor(f)->level() < cell->level() ||
                   cell < cell->neighbor(f))
            edge_.for_pieces_to_neighbor(cell, f, [&](const auto &) {
              add_edge(penalty_.interior(cell, cell->neighbor(f)), nullptr, u);
            });
      }
  }

  Complex       energy;
  ComplexVector force;

private:
  void
  add_cell(const DoFHandler<2, 3>::active_cell_iterator &cell,
           const ComplexVector                          &u)
  {
    values_.reinit_frames(cell);
    std::vector<SectionBlocks> sections;
    for (unsigned int q = 0; q < values_.n_points(); ++q)
      sections.emplace_back(section_,
                            values_.frame(q),
                            values_.point(q),
                            values_.JxW(q));
    std::vector<types::global_dof_index> dofs(values_.n_dofs());
    cell->get_dof_indices(dofs);
    const unsigned int   n_nodes = values_.shapes().n_nodes();
    NodeVectors<Complex> local(n_nodes), local_force(n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        local[a][c] = u[dofs[values_.dof(a, c)]];
    FiniteCell<Complex> terms;
    terms.reinit(values_, sections, local);
    energy += terms.membrane_energy() + terms.bending_energy();
    terms.add_force(values_, local_force);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int c = 0; c < 3; ++c)
        force[dofs[values_.dof(a, c)]] += local_force[a][c];
  }

  void
  add_boundary(const double             penalty,
               const types::boundary_id id,
               const ComplexVector     &u)
  {
    if (conditions_ == nullptr)
      return;
    const auto condition = conditions_->edges().find(id);
    if (condition != conditions_->edges().end() &&
        condition->second.rotation != nullptr)
      add_edge(penalty, condition->second.rotation.get(), u);
    const auto moment = loads_->edge_moments().find(id);
    if (moment == loads_->edge_moments().end())
      return;
    const auto               local = edge_nodes(0, u);
    NodeVectors<Complex>     local_force(local.size());
    FollowingMoment<Complex> load;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      {
        load.reinit(edge_, q, moment->second(edge_.point(q)), local);
        load.add_force(edge_, q, local_force);
      }
    add_nodes(0, local_force);
  }

  void
  add_edge(const double         penalty,
           const Expression    *rotation,
           const ComplexVector &u)
  {
    std::array<NodeVectors<Complex>, 2>     local;
    std::array<TiedGreenStrain<Complex>, 2> membrane;
    const bool                              coupled = section_.is_coupled();
    for (unsigned int s = 0; s < edge_.n_sides(); ++s)
      {
        local[s] = edge_nodes(s, u);
        if (coupled)
          membrane[s].reinit(EdgeSideTying(edge_, s), local[s]);
      }
    FiniteEdgePoint<Complex> point;
    for (unsigned int q = 0; q < edge_.n_points(); ++q)
      {
        const double angle =
          rotation == nullptr ? 0. : (*rotation)(edge_.point(q));
        point.reinit(edge_,
                     q,
                     section_,
                     penalty,
                     angle,
                     local,
                     coupled ? &membrane : nullptr);
        energy += point.energy();
        for (unsigned int s = 0; s < edge_.n_sides(); ++s)
          {
            NodeVectors<Complex> local_force(local[s].size());
            point.add_force(s, local_force);
            add_nodes(s, local_force);
            if (coupled)
              membrane[s].add_point_force(edge_.tying(s),
                                          q,
                                          point.membrane_force(s));
          }
      }
    if (coupled)
      add_membrane(membrane);
  }

  /** What the sides' membrane strains @p membrane do to the nodes. */
  void
  add_membrane(std::array<TiedGreenStrain<Complex>, 2> &membrane)
  {
    for (unsigned int s = 0; s < edge_.n_sides(); ++s)
      {
        membrane[s].set_resultants(edge_.tying(s));
        NodeVectors<Complex> local_force(edge_.shapes(s).n_nodes());
        membrane[s].add_force(edge_.tying_shapes(s), local_force);
        add_nodes(s, local_force);
      }
  }

  NodeVectors<Complex>
  edge_nodes(const unsigned int side, const ComplexVector &u) const
  {
    NodeVectors<Complex> nodes(edge_.shapes(side).n_nodes());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        nodes[a][c] = u[edge_.dof_indices()[edge_.dof(side, a, c)]];
    return nodes;
  }

  void
  add_nodes(const unsigned int side, const NodeVectors<Complex> &nodes)
  {
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int c = 0; c < 3; ++c)
        force[edge_.dof_indices()[edge_.dof(side, a, c)]] += nodes[a][c];
  }

  const Discretization     &discretization_;
  const SectionLaw         &section_;
  const BoundaryConditions *conditions_;
  const Loads              *loads_;
  const EdgePenalty         penalty_;
  ShellCellValues           values_;
  ShellEdgeValues           edge_;
};

/** A field of order one, and no symmetry left. */
TrilinosVector
large_displacement(const Discretization &discretization, const double factor)
{
  auto         u = interpolate(discretization, some_field);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  for (unsigned int i = 0; i < u.size(); ++i)
    u(i) = factor * (u(i) + noise(generator));
  u.compress(VectorOperation::insert);
  discretization.node_constraints().distribute(u);
  return u;
}

/** Sum of the entries of @p values that move with the free dof j. */
template <typename Values>
auto
condense(const std::vector<std::pair<unsigned int, double>> &column,
         const Values                                       &values)
{
  auto sum = 0. * values[0];
  for (const auto &[i, weight] : column)
    sum += weight * values[i];
  return sum;
}

/** How all dofs move with each free one, hanging nodes included. */
std::vector<std::vector<std::pair<unsigned int, double>>>
free_columns(const Discretization &discretization)
{
  const auto        &constraints = discretization.node_constraints();
  const unsigned int n           = discretization.dof_handler().n_dofs();
  std::vector<std::vector<std::pair<unsigned int, double>>> columns(n);
  for (unsigned int i = 0; i < n; ++i)
    if (!constraints.is_constrained(i))
      columns[i].emplace_back(i, 1.);
    else
      for (const auto &[j, weight] : *constraints.get_constraint_entries(i))
        columns[j].emplace_back(i, weight);
  return columns;
}

/** @param symmetric whether the tangent must be (no moments as loads) */
void
compare_derivatives(const std::string    &name,
                    const Discretization &discretization,
                    const Assembly       &assembly,
                    ComplexShell         &shell,
                    const bool            is_gradient)
{
  const auto u               = large_displacement(discretization, 1.);
  const auto columns         = free_columns(discretization);
  const auto [matrix, force] = dense_tangent(discretization,
                                             assembly,
                                             u,
                                             discretization.node_constraints());
  ComplexVector u_complex(u.size());
  for (unsigned int i = 0; i < u.size(); ++i)
    u_complex[i] = u(i);

  constexpr double   step = 1e-30;
  FullMatrix<double> derivative(u.size(), u.size()), found(matrix);
  double             gradient_error = 0.;
  for (unsigned int j = 0; j < u.size(); ++j)
    {
      for (const auto &[i, weight] : columns[j])
        u_complex[i] += Complex(0., weight * step);
      shell.evaluate(u_complex);
      for (unsigned int i = 0; i < u.size(); ++i)
        if (columns[i].empty() || columns[j].empty())
          found(i, j) = 0.;
        else
          derivative(i, j) = condense(columns[i], shell.force).imag() / step;
      if (!columns[j].empty())
        gradient_error =
          std::max(gradient_error,
                   std::abs(shell.energy.imag() / step - force[j]));
      for (const auto &column : columns[j])
        u_complex[column.first] = u(column.first);
    }
  if (is_gradient)
    check_below(name + ": force is the gradient of the energy",
                gradient_error / force.linfty_norm(),
                1e-12);
  shell.evaluate(u_complex);
  double error = 0.;
  for (unsigned int i = 0; i < u.size(); ++i)
    if (!columns[i].empty())
      error =
        std::max(error,
                 std::abs(condense(columns[i], shell.force).real() - force[i]));
  check_below(name + ": force", error / force.linfty_norm(), 1e-12);
  check_below(name + ": tangent is the derivative of the force",
              relative_difference(found, derivative),
              1e-10);
  if (!is_gradient)
    return;
  FullMatrix<double> transposed(found);
  transposed.copy_transposed(found);
  check_below(name + ": symmetry of the tangent",
              relative_difference(found, transposed),
              1e-12);
}

void
test_shell(const Element       &element,
           const MembraneStrain strain,
           const std::string   &edges,
           const std::string   &moments)
{
  const Shell  shell(creased_text(edges) + "subsection Loads\n" +
                      (moments.empty() ? "" :
                                          " set Edge moments = " + moments) +
                      "\nend\n",
                    element);
  ComplexShell complex_shell(*shell.discretization,
                             *shell.section,
                             shell.conditions,
                             shell.loads,
                             strain);
  compare_derivatives(case_name(element, strain) +
                        (!moments.empty()  ? "moments" :
                         edges.size() < 15 ? "clamped" :
                                             "conditions"),
                      *shell.discretization,
                      *shell.make_operator(finite(strain)),
                      complex_shell,
                      moments.empty());
}

/** @param parameters with section, conditions and loads */
template <typename AnyParameters>
void
test_mesh(const std::string   &name,
          const AnyParameters &parameters,
          const bool           hanging,
          const unsigned int   degree)
{
  const auto discretization =
    make_discretization(difficult_mesh(hanging), degree);
  const Assembly assembly(*discretization,
                          ShellParts(parameters.section,
                                     parameters.conditions,
                                     parameters.loads,
                                     finite(MembraneStrain::tied),
                                     7.));
  ComplexShell   complex_shell(*discretization,
                             parameters.section,
                             nullptr,
                             nullptr,
                             MembraneStrain::tied);
  compare_derivatives(name + "p = " + std::to_string(degree) +
                        (hanging ? ", hanging" : "") + ", opposite",
                      *discretization,
                      assembly,
                      complex_shell,
                      true);
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                edges =
    "u=0: rotation = 0.7 + 0.2*y; v=0: symmetry; u=1: clamped";
  const Element p2{ElementType::lagrange, 2};
  test_shell(p2, MembraneStrain::tied, edges, "");
  test_shell(p2, MembraneStrain::full, "u=0: clamped", "");
  test_shell(p2, MembraneStrain::tied, "v=0: symmetry", "v=1: 0.3 + x");
  test_shell({ElementType::lagrange, 3}, MembraneStrain::tied, edges, "");
  test_shell(triangle, MembraneStrain::tied, edges, "");
  test_shell(serendipity, MembraneStrain::reduced, edges, "");
  {
    const Parameters parameters(section_text(100., 0.3, 0.2));
    test_mesh("", parameters, false, 2);
    test_mesh("", parameters, true, 2);
    test_mesh("", parameters, true, 3);
  }
  // Membrane and bending coupled, n = A E + B kappa, m = B^T E + D kappa
  const LaminateParameters laminate(
    laminate_text("[0/30/-60]",
                  "0.2",
                  "  set Material direction = 1, 0.4, 0.1\n"));
  test_mesh("coupled, ", laminate, false, 2);
  test_mesh("coupled, ", laminate, true, 2);
  test_mesh("coupled, ", laminate, false, 3);
  return n_failures > 0;
}
