// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Every residual of the estimator is raised by the perturbation that it
// measures, by the right amount, and by no other: on a plate whose interior
// cells see exact solutions, kinks, and jumps of curvature, shear and stretch.
// Rigid motions of a curved mesh with hanging nodes cause none, a cell of
// opposite orientation changes nothing.

#include "../tests_common.h"
#include "square_model.h"
#include <nacre/postprocess/error_estimator.h>
#include <nacre/postprocess/error_weight.h>

#include <deal.II/base/mpi.h>

using namespace Tests;

namespace
{
  const double E = 1000., nu = 0.3, t = 0.1;
  const double C = E * t / (1. - nu * nu), D = C * t * t / 12.;
  const double eta = 5., size = 0.25;

  const std::array<Residual, n_residuals> residuals = {{Residual::equilibrium,
                                                        Residual::traction,
                                                        Residual::moment,
                                                        Residual::rotation}};
  const std::array<std::string, n_residuals> names  = {
     {"equilibrium", "traction", "moment", "rotation"}};

  /** 4 x 4 squares of the unit square. */
  Mesh
  squares(const unsigned int flipped = numbers::invalid_unsigned_int)
  {
    Mesh mesh;
    for (unsigned int j = 0; j < 5; ++j)
      for (unsigned int i = 0; i < 5; ++i)
        mesh.vertices.emplace_back(size * i, size * j, 0.);
    for (unsigned int j = 0; j < 4; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int v = 5 * j + i;
          mesh.cells.push_back({{v, v + 1, v + 5, v + 6}});
          if (mesh.cells.size() == flipped + 1)
            std::swap(mesh.cells.back()[1], mesh.cells.back()[2]);
        }
    return mesh;
  }

  /** A mesh and what an estimate on it needs. */
  struct Plate
  {
    Plate(const Mesh &mesh, const Element &element)
      : parameters(section_text(E, nu, t))
      , discretization(make_discretization(mesh, element))
      , penalty(*discretization,
                parameters.section,
                element.full_quadrature(),
                eta)
      , model(square_model(parameters.section,
                           element.type == ElementType::serendipity ?
                             MembraneStrain::reduced :
                             MembraneStrain::tied))
      , estimator(*discretization, model, penalty)
    {}

    ErrorIndicators
    estimate(const VectorField &field) const
    {
      const auto u = interpolate(*discretization, field);
      return estimator.estimate({&u, true});
    }

    /** Sums over the cells that don't touch the boundary. */
    std::array<double, n_residuals>
    interior(const VectorField &field) const
    {
      const auto                      indicators = estimate(field);
      std::array<double, n_residuals> sums{};
      for (const auto &cell :
           discretization->triangulation().active_cell_iterators())
        if (!cell->at_boundary())
          for (unsigned int r = 0; r < n_residuals; ++r)
            sums[r] += indicators.part(cell->active_cell_index(), residuals[r]);
      return sums;
    }

    Parameters                      parameters;
    std::unique_ptr<Discretization> discretization;
    EdgePenalty                     penalty;
    ShellModel                      model;
    ErrorEstimator                  estimator;
  };

  Vector3
  deflection(const double w)
  {
    Vector3 u;
    u[2] = w;
    return u;
  }

  /** max(x - 1/2, 0), 0 to the left of the middle line. */
  double
  right(const Point<3> &x)
  {
    return std::max(x[0] - 0.5, 0.);
  }

  /** That @p raised is @p expected, and that no other residual is there. */
  void
  check_only(const std::string                     &name,
             const std::array<double, n_residuals> &sums,
             const Residual                         raised,
             const double                           expected)
  {
    for (unsigned int r = 0; r < n_residuals; ++r)
      if (residuals[r] == raised)
        check_below(name + ": " + names[r],
                    std::abs(sums[r] / expected - 1.),
                    1e-8);
      else
        check_below(name + ": no " + names[r], sums[r] / expected, 1e-12);
  }

  void
  test_single_residuals(const unsigned int p)
  {
    const Plate       plate(squares(), Element{ElementType::lagrange, p});
    const std::string name = "p = " + std::to_string(p);
    // k of the reference cell over the size; W_n = 1/(D k^4).
    const double k      = resolved_wave_number(p) / size;
    const double W_n    = 1. / (D * std::pow(k, 4));
    const double G      = 0.5 * (1. - nu) * C;
    const double W_t    = 0.5 * (1. / C + 1. / G) / (k * k);
    const double length = 0.5; // of the middle line in interior cells
    const double area   = 0.25;

    check_only(name + ", kink",
               plate.interior(
                 [](const auto &x) { return deflection(right(x)); }),
               Residual::rotation,
               eta / (size / 4.) * D * length);
    check_only(name + ", jump of curvature",
               plate.interior([](const auto &x) {
                 return deflection(std::pow(right(x), 2));
               }),
               Residual::moment,
               0.25 * std::pow(k, 3) * W_n * 4. * D * D * length);
    check_only(name + ", jump of stretch",
               plate.interior([](const auto &x) {
                 Vector3 u;
                 u[0] = right(x);
                 return u;
               }),
               Residual::traction,
               0.25 * k * W_t * C * C * length);
    // w = (x - 1/2)+ y^2: shear 2 D, and 2 (1 - nu) D of the twist
    const auto twisted = plate.interior(
      [](const auto &x) { return deflection(right(x) * x[1] * x[1]); });
    check_below(name + ", jump of twist: traction",
                std::abs(twisted[1] / (0.25 * k * W_n * length *
                                       std::pow(2. * D * (2. - nu), 2)) -
                         1.),
                1e-8);
    if (p >= 3)
      check_only(name + ", jump of shear",
                 plate.interior([](const auto &x) {
                   return deflection(std::pow(right(x), 3));
                 }),
                 Residual::traction,
                 0.25 * k * W_n * 36. * D * D * length);
    if (p >= 4)
      check_only(name + ", unbalanced",
                 plate.interior([](const auto &x) {
                   return deflection(x[0] * x[0] * x[1] * x[1]);
                 }),
                 Residual::equilibrium,
                 W_n * 64. * D * D * area);
  }

  double
  sum(const std::array<double, n_residuals> &sums)
  {
    return sums[0] + sums[1] + sums[2] + sums[3];
  }

  /** What needs no forces has no residual, hanging nodes or not. */
  void
  test_exact_solutions(const Element &element)
  {
    Mesh mesh = squares();
    if (element.type != ElementType::triangle)
      mesh.refined = {5};
    const Plate plate(mesh, element);
    const auto  biharmonic = [&](const Point<3> &x) {
      Vector3 u;
      u[0] = 2. * x[0] - x[1];
      u[1] = x[1] + 3. * x[0];
      u[2] = x[0] * x[0] - 3. * x[0] * x[1] - x[1] * x[1];
      if (element.degree >= 3)
        u[2] += std::pow(x[0], 3) - 3. * x[0] * x[1] * x[1];
      return u;
    };
    const double size_of_kink =
      sum(plate.interior([](const auto &x) { return deflection(right(x)); }));
    check_below(label(element) + ": exact solution",
                sum(plate.interior(biharmonic)) / size_of_kink,
                1e-12);
  }

  void
  test_rigid_motion(const unsigned int p)
  {
    Mesh mesh    = squares();
    mesh.map     = bend;
    mesh.refined = {5, 10};
    const Plate       plate(mesh, Element{ElementType::lagrange, p});
    const VectorField rotation = [](const Point<3> &x) {
      return cross_product_3d(Vector3(Point<3>(0.3, -0.5, 0.8)), Vector3(x)) +
             Vector3(Point<3>(1., 2., 3.));
    };
    const auto communicator = plate.discretization->communicator();
    check_below("p = " + std::to_string(p) + ": rigid motion",
                plate.estimate(rotation).total(communicator) /
                  plate.estimate(some_field).total(communicator),
                1e-15);
  }

  /** A cell of opposite orientation: the same residuals. */
  void
  test_orientation()
  {
    std::array<double, 2> totals;
    for (unsigned int k = 0; k < 2; ++k)
      {
        Mesh mesh = squares(k == 0 ? numbers::invalid_unsigned_int : 6);
        mesh.map  = bend;
        const Plate plate(mesh, Element{ElementType::lagrange, 3});
        totals[k] = plate.estimate(some_field).total(MPI_COMM_WORLD);
      }
    check_below("opposite orientation",
                std::abs(totals[1] / totals[0] - 1.),
                1e-8);
  }

  /** Products of two fields: symmetric squares, and linear. */
  void
  test_products()
  {
    Mesh mesh    = squares();
    mesh.map     = bend;
    mesh.refined = {5};
    const Plate plate(mesh, Element{ElementType::lagrange, 2});
    const auto  u = interpolate(*plate.discretization, some_field);
    const auto  z = interpolate(*plate.discretization, [](const auto &x) {
      return deflection(std::exp(x[0] - x[1]));
    });
    auto        v = u;
    v.add(1., z);
    const auto   products = plate.estimator.estimate({&u, false}, {&z, false});
    const double uu       = products[0].total(MPI_COMM_WORLD);
    const double zz       = products[1].total(MPI_COMM_WORLD);
    const double uz       = products[2].total(MPI_COMM_WORLD);
    const double vv =
      plate.estimator.estimate({&v, false}).total(MPI_COMM_WORLD);
    check_below("square of a sum",
                std::abs((uu + 2. * uz + zz) / vv - 1.),
                1e-10);
    check_below(
      "first square",
      std::abs(plate.estimator.estimate({&u, true}).total(MPI_COMM_WORLD) / uu -
               1.),
      1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (unsigned int p = 2; p <= 4; ++p)
    test_single_residuals(p);
  for (unsigned int p = 2; p <= 4; ++p)
    test_exact_solutions(Element{ElementType::lagrange, p});
  test_exact_solutions(serendipity);
  test_exact_solutions(triangle);
  for (unsigned int p = 2; p <= 3; ++p)
    test_rigid_motion(p);
  test_orientation();
  test_products();
  return n_failures == 0 ? 0 : 1;
}
