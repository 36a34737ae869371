// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The mass of a plate whose regions have densities and thicknesses of their
// own: the material ids of cells reach the section.

#include "../tests_common.h"
#include <nacre/forms/assembly.h>
#include <nacre/forms/mass_terms.h>

using namespace Tests;


int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  MeshRegions                            regions;
  for (const char *const name : {"left", "right"})
    regions.regions.push_back({{name}, ""});
  const Parameters parameters(
    "subsection Section\n set Thickness = 0.1\n set Density = 2\n"
    " set Regions = left: h = 0.3; right: density = 7\nend\n",
    regions);
  // The plate [0, 2] x [0, 1]; the regions are halves.
  Mesh mesh;
  for (const double y : {0., 1.})
    for (const double x : {0., 1., 2.})
      mesh.vertices.emplace_back(x, y, 0.);
  mesh.cells         = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
  auto triangulation = make_triangulation(mesh);
  for (const auto &cell : triangulation->active_cell_iterators())
    cell->set_material_id(1 + cell->index());
  const Discretization discretization(
    std::move(triangulation),
    [](const auto &cell, const auto &unit) {
      return Point<3>(cell->vertex(0) + Point<3>(unit[0], unit[1], 0.));
    },
    {ElementType::lagrange, 2},
    0);

  const MassTerms mass(discretization, parameters.section);
  check_below("total mass",
              std::abs(mass.total() - (0.3 * 2. + 0.1 * 7.)),
              1e-14);
  return n_failures;
}
