// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/shape_table.h>
#include <nacre/postprocess/crack_points.h>

namespace Nacre
{
  double
  side_of_crack(const Discretization &discretization,
                const CrackTip       &tip,
                const CellPart       &part)
  {
    if (!discretization.cell_parts().is_cut(part.cell) &&
        !part.cell->at_boundary())
      return 0.;
    GeometryTable::Values values;
    GeometryTable(discretization.geometry_fe(), {part.outline().inner_point()})
      .evaluate(discretization.geometry_nodes(part), values);
    const Tensor<1, spacedim> d = values.position(0) - tip.position;
    return d * tip.axes[0] < 0. ? d * tip.axes[1] : 0.;
  }

  CrackPoints::CrackPoints(const SolvedShell     &shell,
                           const Quadrature<dim> &points,
                           const Tensor<1, dim>  &lip)
    : shell_(shell)
    , is_linear_(shell.model.kinematics.model == KinematicsModel::linear)
    , quadrature_(points)
    , strains_(shell, points, lip)
    , u_(shell.discretization.node_dofs().size())
  {
    const auto &fe = shell.discretization.geometry_fe();
    for (const auto &point : points.get_points())
      for (unsigned int b = 0; b < fe.n_dofs_per_cell(); ++b)
        {
          const auto d = fe.shape_3rd_derivative(b, point);
          third_.push_back({{d[0][0][0], d[0][0][1], d[0][1][1], d[1][1][1]}});
        }
  }

  void
  CrackPoints::reinit(const CellPart &part)
  {
    strains_.reinit(part);
    std::vector<types::global_dof_index> dofs;
    shell_.discretization.get_dof_indices(part, dofs);
    u_.reinit(dofs.size(), true);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      u_[i] = shell_.displacement(dofs[i]);
    acceleration_.reinit(dofs.size());
    if (shell_.acceleration != nullptr)
      for (unsigned int i = 0; i < dofs.size(); ++i)
        acceleration_[i] = (*shell_.acceleration)(dofs[i]);
    nodes_ = shell_.discretization.geometry_nodes(part);
  }

  SurfacePatch
  CrackPoints::surface(const unsigned int q) const
  {
    const auto  &values = strains_.values();
    const auto  &frame  = values.frame(q);
    SurfacePatch patch{values.point(q),
                       {frame.a_cov, frame.a_cov_derivatives},
                       {}};
    for (unsigned int b = 0; b < nodes_.size(); ++b)
      for (unsigned int k = 0; k < 4; ++k)
        patch.third[k] += third_[q * nodes_.size() + b][k] * nodes_[b];
    return patch;
  }

  Tensor<1, spacedim>
  CrackPoints::acceleration(const unsigned int q) const
  {
    const auto         &values = strains_.values();
    Tensor<1, spacedim> acceleration;
    for (unsigned int a = 0; a < values.shapes().n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        acceleration[c] +=
          values.shapes().value(q, a) * acceleration_[values.dof(a, c)];
    for (unsigned int k = 0; k < values.n_tip_functions(); ++k)
      acceleration += acceleration_[values.tip_dof(k)] *
                      Tensor<1, spacedim>(values.tip_function(q, k).value);
    return acceleration;
  }

  VectorDerivatives
  CrackPoints::derivatives(const unsigned int q) const
  {
    const auto       &values = strains_.values();
    const auto       &shapes = values.shapes();
    const auto        tip    = strains_.tip_displacement(q);
    VectorDerivatives u{tip.first, tip.second};
    for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          const double u_ac = u_[values.dof(a, c)];
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            u.first[alpha][c] += shapes.gradient(q, a)[alpha] * u_ac;
          for (unsigned int v = 0; v < 3; ++v)
            u.second[v][c] += shapes.hessian(q, a)[v] * u_ac;
        }
    return u;
  }
} // namespace Nacre
