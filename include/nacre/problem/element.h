// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_problem_element_h
#define nacre_problem_element_h

#include <nacre/base/selection.h>
#include <nacre/base/types.h>

#include <deal.II/base/quadrature.h>

#include <deal.II/grid/reference_cell.h>

#include <memory>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class FiniteElement;
}

namespace Nacre
{
  /** The families of displacement elements. */
  enum class ElementType
  {
    /** FE_Q(p), p = 2 to 5: (p+1)^2 nodes on quadrilaterals. */
    lagrange,
    /** The 8-node quadrilateral of the report's section 3.1. */
    serendipity,
    /** The 6-node triangle. */
    triangle
  };

  const Selection<ElementType> &selection(ElementType);

  /**
   * The choice of an element, and what follows from it: cells, shape functions
   * and quadrature rules.
   */
  struct Element
  {
    ElementType  type   = ElementType::lagrange;
    unsigned int degree = 2;

    /** Quadrilateral or triangle. */
    ReferenceCell
    reference_cell() const;

    /** The scalar element whose nodes carry the displacements. */
    std::unique_ptr<FiniteElement<dim, spacedim>>
    make_scalar_fe() const;

    /**
     * Scalar element of the geometry (18): of the degree @p mapping_degree for
     * Lagrange cells, the displacements' own otherwise.
     */
    std::unique_ptr<FiniteElement<dim, spacedim>>
    make_geometry_fe(const unsigned int mapping_degree) const;

    /** (p+1)^2 Gauss points; 6 points of degree 4 on triangles. */
    Quadrature<dim>
    full_quadrature() const;

    /** p^2 Gauss points; 3 points of degree 2 on triangles. */
    Quadrature<dim>
    reduced_quadrature() const;

    /** p+1 Gauss points on an edge. */
    Quadrature<1>
    edge_quadrature() const;

    /** A rule for errors, two degrees finer than the form's. */
    Quadrature<dim>
    fine_quadrature() const;

    /** The nodes of each edge of the reference cell. */
    std::vector<std::vector<unsigned int>>
    face_nodes() const;
  };
} // namespace Nacre

#endif
