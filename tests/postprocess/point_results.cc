// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Quantities at a point against closed forms: stresses, forces and moments in
// axes of the user's, on cells of both orientations; principal values and
// their directions; rotations of the normal, large ones too; the transverse
// shear of cubic deflections, which is exact at p = 3, beside a cell of
// opposite orientation, beside a crease and on a strip of single cells; and
// what is said where an axis is normal to the surface.

#include "../tests_common.h"
#include "square_model.h"
#include <nacre/postprocess/point_quantities.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

using namespace Tests;

namespace
{
  const double E = 1000., nu = 0.3, h = 0.1;
  const double C = E * h / (1. - nu * nu), D = C * h * h / 12.;

  double
  evaluate(const ShellState &state, const std::string &text)
  {
    QuantityPhrase phrase{text, "test"};
    const auto     quantity = parse_point_quantity(phrase, {});
    AssertThrow(quantity, ExcMessage("no quantity " + text));
    return evaluate_point_quantity(state, *quantity);
  }

  void
  check_value(const std::string &name,
              const ShellState  &state,
              const std::string &text,
              const double       exact,
              const double       scale)
  {
    check_below(name + ": " + text,
                std::abs(evaluate(state, text) - exact) / scale,
                1e-10);
  }

  /** 3 x 2 parallelograms; the cell @p flipped has the normal -z. */
  Mesh
  parallelograms(const unsigned int flipped = numbers::invalid_unsigned_int)
  {
    Mesh mesh;
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        mesh.vertices.emplace_back(i + 0.3 * j, 0.8 * j - 0.1 * i, 0.);
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int v = 4 * j + i;
          mesh.cells.push_back({{v, v + 1, v + 4, v + 5}});
          if (mesh.cells.size() == flipped + 1)
            std::swap(mesh.cells.back()[1], mesh.cells.back()[2]);
        }
    return mesh;
  }

  const double k1 = 0.03, k2 = -0.01, k12 = 0.02, a = 2e-3, b = 1e-3;

  /** Stretch a along x, shear b, curvatures k1, k2, k12. */
  Vector3
  quadratic(const Point<3> &x)
  {
    return Point<3>(a * x[0] + b * x[1],
                    0.,
                    -0.5 * (k1 * x[0] * x[0] + k2 * x[1] * x[1] +
                            2. * k12 * x[0] * x[1]));
  }

  /** Points of the cells 4, which is turned over, and 1. */
  const std::string in_flipped = "(1.9, 1.0, 0)", in_other = "(1.7, 0.2, 0)";

  void
  test_axes(const Element &element)
  {
    const Parameters  parameters(section_text(E, nu, h));
    const auto        mesh  = make_discretization(parallelograms(4), element);
    const auto        u     = interpolate(*mesh, quadratic);
    auto              model = square_model(parameters.section);
    const ShellState  state{*mesh, model, u};
    const std::string name = label(element);
    const double      m11  = D * (k1 + nu * k2);
    const double      m22  = D * (k2 + nu * k1);
    const double      m12  = D * (1. - nu) * k12;
    const double      n11 = C * a, n12 = 0.5 * (1. - nu) * C * b;

    // Each cell's own normal is up, or down in the cell turned over.
    if (element.type != ElementType::triangle)
      {
        check_value(name, state, "moment 11 along x at " + in_other, m11, D);
        check_value(name, state, "moment 11 along x at " + in_flipped, -m11, D);
      }
    model.result_axes.top       = VectorExpression(Vector3({0.1, 0., 2.}));
    model.result_axes.direction = VectorExpression(Vector3({0., 3., 1.}));
    for (const auto &at : {" at " + in_other, " at " + in_flipped})
      {
        // Axis 1 = y, axis 2 = z x y = -x.
        check_value(name, state, "moment 11" + at, m22, D);
        check_value(name, state, "moment 12" + at, -m12, D);
        check_value(name, state, "moment 12 along x" + at, m12, D);
        check_value(name,
                    state,
                    "moment 11 along (1, 1, 5)" + at,
                    0.5 * (m11 + m22) + m12,
                    D);
        check_value(name, state, "membrane force 22" + at, n11, C);
        check_value(name, state, "membrane force 12 along x" + at, n12, C);
        check_value(name, state, "stress 22 middle" + at, n11 / h, C / h);
        check_value(name,
                    state,
                    "stress 11 top along x" + at,
                    n11 / h + 6. * m11 / (h * h),
                    C / h);
        check_value(name,
                    state,
                    "stress 12 bottom along x" + at,
                    n12 / h - 6. * m12 / (h * h),
                    C / h);
        const double mean   = 0.5 * (m11 + m22);
        const double radius = std::hypot(0.5 * (m11 - m22), m12);
        check_value(name, state, "principal moment 1" + at, mean + radius, D);
        check_value(name, state, "principal moment 2" + at, mean - radius, D);
      }
  }

  /** T d = s d, d tangent and of length 1, the larger value first. */
  void
  test_principal()
  {
    const Parameters parameters(section_text(E, nu, h));
    const auto       mesh =
      make_discretization(parallelograms(), Element{ElementType::lagrange, 2});
    const auto  u     = interpolate(*mesh, quadratic);
    auto        model = square_model(parameters.section);
    CellResults results({*mesh, model, u}, QMidpoint<2>(), false);
    double      error  = 0.;
    bool        sorted = true;
    for (const auto &cell : mesh->dof_handler().active_cell_iterators())
      {
        results.reinit(cell);
        const auto r = results.at(0);
        for (const auto &S : r.stress)
          {
            const auto pairs = r.principal(S);
            sorted           = sorted && pairs[0].value >= pairs[1].value;
            for (const auto &[value, direction] : pairs)
              error = std::max(error,
                               ((S * direction - value * direction).norm() /
                                  S.norm() +
                                std::abs(direction.norm() - 1.)));
          }
      }
    check_below("principal stresses and their directions", error, 1e-12);
    check_below("the larger one first", sorted ? 0. : 1., 0.5);
  }

  void
  test_rotation()
  {
    const Parameters parameters(section_text(E, nu, h));
    const auto       mesh =
      make_discretization(parallelograms(4), Element{ElementType::lagrange, 2});
    auto         model = square_model(parameters.section);
    const double slope = 0.01;
    // t0 = (0, 0, 1) turns about y by minus the slope of w along x.
    const auto small = interpolate(*mesh, [=](const Point<3> &x) {
      return Point<3>(0., 0., slope * x[0] - 2. * slope * x[1]);
    });
    for (const auto &at : {" at " + in_other, " at " + in_flipped})
      {
        const ShellState state{*mesh, model, small};
        check_value("linear", state, "rotation y" + at, -slope, slope);
        check_value("linear",
                    state,
                    "rotation (-2, 0, 0)" + at,
                    2. * slope,
                    slope);
        check_value("linear", state, "rotation z" + at, 0., slope);
      }
    // A rigid rotation about y by an angle beyond a quarter.
    const double angle  = 2.2;
    const auto   turned = interpolate(*mesh, [=](const Point<3> &x) {
      return Point<3>((std::cos(angle) - 1.) * x[0],
                      0.,
                      -std::sin(angle) * x[0]);
    });
    for (const auto kinematics :
         {KinematicsModel::corotational, KinematicsModel::finite})
      {
        model.kinematics.model = kinematics;
        const ShellState  state{*mesh, model, turned};
        const std::string name = name_of(kinematics);
        for (const auto &at : {" at " + in_other, " at " + in_flipped})
          {
            check_value(name, state, "rotation y" + at, angle, 1.);
            check_value(name, state, "rotation x" + at, 0., 1.);
            check_value(name, state, "stress 11 top along x" + at, 0., E);
          }
      }
  }

  const double c30 = 0.02, c21 = -0.01, c12 = 0.015, c03 = 0.01;

  double
  cubic(const double x, const double y)
  {
    return c30 * x * x * x + c21 * x * x * y + c12 * x * y * y +
           c03 * y * y * y;
  }

  /** -D grad lap w */
  const double q1 = -D * (6. * c30 + 2. * c12);
  const double q2 = -D * (2. * c21 + 6. * c03);

  void
  test_shear(const unsigned int p)
  {
    const Parameters parameters(section_text(E, nu, h));
    const Element    element{ElementType::lagrange, p};
    auto             model = square_model(parameters.section);
    model.result_axes.top  = VectorExpression(Vector3({0., 0., 1.}));
    const std::string name = "p = " + std::to_string(p);
    {
      const auto       mesh = make_discretization(parallelograms(4), element);
      const auto       u    = interpolate(*mesh, [](const Point<3> &x) {
        return Point<3>(0., 0., cubic(x[0], x[1]));
      });
      const ShellState state{*mesh, model, u};
      for (const auto &at : {" at " + in_other, " at " + in_flipped})
        {
          check_value(name, state, "transverse shear 1 along x" + at, q1, D);
          check_value(name, state, "transverse shear 2 along x" + at, q2, D);
        }
    }
    {
      // A second leg that rises by 45 degrees, with deflections of its own.
      const double c = std::sqrt(0.5);
      Mesh         mesh;
      for (int i = -2; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          mesh.vertices.emplace_back(i < 0 ? 2. + i : 2. + c * i,
                                     0.7 * j,
                                     i < 0 ? 0. : c * i);
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          mesh.cells.push_back(
            {{3 * i + j, 3 * i + j + 3, 3 * i + j + 1, 3 * i + j + 4}});
      const auto       folded = make_discretization(mesh, element);
      const auto       u      = interpolate(*folded, [=](const Point<3> &x) {
        const double w = 7. * c30 * std::pow(x[2] / c, 3);
        return Point<3>(-c * w, 0., c * w + cubic(std::min(x[0], 2.), x[1]));
      });
      const ShellState state{*folded, model, u};
      check_value(name + ", crease",
                  state,
                  "transverse shear 1 along x at (1.7, 0.4, 0)",
                  q1,
                  D);
      check_value(name + ", crease",
                  state,
                  "transverse shear 1 along x at (2.3, 0.4, 0.3)",
                  -42. * D * c30,
                  D);
    }
    {
      Mesh mesh;
      for (unsigned int i = 0; i < 5; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          mesh.vertices.emplace_back(i, 0.5 * j, 0.);
      for (unsigned int i = 0; i < 4; ++i)
        mesh.cells.push_back({{2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 3}});
      const auto strip = make_discretization(mesh, element);
      const auto u     = interpolate(*strip, [](const Point<3> &x) {
        return Point<3>(0., 0., c30 * x[0] * x[0] * x[0]);
      });
      check_value(name + ", strip",
                  {*strip, model, u},
                  "transverse shear 1 along x at (1.2, 0.1, 0)",
                  -6. * D * c30,
                  D);
    }
  }

  void
  test_messages()
  {
    const Parameters parameters(section_text(E, nu, h));
    const auto       mesh =
      make_discretization(parallelograms(), Element{ElementType::lagrange, 2});
    const auto u     = interpolate(*mesh, quadratic);
    auto       model = square_model(parameters.section);
    const auto say   = [&](const std::string &text) {
      try
        {
          evaluate({*mesh, model, u}, text);
          std::cout << text << ": no error" << std::endl;
        }
      catch (const ExceptionBase &error)
        {
          std::ostringstream message;
          error.print_info(message);
          std::cout << text << ':' << message.str();
        }
    };
    say("moment 11 along z at " + in_other);
    say("moment 13 at " + in_other);
    say("stress 11 upper at " + in_other);
    say("stress 11 top");
    say("von Mises stress top along x at " + in_other);
    say("rotation normal at " + in_other);
    model.result_axes.top = VectorExpression(Vector3({1., 0., 0.}));
    say("moment 11 at " + in_other);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int p : {2, 4})
    test_axes(Element{ElementType::lagrange, p});
  test_axes(triangle);
  test_principal();
  test_rotation();
  for (const unsigned int p : {3, 4})
    test_shear(p);
  test_messages();
  return n_failures == 0 ? 0 : 1;
}
