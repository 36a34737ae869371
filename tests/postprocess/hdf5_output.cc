// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// HDF5 files, read again: points on the surface, the displacement and the rows
// of a tensor at each, cells that cover the area; quadrilaterals and triangles,
// also where ranks have no cells; the .xdmf lists each time.

#include "../tests_common.h"
#include "square_model.h"
#include <nacre/postprocess/vtu_output.h>

#include <deal.II/base/hdf5.h>

#include <fstream>
#include <sstream>

using namespace Tests;

namespace
{
  const std::string folder = "hdf5_output_test";

  Vector3
  stretch(const Point<3> &x)
  {
    Vector3 u;
    u[0] = 0.1 * x[0];
    u[2] = 0.5 * x[0] * x[1];
    return u;
  }

  TrilinosVector
  interpolate_in_parallel(const Discretization &discretization)
  {
    const IndexSet &owned = discretization.locally_owned_dofs();
    TrilinosVector  u(owned, MPI_COMM_WORLD);
    TrilinosVector  ghosted(owned,
                           discretization.locally_relevant_dofs(),
                           MPI_COMM_WORLD);
    const auto     &node_dofs = discretization.node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const auto &cell :
         discretization.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          const auto nodes = discretization.node_positions(cell);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (owned.is_element(dofs[node_dofs[i]]))
              u(dofs[node_dofs[i]]) = stretch(nodes[i / 3])[i % 3];
        }
    u.compress(VectorOperation::insert);
    ghosted = u;
    return ghosted;
  }

  /** Area of the plane cells of the file. */
  double
  area(const FullMatrix<double> &nodes, const FullMatrix<double> &cells)
  {
    const auto point = [&](const double index) {
      const auto k = static_cast<unsigned int>(index);
      return Point<3>(nodes(k, 0), nodes(k, 1), nodes(k, 2));
    };
    double sum = 0.;
    for (unsigned int k = 0; k < cells.m(); ++k)
      for (unsigned int corner = 2; corner < cells.n(); ++corner)
        sum +=
          0.5 *
          cross_product_3d(point(cells(k, corner - 1)) - point(cells(k, 0)),
                           point(cells(k, corner)) - point(cells(k, 0)))
            .norm();
    return sum;
  }

  /** On one rank. */
  void
  check_file(const std::string &name, const unsigned int n_cells)
  {
    const HDF5::File file(folder + "/" + name + "_0.h5",
                          HDF5::File::FileAccessMode::open);
    const auto       read = [&](const std::string &set) {
      return file.open_dataset(set).read<FullMatrix<double>>();
    };
    const auto nodes = read("nodes"), cells = read("cells"),
               u = read("displacement"), N = read("membrane_forces_x");
    // Scalars are a column.
    const auto energy = read("energy_density");
    double     error = 0., stress_error = 0.;
    for (unsigned int k = 0; k < nodes.m(); ++k)
      {
        const auto exact =
          stretch(Point<3>(nodes(k, 0), nodes(k, 1), nodes(k, 2)));
        for (unsigned int c = 0; c < 3; ++c)
          error = std::max(error, std::abs(u(k, c) - exact[c]));
        // Uniform stretch along x: N = E h 0.1 e_x (x) e_x
        stress_error = std::max({stress_error,
                                 std::abs(N(k, 0) - 10.),
                                 std::abs(N(k, 1)),
                                 std::abs(N(k, 2))});
      }
    // deal.II's patches hold single precision.
    check_below(name + ": displacement at the points", error, 1e-6);
    check_below(name + ": membrane forces", stress_error, 1e-5);
    check_below(name + ": values of a scalar",
                std::abs(1. * energy.m() - nodes.m()),
                0.5);
    check_below(name + ": number of cells",
                std::abs(1. * cells.m() - n_cells),
                0.5);
    check_below(name + ": area of the cells",
                std::abs(area(nodes, cells) - 2.),
                1e-6);
  }

  /** @p n_cells linear cells are expected from the elements' 2. */
  void
  test(const std::string &name,
       const Element     &element,
       const unsigned int n_cells)
  {
    const Parameters parameters(section_text(1000., 0., 0.1));
    Mesh             mesh;
    mesh.vertices =
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.cells                = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
    const auto discretization = make_discretization(mesh, element);
    const auto u              = interpolate_in_parallel(*discretization);
    const auto model          = square_model(parameters.section);
    VtuOutput  output({FieldFormat::hdf5, 16, 0});
    for (const unsigned int counter : {0, 1})
      output.write({*discretization, model, u},
                   folder,
                   name,
                   {counter, 0.5 * counter, std::to_string(counter)});
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
      return;
    check_file(name, n_cells);
    std::ifstream      in(folder + "/" + name + ".xdmf");
    std::ostringstream text;
    text << in.rdbuf();
    const bool lists =
      text.str().find("<Time Value=\"0\"") != std::string::npos &&
      text.str().find("<Time Value=\"0.5\"") != std::string::npos &&
      text.str().find(name + "_1.h5:/moments_z") != std::string::npos &&
      text.str().find("</Xdmf>") != std::string::npos;
    check_below(name + ": the .xdmf lists both times", lists ? 0. : 1., 0.5);
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test("quadrilaterals", {ElementType::lagrange, 3}, 2 * 9);
  test("serendipity", serendipity, 2 * 4);
  test("triangles", triangle, 4 * 4);
  return n_failures == 0 ? 0 : 1;
}
