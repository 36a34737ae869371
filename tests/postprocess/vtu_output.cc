// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Fields of the output against closed forms: a plate under uniform stretch and
// curvature on a distorted mesh, a cylinder that expands; the files written on
// one rank and on several, their arrays, and the message of a bad folder.

#include "square_model.h"
#include <nacre/base/mpi_errors.h>
#include <nacre/mechanics/linear_elastic_section.h>
#include <nacre/postprocess/vtu_output.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/symmetric_tensor.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>

using namespace Nacre;

namespace
{
  using Displacement = std::function<Tensor<1, 3>(const Point<3> &)>;
  using Exact =
    std::map<std::string, std::function<std::vector<double>(const Point<3> &)>>;

  const double E = 1000., nu = 0.25, h = 0.2;
  const double D_n = E * h / (1. - nu * nu);
  const double D_m = D_n * h * h / 12.;

  void
  report(const bool good, const std::string &text)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << (good ? "OK   " : "FAIL ") << text << std::endl;
  }

  const LinearElasticSection &
  section()
  {
    static const LinearElasticSection section(E, nu, h);
    return section;
  }

  TrilinosWrappers::MPI::Vector
  interpolate(const Discretization &discretization, const Displacement &u)
  {
    const auto                   &node_dofs = discretization.node_dofs();
    TrilinosWrappers::MPI::Vector owned(discretization.locally_owned_dofs(),
                                        MPI_COMM_WORLD);
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto nodes = discretization.node_positions(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (discretization.locally_owned_dofs().is_element(
                  dofs[node_dofs[i]]))
              owned(dofs[node_dofs[i]]) = u(nodes[i / 3])[i % 3];
        }
    owned.compress(VectorOperation::insert);
    TrilinosWrappers::MPI::Vector ghosted(
      discretization.locally_owned_dofs(),
      discretization.locally_relevant_dofs(),
      MPI_COMM_WORLD);
    ghosted = owned;
    return ghosted;
  }

  /** Plate [0,2] x [0,1], 3 x 2 cells with slanted lines, refined once. */
  std::unique_ptr<Discretization>
  make_plate(const unsigned int degree)
  {
    auto mesh = std::make_unique<parallel::distributed::Triangulation<2, 3>>(
      MPI_COMM_WORLD);
    GridGenerator::subdivided_hyper_rectangle(*mesh,
                                              {3, 2},
                                              Point<2>(0, 0),
                                              Point<2>(2, 1));
    GridTools::transform(
      [](const Point<3> &x) {
        return Point<3>(x[0] + 0.2 * x[0] * x[1], x[1] - 0.1 * x[0], 0.);
      },
      *mesh);
    mesh->refine_global(1);
    return std::make_unique<Discretization>(
      std::move(mesh),
      [](const auto &cell, const auto &unit) {
        Point<3> x;
        for (unsigned int v = 0; v < 4; ++v)
          x +=
            GeometryInfo<2>::d_linear_shape_function(unit, v) * cell->vertex(v);
        return x;
      },
      Element{ElementType::lagrange, degree},
      0);
  }

  /** Plate [0,2] x [0,1] of slanted 6-node triangles. */
  std::unique_ptr<Discretization>
  make_triangles()
  {
    auto mesh =
      std::make_unique<parallel::shared::Triangulation<2, 3>>(MPI_COMM_WORLD);
    const unsigned int       n = 4, m = 3;
    std::vector<Point<3>>    vertices;
    std::vector<CellData<2>> cells;
    for (unsigned int j = 0; j <= m; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double x = 2. * i / n, y = 1. * j / m;
          vertices.emplace_back(x + 0.2 * x * y, y - 0.1 * x, 0.);
        }
    for (unsigned int j = 0; j < m; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int v = j * (n + 1) + i;
          for (const auto &corners :
               {std::vector<unsigned int>{v, v + 1, v + n + 2},
                {v, v + n + 2, v + n + 1}})
            {
              cells.emplace_back(3);
              cells.back().vertices = corners;
            }
        }
    mesh->create_triangulation(vertices, cells, SubCellData());
    return std::make_unique<Discretization>(
      std::move(mesh),
      [](const auto &cell, const auto &unit) {
        return Point<3>(cell->vertex(0) +
                        unit[0] * (cell->vertex(1) - cell->vertex(0)) +
                        unit[1] * (cell->vertex(2) - cell->vertex(0)));
      },
      Element{ElementType::triangle, 2},
      0);
  }

  /** Half a cylinder of radius R about z, of length 1; t0 points outwards. */
  std::unique_ptr<Discretization>
  make_cylinder(const double R)
  {
    auto mesh = std::make_unique<parallel::distributed::Triangulation<2, 3>>(
      MPI_COMM_WORLD);
    GridGenerator::subdivided_hyper_rectangle(*mesh,
                                              {12, 2},
                                              Point<2>(0, 0),
                                              Point<2>(numbers::PI, 1));
    mesh->refine_global(1);
    return std::make_unique<Discretization>(
      std::move(mesh),
      [R](const auto &cell, const auto &unit) {
        Point<3> s;
        for (unsigned int v = 0; v < 4; ++v)
          s +=
            GeometryInfo<2>::d_linear_shape_function(unit, v) * cell->vertex(v);
        return Point<3>(R * std::cos(s[0]), R * std::sin(s[0]), s[1]);
      },
      Element{ElementType::lagrange, 4},
      0);
  }

  /** The larger of a number and an error, which may be NaN. */
  double
  larger(const double a, const double b)
  {
    return std::isnan(b) ? 1e300 : std::max(a, b);
  }

  /** Largest error of the fields, relative to the largest exact value. */
  void
  compare(const std::string &text,
          const ShellFields &fields,
          const Exact       &exact,
          const double       tolerance)
  {
    const auto   names = fields.get_dataset_names();
    const double tiny  = 1e-6;
    for (const auto &[name, value] : exact)
      {
        const unsigned int first =
          std::find(names.begin(), names.end(), name) - names.begin();
        AssertThrow(first < names.size(), ExcMessage("no field " + name));
        double error = 0., scale = tiny;
        for (const auto &patch : fields.get_patches())
          for (unsigned int q = 0; q < patch.data.n_cols(); ++q)
            {
              Point<3> x;
              for (unsigned int c = 0; c < 3; ++c)
                x[c] = patch.data(names.size() + c, q);
              const auto values = value(x);
              for (unsigned int c = 0; c < values.size(); ++c)
                {
                  const double difference =
                    std::abs(patch.data(first + c, q) - values[c]);
                  error = larger(error, difference);
                  scale = std::max(scale, std::abs(values[c]));
                }
            }
        error = Utilities::MPI::max(error, MPI_COMM_WORLD) /
                Utilities::MPI::max(scale, MPI_COMM_WORLD);
        report(error < tolerance, text + ": " + name);
        if (!(error < tolerance))
          std::cerr << name << ": error " << error << std::endl;
      }
  }

  double
  von_mises(const SymmetricTensor<2, 2> &s)
  {
    return std::sqrt(s[0][0] * s[0][0] - s[0][0] * s[1][1] + s[1][1] * s[1][1] +
                     3. * s[0][1] * s[0][1]);
  }

  std::vector<double>
  flatten(const SymmetricTensor<2, 2> &T)
  {
    return {T[0][0], T[0][1], 0, T[0][1], T[1][1], 0, 0, 0, 0};
  }

  /** u = (A x + B y, C y, -(k1 x^2 + k2 y^2 + 2 k12 x y)/2). */
  const double A = 2e-3, B = 1e-3, C = -5e-4;
  const double k1 = 0.03, k2 = -0.01, k12 = 0.02;

  Tensor<1, 3>
  plate_displacement(const Point<3> &x)
  {
    return Point<3>(A * x[0] + B * x[1],
                    C * x[1],
                    -0.5 * (k1 * x[0] * x[0] + k2 * x[1] * x[1] +
                            2. * k12 * x[0] * x[1]));
  }

  /** Plane stress law D ((1 - nu) e + nu tr(e) 1). */
  SymmetricTensor<2, 2>
  law(const double D, const double e_11, const double e_22, const double e_12)
  {
    SymmetricTensor<2, 2> s;
    s[0][0] = D * (e_11 + nu * e_22);
    s[1][1] = D * (e_22 + nu * e_11);
    s[0][1] = D * (1. - nu) * e_12;
    return s;
  }

  Exact
  plate_fields()
  {
    const auto   n = law(D_n, A, C, B / 2.);
    const auto   m = law(D_m, k1, k2, k12);
    const double energy =
      0.5 * (n[0][0] * A + n[1][1] * C + n[0][1] * B + m[0][0] * k1 +
             m[1][1] * k2 + 2. * m[0][1] * k12);
    const auto constant = [](const std::vector<double> &values) {
      return [values](const Point<3> &) { return values; };
    };
    return {{"displacement",
             [](const Point<3> &x) {
               const auto u = plate_displacement(x);
               return std::vector<double>{u[0], u[1], u[2]};
             }},
            {"normal", constant({0., 0., 1.})},
            {"membrane_forces", constant(flatten(n))},
            {"moments", constant(flatten(m))},
            {"principal_membrane_force_1", constant({eigenvalues(n)[0]})},
            {"principal_membrane_force_2", constant({eigenvalues(n)[1]})},
            {"principal_moment_1", constant({eigenvalues(m)[0]})},
            {"principal_moment_2", constant({eigenvalues(m)[1]})},
            // A plate bends tension to the top, the side of t0, for rho > 0.
            {"von_mises_top", constant({von_mises(n / h + 6. / (h * h) * m)})},
            {"von_mises_middle", constant({von_mises(n / h)})},
            {"von_mises_bottom",
             constant({von_mises(n / h - 6. / (h * h) * m)})},
            {"energy_density", constant({energy})}};
  }

  /** Components in the frame against the tensors: n11 = e1 . N e1, etc. */
  void
  check_frame(const std::string &text, const ShellFields &fields)
  {
    const auto names = fields.get_dataset_names();
    double     error = 0.;
    for (const auto &patch : fields.get_patches())
      for (unsigned int q = 0; q < patch.data.n_cols(); ++q)
        {
          const auto at = [&](const std::string &name, const unsigned int c) {
            const unsigned int first =
              std::find(names.begin(), names.end(), name) - names.begin();
            return double(patch.data(first + c, q));
          };
          Tensor<1, 3> e[2], t0;
          Tensor<2, 3> N, M;
          for (unsigned int c = 0; c < 9; ++c)
            {
              N[c / 3][c % 3] = at("membrane_forces", c);
              M[c / 3][c % 3] = at("moments", c);
            }
          for (unsigned int c = 0; c < 3; ++c)
            {
              e[0][c] = at("e1", c);
              e[1][c] = at("e2", c);
              t0[c]   = at("normal", c);
            }
          const double scale_n = N.norm(), scale_m = M.norm();
          for (const double difference :
               {(cross_product_3d(e[0], e[1]) - t0).norm(),
                e[0].norm() - 1.,
                e[0] * e[1],
                (N * t0).norm() / scale_n,
                (M * t0).norm() / scale_m,
                (at("n11", 0) - e[0] * (N * e[0])) / scale_n,
                (at("n22", 0) - e[1] * (N * e[1])) / scale_n,
                (at("n12", 0) - e[0] * (N * e[1])) / scale_n,
                (at("m11", 0) - e[0] * (M * e[0])) / scale_m,
                (at("m22", 0) - e[1] * (M * e[1])) / scale_m,
                (at("m12", 0) - e[0] * (M * e[1])) / scale_m})
            error = larger(error, std::abs(difference));
        }
    report(Utilities::MPI::max(error, MPI_COMM_WORLD) < 2e-6,
           text + ": frame and components");
  }

  void
  test_plate(const std::string &name, const Discretization &plate)
  {
    for (const auto strain : {MembraneStrain::tied, MembraneStrain::full})
      {
        const auto        u     = interpolate(plate, plate_displacement);
        const auto        model = Tests::square_model(section(), strain);
        const ShellFields fields({plate, model, u});
        const std::string text =
          "plate, " + name +
          (strain == MembraneStrain::tied ? ", tied" : ", full");
        compare(text, fields, plate_fields(), 1e-5);
        check_frame(text, fields);
      }
  }

  void
  test_plates()
  {
    for (unsigned int degree = 2; degree <= 5; ++degree)
      test_plate("degree " + std::to_string(degree), *make_plate(degree));
    test_plate("triangles", *make_triangles());
  }

  /**
   * Radial expansion w: hoop strain w/R, and the change of curvature from
   * b0 = -1/R gives rho = w/R^2 around.
   */
  void
  test_cylinder()
  {
    const double      R = 2., w = 0.01;
    const auto        cylinder = make_cylinder(R);
    const auto        u        = interpolate(*cylinder, [=](const Point<3> &x) {
      return w / R * Point<3>(x[0], x[1], 0.);
    });
    const auto        model    = Tests::square_model(section());
    const ShellFields fields({*cylinder, model, u});

    const auto n      = law(D_n, w / R, 0., 0.);
    const auto m      = law(D_m, w / (R * R), 0., 0.);
    const auto tensor = [](const SymmetricTensor<2, 2> &T) {
      return [T](const Point<3> &x) {
        const Tensor<1, 3> hoop =
          Point<3>(-x[1], x[0], 0.) / std::hypot(x[0], x[1]);
        std::vector<double> values;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            values.push_back(T[0][0] * hoop[i] * hoop[j] +
                             (i == 2 && j == 2 ? T[1][1] : 0.));
        return values;
      };
    };
    const auto constant = [](const double value) {
      return [value](const Point<3> &) { return std::vector<double>{value}; };
    };
    const Exact exact = {
      {"normal",
       [R](const Point<3> &x) {
         return std::vector<double>{x[0] / R, x[1] / R, 0.};
       }},
      {"membrane_forces", tensor(n)},
      {"moments", tensor(m)},
      {"n11", constant(n[0][0])},
      {"n22", constant(n[1][1])},
      {"m11", constant(m[0][0])},
      {"m22", constant(m[1][1])},
      {"principal_moment_1", constant(m[0][0])},
      {"von_mises_top", constant(von_mises(n / h + 6. / (h * h) * m))},
      {"von_mises_bottom", constant(von_mises(n / h - 6. / (h * h) * m))},
      {"energy_density",
       constant(0.5 * (n[0][0] * w / R + m[0][0] * w / (R * R)))}};
    compare("cylinder", fields, exact, 1e-4);
    check_frame("cylinder", fields);
  }

  std::string
  contents(const std::string &file)
  {
    std::ifstream      in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  void
  test_files()
  {
    const bool root     = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    const bool parallel = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
    const std::string folder = "vtu_output_test/files";
    if (root)
      std::filesystem::remove_all("vtu_output_test");
    const auto plate = make_plate(3);
    const auto u     = interpolate(*plate, plate_displacement);
    const auto model = Tests::square_model(section());
    VtuOutput  output({FieldFormat::vtu, 1, 0});
    const auto write = [&](const std::string &into, const unsigned counter) {
      output.write({*plate, model, u}, into, "plate", counter);
    };
    write(folder, 0);
    write(folder, 3);

    const auto is_there = [&](const std::string &file) {
      return std::filesystem::exists(folder + "/" + file);
    };
    const std::string record = parallel ? ".pvtu" : ".vtu";
    report(!root ||
             (is_there("plate_0" + record) && is_there("plate_3" + record) &&
              is_there("plate_0.0.vtu") == parallel &&
              is_there("plate_0.1.vtu") == parallel &&
              is_there("plate_0.pvtu") == parallel),
           "files of one step");
    const std::string pvd = contents(folder + "/plate.pvd");
    report(!root || (pvd.find("plate_0" + record) != std::string::npos &&
                     pvd.find("plate_3" + record) != std::string::npos),
           "the .pvd lists both steps");
    const std::string vtu =
      contents(folder + "/plate_3" + (parallel ? ".0" : "") + ".vtu");
    report(!root ||
             (vtu.find("Name=\"displacement\" NumberOfComponents=\"3\"") !=
                std::string::npos &&
              vtu.find("Name=\"moments\" NumberOfComponents=\"9\"") !=
                std::string::npos),
           "arrays of the .vtu");
    // A cell's reference cell must be known for this array to be filled.
    const auto offsets = vtu.find("Name=\"offsets\" format=\"binary\">\n");
    report(!root || (offsets != std::string::npos &&
                     vtu[vtu.find('\n', offsets) + 1] != '\n'),
           "cells of the .vtu");

    // A group of ranks shares a file.
    VtuOutput().write({*plate, model, u}, folder, "shared", 0);
    const std::string shared   = contents(folder + "/shared_0.vtu");
    unsigned int      n_pieces = 0;
    for (auto at = shared.find("<Piece"); at != std::string::npos;
         at      = shared.find("<Piece", at + 1))
      ++n_pieces;
    report(!root ||
             (n_pieces == Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) &&
              !is_there("shared_0.pvtu") &&
              shared.find("</VTKFile>") != std::string::npos),
           "one file for all ranks");

    // A file where a folder should be.
    if (root)
      std::ofstream("vtu_output_test/in_the_way") << "a file\n";
    std::string message;
    try
      {
        write("vtu_output_test/in_the_way", 0);
      }
    catch (const std::exception &exception)
      {
        message = error_text(exception);
      }
    const bool named =
      message.find("vtu_output_test/in_the_way") != std::string::npos;
    report(Utilities::MPI::min(int(named), MPI_COMM_WORLD) == 1,
           "a bad folder is named on all ranks");
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_plates();
  test_cylinder();
  test_files();
}
