// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/elements/fe_serendipity.h>
#include <nacre/problem/element.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace Nacre
{
  const Selection<ElementType> &
  selection(ElementType)
  {
    static const Selection<ElementType> table = {
      {ElementType::lagrange, "Lagrange"},
      {ElementType::serendipity, "serendipity"},
      {ElementType::triangle, "triangle"}};
    return table;
  }

  ReferenceCell
  Element::reference_cell() const
  {
    return type == ElementType::triangle ? ReferenceCells::Triangle :
                                           ReferenceCells::Quadrilateral;
  }

  std::unique_ptr<FiniteElement<dim, spacedim>>
  Element::make_scalar_fe() const
  {
    switch (type)
      {
        case ElementType::lagrange:
          return std::make_unique<FE_Q<dim, spacedim>>(degree);
        case ElementType::serendipity:
          return std::make_unique<FE_Serendipity>(degree);
        case ElementType::triangle:
          // Higher degrees of FE_SimplexP have no <2, 3> instance that works.
          Assert(degree == 2, ExcInternalError());
          return std::make_unique<FE_SimplexP<dim, spacedim>>(degree);
      }
    Assert(false, ExcInternalError());
    return nullptr;
  }

  std::unique_ptr<FiniteElement<dim, spacedim>>
  Element::make_geometry_fe(const unsigned int mapping_degree) const
  {
    if (type == ElementType::lagrange && mapping_degree != 0)
      return std::make_unique<FE_Q<dim, spacedim>>(mapping_degree);
    Assert(mapping_degree == 0 || mapping_degree == degree,
           ExcNotImplemented());
    return make_scalar_fe();
  }

  Quadrature<dim>
  Element::full_quadrature() const
  {
    if (type == ElementType::triangle)
      return QWitherdenVincentSimplex<dim>(2, false);
    return QGauss<dim>(degree + 1);
  }

  Quadrature<dim>
  Element::reduced_quadrature() const
  {
    if (type == ElementType::triangle)
      return QWitherdenVincentSimplex<dim>(1, false);
    return QGauss<dim>(degree);
  }

  Quadrature<1>
  Element::edge_quadrature() const
  {
    return QGauss<1>(degree + 1);
  }

  Quadrature<dim>
  Element::fine_quadrature() const
  {
    if (type == ElementType::triangle)
      return QWitherdenVincentSimplex<dim>(degree + 2);
    return QGauss<dim>(degree + 3);
  }

  std::vector<std::vector<unsigned int>>
  Element::face_nodes() const
  {
    const auto  cell  = reference_cell();
    const auto  fe    = make_scalar_fe();
    const auto &nodes = fe->get_unit_support_points();

    std::vector<std::vector<unsigned int>> face_nodes(cell.n_faces());
    for (const auto face : cell.face_indices())
      {
        const auto vertex = [&](const unsigned int v) {
          return cell.template vertex<dim>(
            cell.face_to_cell_vertices(face, v, 1));
        };
        const Tensor<1, dim> along = vertex(1) - vertex(0);
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const Tensor<1, dim> x = nodes[a] - vertex(0);
            if (std::abs(along[0] * x[1] - along[1] * x[0]) < 1e-12)
              face_nodes[face].push_back(a);
          }
      }
    return face_nodes;
  }
} // namespace Nacre
