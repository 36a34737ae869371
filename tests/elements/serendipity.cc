// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// FE_Serendipity on its own: nodes, space, derivatives, the matrices between
// cells and faces, refused arguments.

#include "element_tests.h"

#include <deal.II/base/geometry_info.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/lac/full_matrix.h>

#include <cstdint>
#include <functional>
#include <sstream>

using namespace ElementTests;

/** Points without any symmetry. */
const std::vector<Point<2>> points = {
  {{.13, .71}, {.92, .05}, {.5, .5}, {.31, .29}, {1., .6}, {.77, .98}}};

/** The space's monomials. */
const std::vector<std::function<double(const Point<2> &)>> monomials = {
  {[](const auto &) { return 1.; },
   [](const auto &p) { return p[0]; },
   [](const auto &p) { return p[1]; },
   [](const auto &p) { return p[0] * p[1]; },
   [](const auto &p) { return p[0] * p[0]; },
   [](const auto &p) { return p[1] * p[1]; },
   [](const auto &p) { return p[0] * p[0] * p[1]; },
   [](const auto &p) { return p[0] * p[1] * p[1]; }}};

void
test_space(const FE_Serendipity &fe)
{
  const FE_Q<2, 3> fe_q(2);
  double           delta = 0., unity = 0., order = 0., monomial = 0.;
  for (unsigned int i = 0; i < 8; ++i)
    {
      raise(order,
            fe.unit_support_point(i).distance(fe_q.unit_support_point(i)));
      for (unsigned int j = 0; j < 8; ++j)
        raise(delta,
              std::abs(fe.shape_value(i, fe.unit_support_point(j)) -
                       (i == j ? 1. : 0.)));
    }
  for (const auto &p : points)
    {
      double sum = -1.;
      for (unsigned int i = 0; i < 8; ++i)
        sum += fe.shape_value(i, p);
      raise(unity, std::abs(sum));
      for (const auto &f : monomials)
        {
          double difference = -f(p);
          for (unsigned int i = 0; i < 8; ++i)
            difference += f(fe.unit_support_point(i)) * fe.shape_value(i, p);
          raise(monomial, std::abs(difference));
        }
    }
  check_below("one at its node, zero at the others", delta, 1e-15);
  check_below("nodes in FE_Q's order", order, 1e-15);
  check_below("partition of unity", unity, 1e-14);
  check_below("reproduces the 8 monomials", monomial, 1e-14);
}

/** Central differences of the derivatives one order below. */
template <int order>
double
difference_error(
  const std::function<Tensor<order, 2>(const unsigned int, const Point<2> &)>
                                                              &lower,
  const std::function<Tensor<order + 1, 2>(const unsigned int,
                                           const Point<2> &)> &derivative)
{
  const double step  = 1e-4;
  double       error = 0.;
  for (const auto &p : points)
    for (unsigned int i = 0; i < 8; ++i)
      for (unsigned int a = 0; a < 2; ++a)
        {
          const Tensor<1, 2> e = step * Point<2>::unit_vector(a);
          // Any index may be the newest one: derivatives commute.
          Tensor<order, 2> difference(derivative(i, p)[a]);
          difference -= (lower(i, p + e) - lower(i, p - e)) / (2. * step);
          raise(error, difference.norm());
        }
  return error;
}

void
test_derivatives(const FE_Serendipity &fe)
{
  const auto value = [&](const unsigned int i, const Point<2> &p) {
    return Tensor<0, 2>(fe.shape_value(i, p));
  };
  const auto first = [&](const unsigned int i, const Point<2> &p) {
    return fe.shape_grad(i, p);
  };
  const auto second = [&](const unsigned int i, const Point<2> &p) {
    return fe.shape_grad_grad(i, p);
  };
  const auto third = [&](const unsigned int i, const Point<2> &p) {
    return fe.shape_3rd_derivative(i, p);
  };
  const auto fourth = [&](const unsigned int i, const Point<2> &p) {
    return fe.shape_4th_derivative(i, p);
  };
  check_below("gradients", difference_error<0>(value, first), 1e-7);
  check_below("second derivatives", difference_error<1>(first, second), 1e-7);
  check_below("third derivatives", difference_error<2>(second, third), 1e-7);
  check_below("fourth derivatives", difference_error<3>(third, fourth), 1e-7);
}

/** The evaluation of all at once, as FEValues does it. */
void
test_evaluate(const FE_Serendipity &fe)
{
  std::vector<double>       values(8);
  std::vector<Tensor<1, 2>> first(8);
  std::vector<Tensor<2, 2>> second(8);
  std::vector<Tensor<3, 2>> third(8), none_third;
  std::vector<Tensor<4, 2>> fourth(8), none_fourth;
  double                    error = 0.;
  const auto               &space = fe.get_poly_space();
  for (const auto &p : points)
    {
      space.evaluate(p, values, first, second, third, fourth);
      for (unsigned int i = 0; i < 8; ++i)
        {
          raise(error, std::abs(values[i] - fe.shape_value(i, p)));
          raise(error, (first[i] - fe.shape_grad(i, p)).norm());
          raise(error, (second[i] - fe.shape_grad_grad(i, p)).norm());
          raise(error, (third[i] - fe.shape_3rd_derivative(i, p)).norm());
          raise(error, fourth[i].norm());
        }
      space.evaluate(p, values, first, second, none_third, none_fourth);
    }
  check_below("all at once", error, 1e-14);
  const auto copy = space.clone();
  check_below("copy of the polynomials",
              std::abs(copy->compute_value(5, points[0]) -
                       fe.shape_value(5, points[0])),
              1e-15);
}

/** Where a function doesn't have support on a face, it vanishes there. */
void
test_faces(const FE_Serendipity &fe)
{
  const FE_Q<2, 3> fe_q(2);
  double           hidden = 0., nodes = 0.;
  unsigned int     n_supports = 0, n_differences = 0;
  for (unsigned int face = 0; face < 4; ++face)
    {
      for (unsigned int i = 0; i < 8; ++i)
        {
          const bool has_support = fe.has_support_on_face(i, face);
          n_supports += (has_support ? 1 : 0);
          n_differences +=
            (has_support == fe_q.has_support_on_face(i, face) ? 0 : 1);
          for (const double x : {.1, .4, .85})
            {
              const double side = face % 2;
              const auto   p = face < 2 ? Point<2>(side, x) : Point<2>(x, side);
              if (!has_support)
                raise(hidden, std::abs(fe.shape_value(i, p)));
            }
        }
      for (unsigned int j = 0; j < 3; ++j)
        {
          const double side = face % 2;
          const double x    = fe.get_unit_face_support_points(face)[j][0];
          const auto   p    = face < 2 ? Point<2>(side, x) : Point<2>(x, side);
          raise(nodes,
                p.distance(
                  fe.unit_support_point(fe.face_to_cell_index(j, face))));
        }
    }
  check_equal("functions with support on faces", n_supports, 12);
  check_equal("where FE_Q says otherwise", n_differences, 0);
  check_below("the others vanish there", hidden, 1e-14);
  check_below("nodes of faces", nodes, 1e-15);
}

double
difference(const FullMatrix<double> &a, const FullMatrix<double> &b)
{
  FullMatrix<double> c(a);
  c.add(-1., b);
  return c.linfty_norm();
}

void
test_face_matrices(const FE_Serendipity &fe)
{
  const FE_Q<2, 3> fe_q(2), fe_q3(3);
  double           face_error = 0., subface_error = 0.;
  for (unsigned int face = 0; face < 4; ++face)
    for (const auto *other :
         std::vector<const FiniteElement<2, 3> *>{&fe, &fe_q, &fe_q3})
      {
        const unsigned int n = other->n_dofs_per_face(face);
        // FE_Q only knows elements of its own: give it its equal for ours.
        const FiniteElement<2, 3> &known =
          other == &fe ? static_cast<const FiniteElement<2, 3> &>(fe_q) :
                         *other;
        FullMatrix<double> found(n, 3), expected(n, 3);
        fe.get_face_interpolation_matrix(*other, found, face);
        fe_q.get_face_interpolation_matrix(known, expected, face);
        raise(face_error, difference(found, expected));
        for (unsigned int subface = 0; subface < 2; ++subface)
          {
            fe.get_subface_interpolation_matrix(*other, subface, found, face);
            fe_q.get_subface_interpolation_matrix(known,
                                                  subface,
                                                  expected,
                                                  face);
            raise(subface_error, difference(found, expected));
          }
      }
  check_below("faces as FE_Q(2)'s", face_error, 1e-12);
  check_below("halves of faces as FE_Q(2)'s", subface_error, 1e-12);
  check_below("constraints of hanging nodes as FE_Q(2)'s",
              difference(fe.constraints(), fe_q.constraints()),
              1e-12);
}

void
test_transfer(const FE_Serendipity &fe)
{
  double             embedding = 0.;
  FullMatrix<double> product(8, 8), both(8, 8);
  for (unsigned int child = 0; child < 4; ++child)
    {
      const auto &P = fe.get_prolongation_matrix(child);
      for (const auto &p : points)
        for (unsigned int j = 0; j < 8; ++j)
          {
            double value = -fe.shape_value(
              j,
              GeometryInfo<2>::child_to_cell_coordinates(p, child));
            for (unsigned int i = 0; i < 8; ++i)
              value += P(i, j) * fe.shape_value(i, p);
            raise(embedding, std::abs(value));
          }
      // Not additive: what several children give is the same, and counts once.
      fe.get_restriction_matrix(child).mmult(product, P);
      for (unsigned int i = 0; i < 8; ++i)
        for (unsigned int j = 0; j < 8; ++j)
          if (product(i, j) != 0. && !fe.restriction_is_additive(i))
            both(i, j) = product(i, j);
    }
  check_below("prolongation is exact", embedding, 1e-14);
  check_below("restriction after prolongation",
              difference(both, FullMatrix<double>(IdentityMatrix(8))),
              1e-14);
  check_equal("transfer is implemented",
              fe.isotropic_prolongation_is_implemented() &&
                fe.isotropic_restriction_is_implemented(),
              1);
}

void
test_interpolation(const FE_Serendipity &fe)
{
  FullMatrix<double> same(8, 8), from_q1(8, 4), from_q2(8, 9);
  fe.get_interpolation_matrix(fe, same);
  fe.get_interpolation_matrix(FE_Q<2, 3>(1), from_q1);
  fe.get_interpolation_matrix(FE_Q<2, 3>(2), from_q2);
  check_below("interpolation of itself",
              difference(same, FullMatrix<double>(IdentityMatrix(8))),
              1e-14);
  double error = 0.;
  for (unsigned int i = 0; i < 8; ++i)
    {
      const auto p = fe.unit_support_point(i);
      for (unsigned int j = 0; j < 4; ++j)
        raise(error,
              std::abs(from_q1(i, j) -
                       GeometryInfo<2>::d_linear_shape_function(p, j)));
      for (unsigned int j = 0; j < 9; ++j)
        raise(error, std::abs(from_q2(i, j) - (i == j ? 1. : 0.)));
    }
  check_below("interpolation of FE_Q", error, 1e-14);

  std::vector<Vector<double>> values(8, Vector<double>(1));
  std::vector<double>         dofs(8);
  for (unsigned int i = 0; i < 8; ++i)
    values[i](0) = i + .5;
  fe.convert_generalized_support_point_values_to_dof_values(values, dofs);
  error = 0.;
  for (unsigned int i = 0; i < 8; ++i)
    raise(error, std::abs(dofs[i] - (i + .5)));
  check_below("values at nodes are dofs", error, 1e-15);
}

void
test_errors_and_names(const FE_Serendipity &fe)
{
  const FESystem<2, 3> system(fe, 3);
  std::cout << fe.get_name() << ", " << fe.clone()->get_name() << ", "
            << system.get_name() << std::endl;
  check_equal("a clone is equal", *fe.clone() == fe, 1);
  check_equal("FE_Q isn't", FE_Q<2, 3>(2) == fe, 0);
  check_equal("dofs of the product", system.n_dofs_per_cell(), 24);
  check_equal("constant modes", fe.get_constant_modes().first(0, 7), 1);
  check_equal("its neighbours",
              fe.compare_for_domination(fe, 1) ==
                  FiniteElementDomination::either_element_can_dominate &&
                fe.compare_for_domination(FE_Q<2, 3>(2), 1) ==
                  FiniteElementDomination::neither_element_dominates,
              1);
  for (const unsigned int degree : {0, 1, 3})
    try
      {
        const FE_Serendipity refused(degree);
        std::cout << "degree " << degree << " isn't refused" << std::endl;
        ++n_failures;
      }
    catch (const ExceptionBase &error)
      {
        std::ostringstream message;
        error.print_info(message);
        std::cout << message.str();
      }
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const FE_Serendipity             fe(2);
  test_space(fe);
  test_derivatives(fe);
  test_evaluate(fe);
  test_faces(fe);
  test_face_matrices(fe);
  test_transfer(fe);
  test_interpolation(fe);
  test_errors_and_names(fe);
  return n_failures > 0;
}
