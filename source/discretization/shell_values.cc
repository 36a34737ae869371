// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/shell_values.h>
#include <nacre/mechanics/shell_strain.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

namespace Nacre
{
  namespace
  {
    const UpdateFlags geometry_flags =
      update_jacobians | update_jacobian_grads | update_JxW_values |
      update_quadrature_points;

    /** Column @p alpha of the Jacobian: phi0,alpha. */
    Tensor<1, spacedim>
    tangent(const DerivativeForm<1, dim, spacedim> &jacobian,
            const unsigned int                      alpha)
    {
      Tensor<1, spacedim> a;
      for (unsigned int c = 0; c < spacedim; ++c)
        a[c] = jacobian[c][alpha];
      return a;
    }

    SurfaceFrame<>
    frame_from(const FEValuesBase<dim, spacedim> &fe_values,
               const unsigned int                 q)
    {
      const auto &gradient = fe_values.jacobian_grad(q);

      std::array<Tensor<1, spacedim>, 3> derivatives;
      for (unsigned int c = 0; c < spacedim; ++c)
        {
          derivatives[0][c] = gradient[c][0][0];
          derivatives[1][c] = gradient[c][1][1];
          derivatives[2][c] = gradient[c][0][1];
        }
      return make_surface_frame(tangent(fe_values.jacobian(q), 0),
                                tangent(fe_values.jacobian(q), 1),
                                derivatives);
    }
  } // namespace

  ShellCellValues::ShellCellValues(const Discretization  &discretization,
                                   const Quadrature<dim> &quadrature,
                                   const bool             tied)
    : discretization_(discretization)
    , quadrature_(quadrature)
    , tied_(tied)
    , tying_(tied ? MembraneTying(discretization.element(),
                                  quadrature.get_points()) :
                    MembraneTying::untied(quadrature.get_points()))
    , fe_nothing_(discretization.element().reference_cell())
    , fe_values_(discretization.mapping(),
                 fe_nothing_,
                 quadrature,
                 geometry_flags)
    , tying_fe_values_(discretization.mapping(),
                       fe_nothing_,
                       Quadrature<dim>(tying_.points()),
                       update_jacobians)
    , shapes_(discretization.scalar_fe(), quadrature.get_points())
    , tying_shapes_(discretization.scalar_fe(), tying_.points())
    , frames_(quadrature.size())
    , tying_frames_(tied ? tying_.points().size() : 0)
    , membrane_rows_(3 * quadrature.size(), n_dofs())
    , bending_rows_(3 * quadrature.size(), n_dofs())
    , tying_rows_(tied ? tying_.samples().size() : 0, n_dofs())
  {}

  ShellCellValues::ShellCellValues(const ShellCellValues &other)
    : ShellCellValues(other.discretization_, other.quadrature_, other.tied_)
  {}

  void
  ShellCellValues::reinit_frames(
    const Triangulation<dim, spacedim>::cell_iterator &cell)
  {
    fe_values_.reinit(cell);
    for (unsigned int q = 0; q < n_points(); ++q)
      frames_[q] = frame_from(fe_values_, q);
    if (tied_)
      {
        tying_fe_values_.reinit(cell);
        for (unsigned int k = 0; k < tying_frames_.size(); ++k)
          tying_frames_[k] =
            make_surface_frame(tangent(tying_fe_values_.jacobian(k), 0),
                               tangent(tying_fe_values_.jacobian(k), 1),
                               {});
      }
  }

  void
  ShellCellValues::reinit(
    const Triangulation<dim, spacedim>::cell_iterator &cell)
  {
    reinit_frames(cell);
    if (tied_)
      fill_tied_membrane_rows();
    else
      fill_membrane_rows();
    fill_bending_rows();
  }

  void
  ShellCellValues::fill_membrane_rows()
  {
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
        {
          const auto &dN    = shapes_.gradient(q, a);
          const auto &a_cov = frames_[q].a_cov;
          for (unsigned int c = 0; c < spacedim; ++c)
            {
              const unsigned int i         = dof(a, c);
              membrane_rows_(3 * q, i)     = a_cov[0][c] * dN[0];
              membrane_rows_(3 * q + 1, i) = a_cov[1][c] * dN[1];
              membrane_rows_(3 * q + 2, i) =
                a_cov[0][c] * dN[1] + a_cov[1][c] * dN[0];
            }
        }
  }

  void
  ShellCellValues::fill_tied_membrane_rows()
  {
    for (unsigned int k = 0; k < tying_rows_.m(); ++k)
      {
        const auto &[point, direction] = tying_.samples()[k];
        const auto &[a_1, a_2]         = tying_frames_[point].a_cov;
        for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
          {
            // direction . (a_1 N,1, a_2 N,2, a_1 N,2 + a_2 N,1), (3)
            const auto  &dN  = tying_shapes_.gradient(point, a);
            const double s_1 = direction[0] * dN[0] + direction[2] * dN[1];
            const double s_2 = direction[1] * dN[1] + direction[2] * dN[0];
            for (unsigned int c = 0; c < spacedim; ++c)
              tying_rows_(k, dof(a, c)) = s_1 * a_1[c] + s_2 * a_2[c];
          }
      }
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int v = 0; v < 3; ++v)
        {
          double *row = &membrane_rows_(3 * q + v, 0);
          std::fill(row, row + n_dofs(), 0.);
          for (const auto &[k, weight] : tying_.weights(q, v))
            {
              const double *sample = &tying_rows_(k, 0);
              for (unsigned int i = 0; i < tying_rows_.n(); ++i)
                row[i] += weight * sample[i];
            }
        }
  }

  void
  ShellCellValues::fill_bending_rows()
  {
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int a = 0; a < shapes_.n_nodes(); ++a)
        {
          const auto strain =
            ShellStrain::bending_of_shape_function(frames_[q],
                                                   shapes_.gradient(q, a),
                                                   shapes_.hessian(q, a));
          for (unsigned int c = 0; c < spacedim; ++c)
            for (unsigned int v = 0; v < 3; ++v)
              bending_rows_(3 * q + v, dof(a, c)) =
                strain[v] * frames_[q].t0[c];
        }
  }

  ShellEdgeValues::ShellEdgeValues(const Discretization &discretization)
    : discretization_(discretization)
    , quadrature_(discretization.element().edge_quadrature())
    , interface_values_(discretization.mapping(),
                        discretization.dof_handler().get_fe(),
                        discretization.element().edge_quadrature(),
                        geometry_flags | update_normal_vectors)
  {
    make_tables();
    for (unsigned int side = 0; side < 2; ++side)
      {
        frames_[side].resize(quadrature_.size());
        joint_dofs_[side].resize(discretization.node_dofs().size());
        local_to_joint_[side].resize(discretization.node_dofs().size());
      }
  }

  void
  ShellEdgeValues::make_tables()
  {
    const auto  cell   = discretization_.element().reference_cell();
    const auto &fe     = discretization_.scalar_fe();
    auto        points = std::vector<Point<dim>>(quadrature_.size());
    tables_.resize(cell.n_faces());
    for (const auto face : cell.face_indices())
      {
        for (unsigned int subface = 0; subface < 2; ++subface)
          {
            // Meshes of triangles have no hanging nodes.
            if (cell == ReferenceCells::Quadrilateral)
              QProjector<dim>::project_to_subface(cell,
                                                  quadrature_,
                                                  face,
                                                  subface,
                                                  points);
            tables_[face].emplace_back(fe, points);
          }
        QProjector<dim>::project_to_face(cell, quadrature_, face, points);
        tables_[face].emplace_back(fe, points);
        std::reverse(points.begin(), points.end());
        tables_[face].emplace_back(fe, points);
      }
  }

  ShellEdgeValues::ShellEdgeValues(const ShellEdgeValues &other)
    : ShellEdgeValues(other.discretization_)
  {}

  void
  ShellEdgeValues::reinit(const cell_iterator &cell,
                          const unsigned int   face,
                          const unsigned int   subface,
                          const cell_iterator &neighbor,
                          const unsigned int   neighbor_face,
                          const unsigned int   neighbor_subface)
  {
    interface_values_
      .reinit(cell, face, subface, neighbor, neighbor_face, neighbor_subface);
    n_sides_ = 2;
    update({{cell, neighbor}},
           {{face, neighbor_face}},
           {{subface, neighbor_subface}});
  }

  void
  ShellEdgeValues::reinit(const cell_iterator &cell, const unsigned int face)
  {
    interface_values_.reinit(cell, face);
    n_sides_ = 1;
    update({{cell, cell}},
           {{face, numbers::invalid_unsigned_int}},
           {{numbers::invalid_unsigned_int, numbers::invalid_unsigned_int}});
  }

  void
  ShellEdgeValues::update(const std::array<cell_iterator, 2> &cells,
                          const std::array<unsigned int, 2>  &faces,
                          const std::array<unsigned int, 2>  &subfaces)
  {
    dof_indices_ = interface_values_.get_interface_dof_indices();

    // Invert the map from joint dofs to the dofs of the sides.
    for (unsigned int i = 0; i < dof_indices_.size(); ++i)
      {
        const auto local = interface_values_.interface_dof_to_dof_indices(i);
        for (unsigned int side = 0; side < n_sides_; ++side)
          if (local[side] != numbers::invalid_unsigned_int)
            local_to_joint_[side][local[side]] = i;
      }

    const auto &node_dofs = discretization_.node_dofs();
    for (unsigned int side = 0; side < n_sides_; ++side)
      {
        for (unsigned int k = 0; k < node_dofs.size(); ++k)
          joint_dofs_[side][k] = local_to_joint_[side][node_dofs[k]];
        const bool whole = (subfaces[side] == numbers::invalid_unsigned_int);
        const unsigned int whole_table =
          cells[side]->face_orientation(faces[side]) ? 2 : 3;
        shapes_[side] =
          &tables_[faces[side]][whole ? whole_table : subfaces[side]];
        for (unsigned int q = 0; q < n_points(); ++q)
          frames_[side][q] =
            frame_from(interface_values_.get_fe_face_values(side), q);
      }
  }

  double
  ShellEdgeValues::sigma(const unsigned int side, const unsigned int q) const
  {
    if (side == 0)
      return 1.;
    const auto direction = [&](const unsigned int s) {
      return cross_product_3d(conormal(s, q), frames_[s][q].t0);
    };
    return direction(1) * direction(0) > 0. ? 1. : -1.;
  }
} // namespace Nacre
