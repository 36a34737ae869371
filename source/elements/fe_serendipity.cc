// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/elements/fe_serendipity.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/scalar_polynomials_base.h>

#include <array>

namespace Nacre
{
  namespace
  {
    constexpr unsigned int n_nodes = 8;

    /** Nodes in deal.II's order: vertices, then the lines' middles. */
    const std::array<Point<dim>, n_nodes> nodes = {{{0., 0.},
                                                    {1., 0.},
                                                    {0., 1.},
                                                    {1., 1.},
                                                    {0., .5},
                                                    {1., .5},
                                                    {.5, 0.},
                                                    {.5, 1.}}};

    /** Exponents (m, n) of the monomials s^m t^n, s = 2x - 1, t = 2y - 1. */
    constexpr std::array<std::array<unsigned int, 2>, n_nodes> exponents = {
      {{{0, 0}},
       {{1, 0}},
       {{0, 1}},
       {{1, 1}},
       {{2, 0}},
       {{0, 2}},
       {{2, 1}},
       {{1, 2}}}};

    /** The @p order-th derivative of s^@p exponent with respect to x. */
    double
    power_derivative(const unsigned int exponent,
                     const unsigned int order,
                     const double       s)
    {
      if (order > exponent)
        return 0.;
      double value = 1.;
      for (unsigned int k = 0; k < order; ++k)
        value *= 2. * (exponent - k);
      for (unsigned int k = order; k < exponent; ++k)
        value *= s;
      return value;
    }

    /** The shape functions; FE_Serendipity's documentation has the formulas. */
    class SerendipityPolynomials : public ScalarPolynomialsBase<dim>
    {
    public:
      SerendipityPolynomials()
        : ScalarPolynomialsBase<dim>(2, n_nodes)
      {
        // The products of the documentation, multiplied out.
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            const double a = 2. * nodes[i][0] - 1.;
            const double b = 2. * nodes[i][1] - 1.;
            if (a != 0. && b != 0.)
              coefficients_[i] = {
                {-.25, 0., 0., .25 * a * b, .25, .25, .25 * b, .25 * a}};
            else if (a == 0.)
              coefficients_[i] = {{.5, 0., .5 * b, 0., -.5, 0., -.5 * b, 0.}};
            else
              coefficients_[i] = {{.5, .5 * a, 0., 0., 0., -.5, 0., -.5 * a}};
          }
      }

      void
      evaluate(const Point<dim>            &unit_point,
               std::vector<double>         &values,
               std::vector<Tensor<1, dim>> &grads,
               std::vector<Tensor<2, dim>> &grad_grads,
               std::vector<Tensor<3, dim>> &third_derivatives,
               std::vector<Tensor<4, dim>> &fourth_derivatives) const override
      {
        // Each is empty where it isn't wanted.
        for (unsigned int i = 0; i < values.size(); ++i)
          values[i] = compute_value(i, unit_point);
        for (unsigned int i = 0; i < grads.size(); ++i)
          grads[i] = derivative<1>(i, unit_point);
        for (unsigned int i = 0; i < grad_grads.size(); ++i)
          grad_grads[i] = derivative<2>(i, unit_point);
        for (unsigned int i = 0; i < third_derivatives.size(); ++i)
          third_derivatives[i] = derivative<3>(i, unit_point);
        for (unsigned int i = 0; i < fourth_derivatives.size(); ++i)
          fourth_derivatives[i] = derivative<4>(i, unit_point);
      }

      double
      compute_value(const unsigned int i, const Point<dim> &p) const override
      {
        return partial_derivative(i, p, 0, 0);
      }

      Tensor<1, dim>
      compute_1st_derivative(const unsigned int i,
                             const Point<dim>  &p) const override
      {
        return derivative<1>(i, p);
      }

      Tensor<2, dim>
      compute_2nd_derivative(const unsigned int i,
                             const Point<dim>  &p) const override
      {
        return derivative<2>(i, p);
      }

      Tensor<3, dim>
      compute_3rd_derivative(const unsigned int i,
                             const Point<dim>  &p) const override
      {
        return derivative<3>(i, p);
      }

      Tensor<4, dim>
      compute_4th_derivative(const unsigned int i,
                             const Point<dim>  &p) const override
      {
        return derivative<4>(i, p);
      }

      Tensor<1, dim>
      compute_grad(const unsigned int i, const Point<dim> &p) const override
      {
        return derivative<1>(i, p);
      }

      Tensor<2, dim>
      compute_grad_grad(const unsigned int i,
                        const Point<dim>  &p) const override
      {
        return derivative<2>(i, p);
      }

      std::unique_ptr<ScalarPolynomialsBase<dim>>
      clone() const override
      {
        return std::make_unique<SerendipityPolynomials>(*this);
      }

      std::string
      name() const override
      {
        return "Serendipity";
      }

    private:
      /** The derivative d^(m+n) N_i / dx^m dy^n. */
      double
      partial_derivative(const unsigned int i,
                         const Point<dim>  &p,
                         const unsigned int m,
                         const unsigned int n) const
      {
        AssertIndexRange(i, n_nodes);
        double value = 0.;
        for (unsigned int k = 0; k < n_nodes; ++k)
          value += coefficients_[i][k] *
                   power_derivative(exponents[k][0], m, 2. * p[0] - 1.) *
                   power_derivative(exponents[k][1], n, 2. * p[1] - 1.);
        return value;
      }

      template <int order>
      Tensor<order, dim>
      derivative(const unsigned int i, const Point<dim> &p) const
      {
        using Result = Tensor<order, dim>;
        Result result;
        for (unsigned int k = 0; k < Result::n_independent_components; ++k)
          {
            const auto   indices = Result::unrolled_to_component_indices(k);
            unsigned int n       = 0;
            for (unsigned int l = 0; l < order; ++l)
              n += indices[l];
            result[indices] = partial_derivative(i, p, order - n, n);
          }
        return result;
      }

      /** [shape function][monomial], the latter as in exponents. */
      std::array<std::array<double, n_nodes>, n_nodes> coefficients_;
    };

    /** A dof at each vertex and on each line. */
    FiniteElementData<dim>
    element_data(const unsigned int degree)
    {
      AssertThrow(degree == 2,
                  ExcMessage("FE_Serendipity has degree " +
                             std::to_string(degree) +
                             "; only 2, the 8-node element, is implemented."));
      return FiniteElementData<dim>({1, 1, 0},
                                    1,
                                    degree,
                                    FiniteElementData<dim>::H1);
    }

    bool
    is_serendipity(const FiniteElement<dim, spacedim> &fe)
    {
      return dynamic_cast<const FE_Serendipity *>(&fe) != nullptr;
    }

    /** That the only dofs of two objects, one each, are the same. */
    std::vector<std::pair<unsigned int, unsigned int>>
    identity_if(const bool same)
    {
      if (!same)
        return {};
      return {{0U, 0U}};
    }
  } // namespace


  FE_Serendipity::FE_Serendipity(const unsigned int degree)
    : FE_Poly<dim, spacedim>(SerendipityPolynomials(),
                             element_data(degree),
                             std::vector<bool>(n_nodes, false),
                             std::vector<ComponentMask>(n_nodes,
                                                        ComponentMask(1, true)))
  {
    this->unit_support_points.assign(nodes.begin(), nodes.end());
    this->unit_face_support_points[0] = {Point<1>(0.),
                                         Point<1>(1.),
                                         Point<1>(.5)};

    // The vertex in the middle of a refined face and its halves' middles.
    const std::array<double, 3> hanging = {{.5, .25, .75}};
    this->interface_constraints.reinit(this->interface_constraints_size());
    for (unsigned int i = 0; i < hanging.size(); ++i)
      for (unsigned int j = 0; j < hanging.size(); ++j)
        this->interface_constraints(i, j) = trace_value(j, hanging[i]);

    this->reinit_restriction_and_prolongation_matrices(true, true);
    constexpr unsigned int isotropic =
      RefinementCase<dim>::isotropic_refinement;
    for (unsigned int child = 0; child < 4; ++child)
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          const auto point =
            GeometryInfo<dim>::child_to_cell_coordinates(nodes[i], child);
          for (unsigned int j = 0; j < n_nodes; ++j)
            {
              this->prolongation[isotropic - 1][child](i, j) =
                this->shape_value(j, point);
              // Coordinates are multiples of 1/4 and thus exact.
              this->restriction[isotropic - 1][child](j, i) =
                (point == nodes[j] ? 1. : 0.);
            }
        }
  }


  std::string
  FE_Serendipity::get_name() const
  {
    return "FE_Serendipity<2,3>(" + std::to_string(this->degree) + ")";
  }


  std::unique_ptr<FiniteElement<dim, spacedim>>
  FE_Serendipity::clone() const
  {
    return std::make_unique<FE_Serendipity>(*this);
  }


  bool
  FE_Serendipity::has_support_on_face(const unsigned int shape_index,
                                      const unsigned int face_index) const
  {
    AssertIndexRange(shape_index, this->n_dofs_per_cell());
    for (unsigned int j = 0; j < this->n_dofs_per_face(face_index); ++j)
      if (this->face_to_cell_index(j, face_index) == shape_index)
        return true;
    return false;
  }


  std::pair<Table<2, bool>, std::vector<unsigned int>>
  FE_Serendipity::get_constant_modes() const
  {
    Table<2, bool> modes(1, this->n_dofs_per_cell());
    modes.fill(true);
    return {modes, {0U}};
  }


  void
  FE_Serendipity::convert_generalized_support_point_values_to_dof_values(
    const std::vector<Vector<double>> &support_point_values,
    std::vector<double>               &nodal_values) const
  {
    AssertDimension(support_point_values.size(), this->n_dofs_per_cell());
    AssertDimension(nodal_values.size(), this->n_dofs_per_cell());
    for (unsigned int i = 0; i < nodal_values.size(); ++i)
      {
        AssertDimension(support_point_values[i].size(), 1);
        nodal_values[i] = support_point_values[i](0);
      }
  }


  void
  FE_Serendipity::get_interpolation_matrix(
    const FiniteElement<dim, spacedim> &source,
    FullMatrix<double>                 &matrix) const
  {
    AssertThrow(
      source.n_components() == 1 && source.is_primitive() &&
        source.reference_cell() == this->reference_cell(),
      (FiniteElement<dim, spacedim>::ExcInterpolationNotImplemented()));
    AssertDimension(matrix.m(), this->n_dofs_per_cell());
    AssertDimension(matrix.n(), source.n_dofs_per_cell());
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < matrix.n(); ++j)
        matrix(i, j) = source.shape_value(j, nodes[i]);
  }


  double
  FE_Serendipity::trace_value(const unsigned int j, const double x) const
  {
    // Face 2 is y = 0, its parameter is x.
    return this->shape_value(this->face_to_cell_index(j, 2), {x, 0.});
  }


  void
  FE_Serendipity::fill_face_matrix(const FiniteElement<dim, spacedim> &source,
                                   const unsigned int                  face_no,
                                   const double                        scale,
                                   const double                        shift,
                                   FullMatrix<double> &matrix) const
  {
    AssertThrow(
      source.n_components() == 1 && source.has_face_support_points(face_no),
      (FiniteElement<dim, spacedim>::ExcInterpolationNotImplemented()));
    AssertDimension(matrix.m(), source.n_dofs_per_face(face_no));
    AssertDimension(matrix.n(), this->n_dofs_per_face(face_no));
    const auto &points = source.get_unit_face_support_points(face_no);
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < matrix.n(); ++j)
        matrix(i, j) = trace_value(j, scale * points[i][0] + shift);
  }


  void
  FE_Serendipity::get_face_interpolation_matrix(
    const FiniteElement<dim, spacedim> &source,
    FullMatrix<double>                 &matrix,
    const unsigned int                  face_no) const
  {
    fill_face_matrix(source, face_no, 1., 0., matrix);
  }


  void
  FE_Serendipity::get_subface_interpolation_matrix(
    const FiniteElement<dim, spacedim> &source,
    const unsigned int                  subface,
    FullMatrix<double>                 &matrix,
    const unsigned int                  face_no) const
  {
    AssertIndexRange(subface, 2);
    fill_face_matrix(source, face_no, .5, .5 * subface, matrix);
  }


  bool
  FE_Serendipity::hp_constraints_are_implemented() const
  {
    return true;
  }


  std::vector<std::pair<unsigned int, unsigned int>>
  FE_Serendipity::hp_vertex_dof_identities(
    const FiniteElement<dim, spacedim> &other) const
  {
    return identity_if(is_serendipity(other));
  }


  std::vector<std::pair<unsigned int, unsigned int>>
  FE_Serendipity::hp_line_dof_identities(
    const FiniteElement<dim, spacedim> &other) const
  {
    return identity_if(is_serendipity(other));
  }


  std::vector<std::pair<unsigned int, unsigned int>>
  FE_Serendipity::hp_quad_dof_identities(const FiniteElement<dim, spacedim> &,
                                         const unsigned int) const
  {
    return {};
  }


  FiniteElementDomination::Domination
  FE_Serendipity::compare_for_domination(
    const FiniteElement<dim, spacedim> &other,
    const unsigned int) const
  {
    return is_serendipity(other) ?
             FiniteElementDomination::either_element_can_dominate :
             FiniteElementDomination::neither_element_dominates;
  }
} // namespace Nacre
