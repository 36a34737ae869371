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

  CrackPoints::CrackPoints(const ShellState      &state,
                           const Quadrature<dim> &points)
    : state_(state)
    , is_linear_(state.model.kinematics.model == KinematicsModel::linear)
    , quadrature_(points)
    , strains_(state, points)
    , u_(state.discretization.node_dofs().size())
  {
    const auto &fe = state.discretization.geometry_fe();
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
    state_.discretization.get_dof_indices(part, dofs);
    u_.reinit(dofs.size(), true);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      u_[i] = state_.displacement(dofs[i]);
    nodes_ = state_.discretization.geometry_nodes(part);
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
