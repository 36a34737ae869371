// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_discretization_shell_values_h
#define nacre_discretization_shell_values_h

#include <nacre/discretization/discretization.h>
#include <nacre/discretization/membrane_tying.h>
#include <nacre/discretization/shape_table.h>
#include <nacre/mechanics/section_law.h>
#include <nacre/mechanics/surface_frame.h>

#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/full_matrix.h>

#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Frames and strains on a cell: FEValues for shells.
   *
   * The rows of strains are matrices [3 q + v][i]: Voigt component v of the
   * strain at the point q of the local dof i.
   *
   * Tied membrane strains (against membrane locking) are interpolated from the
   * samples of a MembraneTying.
   */
  class ShellCellValues
  {
  public:
    /**
     * @param quadrature points in the reference cell, any
     * @param tied whether membrane strains are tied
     */
    ShellCellValues(const Discretization  &discretization,
                    const Quadrature<dim> &quadrature,
                    const bool             tied);

    ShellCellValues(const ShellCellValues &other);

    /** Frames and the rows of the linear strains. */
    void
    reinit(const Triangulation<dim, spacedim>::cell_iterator &cell);

    /** Frames only. */
    void
    reinit_frames(const Triangulation<dim, spacedim>::cell_iterator &cell);

    unsigned int
    n_points() const
    {
      return frames_.size();
    }

    unsigned int
    n_dofs() const
    {
      return discretization_.node_dofs().size();
    }

    const SurfaceFrame<> &
    frame(const unsigned int q) const
    {
      return frames_[q];
    }

    /** Position of the point @p q (length), and the region of the cell. */
    SectionPoint
    point(const unsigned int q) const
    {
      return {fe_values_.quadrature_point(q),
              fe_values_.get_cell()->material_id()};
    }

    /** Area element times weight (length^2). */
    double
    JxW(const unsigned int q) const
    {
      return fe_values_.JxW(q);
    }

    const ShapeTable &
    shapes() const
    {
      return shapes_;
    }

    /** Local dof of the component @p c of the node @p a. */
    unsigned int
    dof(const unsigned int a, const unsigned int c) const
    {
      return discretization_.node_dofs()[spacedim * a + c];
    }

    /** Where the membrane strain is sampled: at the points if untied. */
    const MembraneTying &
    tying() const
    {
      return tying_;
    }

    /** Shape functions at the tying points. */
    const ShapeTable &
    tying_shapes() const
    {
      return tying_shapes_;
    }

    /** Frame at the tying point @p k; no second derivatives if tied. */
    const SurfaceFrame<> &
    tying_frame(const unsigned int k) const
    {
      return tied_ ? tying_frames_[k] : frames_[k];
    }

    /** Rows of the membrane strain, (3) or its tied interpolation. */
    const FullMatrix<double> &
    membrane_rows() const
    {
      return membrane_rows_;
    }

    /** Rows of the bending strain, (4). */
    const FullMatrix<double> &
    bending_rows() const
    {
      return bending_rows_;
    }

  private:
    void
    fill_membrane_rows();

    void
    fill_tied_membrane_rows();

    void
    fill_bending_rows();

    const Discretization     &discretization_;
    const Quadrature<dim>     quadrature_;
    const bool                tied_;
    const MembraneTying       tying_;
    FE_Nothing<dim, spacedim> fe_nothing_;
    FEValues<dim, spacedim>   fe_values_;
    FEValues<dim, spacedim>   tying_fe_values_;
    ShapeTable                shapes_;
    ShapeTable                tying_shapes_;

    std::vector<SurfaceFrame<>> frames_;
    std::vector<SurfaceFrame<>> tying_frames_;
    FullMatrix<double>          membrane_rows_;
    FullMatrix<double>          bending_rows_;
    FullMatrix<double>          tying_rows_;
  };

  /**
   * Frames and shape functions at the points of an edge, on both sides:
   * FEInterfaceValues for shells. Side 0 is K^-, side 1 is K^+; on the
   * boundary and for a single cell there is side 0 only.
   *
   * Conventions, here and nowhere else: jump = plus - minus; the conormal
   * nu^- = n^-, nu^+ = -n^+, n being outward of its own cell; sigma = -1 where
   * the neighbour has the opposite orientation and multiplies all rotations
   * and moments of K^+.
   */
  class ShellEdgeValues
  {
  public:
    explicit ShellEdgeValues(const Discretization &discretization);

    ShellEdgeValues(const ShellEdgeValues &other);

    using cell_iterator = DoFHandler<dim, spacedim>::active_cell_iterator;

    /** The edge between two cells, arguments as mesh_loop's face worker. */
    void
    reinit(const cell_iterator &cell,
           const unsigned int   face,
           const unsigned int   subface,
           const cell_iterator &neighbor,
           const unsigned int   neighbor_face,
           const unsigned int   neighbor_subface);

    /** One edge of one cell. */
    void
    reinit(const cell_iterator &cell, const unsigned int face);

    unsigned int
    n_sides() const
    {
      return n_sides_;
    }

    unsigned int
    n_points() const
    {
      return quadrature_.size();
    }

    /** Dofs of the cells of all sides, shared ones once. */
    unsigned int
    n_dofs() const
    {
      return dof_indices_.size();
    }

    const std::vector<types::global_dof_index> &
    dof_indices() const
    {
      return dof_indices_;
    }

    /** Length element times weight (length). */
    double
    JxW(const unsigned int q) const
    {
      return interface_values_.JxW(q);
    }

    /** Position (length), and the region of the cell of the side. */
    SectionPoint
    point(const unsigned int q, const unsigned int side = 0) const
    {
      const auto &values = interface_values_.get_fe_face_values(side);
      return {values.quadrature_point(q), values.get_cell()->material_id()};
    }

    const SurfaceFrame<> &
    frame(const unsigned int side, const unsigned int q) const
    {
      return frames_[side][q];
    }

    /** nu of the side, at the point @p q: nu^- = n^-, nu^+ = -n^+. */
    Tensor<1, spacedim>
    conormal(const unsigned int side, const unsigned int q) const
    {
      return (side == 0 ? 1. : -1.) *
             interface_values_.get_fe_face_values(side).normal_vector(q);
    }

    /**
     * +1 for the side 0 and a neighbour of the same orientation, -1 for a
     * neighbour of the opposite one:
     * sigma = sign[(nu^+ x t0^+) . (nu^- x t0^-)].
     */
    double
    sigma(const unsigned int side, const unsigned int q) const;

    const ShapeTable &
    shapes(const unsigned int side) const
    {
      return *shapes_[side];
    }

    /** Index within dof_indices() of a side's node and component. */
    unsigned int
    dof(const unsigned int side,
        const unsigned int a,
        const unsigned int c) const
    {
      return joint_dofs_[side][spacedim * a + c];
    }

  private:
    void
    make_tables();

    void
    update(const std::array<cell_iterator, 2> &cells,
           const std::array<unsigned int, 2>  &faces,
           const std::array<unsigned int, 2>  &subfaces);

    const Discretization            &discretization_;
    const Quadrature<1>              quadrature_;
    FEInterfaceValues<dim, spacedim> interface_values_;
    /** [face][subface 0, subface 1, whole face, whole face backwards]. */
    std::vector<std::vector<ShapeTable>>       tables_;
    unsigned int                               n_sides_ = 0;
    std::array<const ShapeTable *, 2>          shapes_;
    std::array<std::vector<SurfaceFrame<>>, 2> frames_;
    std::array<std::vector<unsigned int>, 2>   joint_dofs_;
    std::array<std::vector<unsigned int>, 2>   local_to_joint_;
    std::vector<types::global_dof_index>       dof_indices_;
  };
} // namespace Nacre

#endif
