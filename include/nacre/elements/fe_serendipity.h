// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_elements_fe_serendipity_h
#define nacre_elements_fe_serendipity_h

#include <nacre/base/types.h>

#include <deal.II/fe/fe_poly.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * The 8-node quadrilateral of the report's section 3.1, continuous: nodes at
   * the four vertices and in the middle of the four lines, in this order, none
   * inside; the space is
   *
   *     span { 1, x, y, xy, x^2, y^2, x^2 y, x y^2 }
   *
   * on the reference cell [0, 1]^2. With s = 2x - 1, t = 2y - 1 and the node
   * at (s, t) = (a, b) the shape functions are (Ergatoudis, Irons, Zienkiewicz,
   * Int. J. Solids Struct. 4 (1968) 31)
   *
   *     1/4 (1 + a s)(1 + b t)(a s + b t - 1)     at vertices,
   *     1/2 (1 - s^2)(1 + b t)                    in the middle of y = const.,
   *     1/2 (1 + a s)(1 - t^2)                    in the middle of x = const.
   *
   * Full quadratics lie in the space on affine cells only. On each line the
   * trace is the full quadratic, as FE_Q(2)'s, hence hanging nodes are
   * constrained as there; the halves of a cell contain its space, so that
   * prolongation is exact; restriction is interpolation at the parent's nodes,
   * which are vertices of the children.
   *
   * As for FE_Q: support points, isotropic refinement, any FiniteElement
   * machinery, products by FESystem. Elements of other kinds can be
   * interpolated from, not neighboured (no hp).
   *
   * Geometry in this space: a MappingQCache of degree 2 with a field of
   * positions of FESystem(FE_Serendipity(2), 3) is exact, since FE_Q(2)'s space
   * contains this one. (deal.II 9.4's MappingFE lacks JxW on halves of edges.)
   */
  class FE_Serendipity : public FE_Poly<dim, spacedim>
  {
  public:
    /**
     * @param degree of the traces on lines: 2. Any other throws an ExcMessage.
     */
    explicit FE_Serendipity(const unsigned int degree);

    /** FE_Serendipity<2,3>(2), in the manner of FE_Q. */
    std::string
    get_name() const override;

    std::unique_ptr<FiniteElement<dim, spacedim>>
    clone() const override;

    /** Vertex functions live on two faces, line functions on their own. */
    bool
    has_support_on_face(const unsigned int shape_index,
                        const unsigned int face_index) const override;

    /** A constant function has the same value at all nodes. */
    std::pair<Table<2, bool>, std::vector<unsigned int>>
    get_constant_modes() const override;

    /** Copies the values, since dofs are values at the nodes. */
    void
    convert_generalized_support_point_values_to_dof_values(
      const std::vector<Vector<double>> &support_point_values,
      std::vector<double>               &nodal_values) const override;

    /** [node of this element][dof of @p source], any scalar element. */
    void
    get_interpolation_matrix(const FiniteElement<dim, spacedim> &source,
                             FullMatrix<double> &matrix) const override;

    /**
     * [face node of @p source][face dof of this element]: this element's trace
     * at the face's nodes of a scalar element with nodes.
     */
    void
    get_face_interpolation_matrix(
      const FiniteElement<dim, spacedim> &source,
      FullMatrix<double>                 &matrix,
      const unsigned int                  face_no = 0) const override;

    /** The same at the nodes of the half @p subface of the face. */
    void
    get_subface_interpolation_matrix(
      const FiniteElement<dim, spacedim> &source,
      const unsigned int                  subface,
      FullMatrix<double>                 &matrix,
      const unsigned int                  face_no = 0) const override;

    /**
     * True: the constraints of hanging nodes come from the face matrices. They
     * equal FE_Q(2)'s (interface_constraints, which is filled too).
     */
    bool
    hp_constraints_are_implemented() const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_vertex_dof_identities(
      const FiniteElement<dim, spacedim> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_line_dof_identities(
      const FiniteElement<dim, spacedim> &other) const override;

    std::vector<std::pair<unsigned int, unsigned int>>
    hp_quad_dof_identities(const FiniteElement<dim, spacedim> &other,
                           const unsigned int face_no = 0) const override;

    /**
     * Elements of this kind dominate each other; there is no order with others.
     */
    FiniteElementDomination::Domination
    compare_for_domination(const FiniteElement<dim, spacedim> &other,
                           const unsigned int codim = 0) const override;

  private:
    /** Value of the face dof @p j at @p x in [0, 1], the same on any face. */
    double
    trace_value(const unsigned int j, const double x) const;

    /** The trace at nodes of @p source, scaled and shifted along the face. */
    void
    fill_face_matrix(const FiniteElement<dim, spacedim> &source,
                     const unsigned int                  face_no,
                     const double                        scale,
                     const double                        shift,
                     FullMatrix<double>                 &matrix) const;
  };
} // namespace Nacre

#endif
