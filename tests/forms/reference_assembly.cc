// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// The production loop against the textbook's: the same matrix and right-hand
// side on flat, curved, creased, refined and oppositely oriented meshes, with
// regions, all elements and strains, on any number of ranks.

#include "../tests_common.h"
#include <nacre/forms/reference_assembly.h>
#include <nacre/problem/midsurface.h>

using namespace Tests;

/** 3 x 2 cells of the rectangle [0, 3] x [0, 2]. */
Mesh
make_mesh(const std::function<Point<3>(const Point<3> &)> &map)
{
  Mesh mesh;
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i < 4; ++i)
      mesh.vertices.emplace_back(i, j, 0.);
  for (unsigned int j = 0; j < 2; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      mesh.cells.push_back(
        {{4 * j + i, 4 * j + i + 1, 4 * j + i + 4, 4 * j + i + 5}});
  mesh.map = map;
  return mesh;
}

/** A roof with a ridge at x = 2. */
Point<3>
fold(const Point<3> &x)
{
  return {x[0], x[1], -1.5 * std::abs(x[0] - 2.)};
}

using Matrix = TrilinosWrappers::SparseMatrix;

/** The largest |a - b| over the entries of a, over the largest |b|. */
double
one_way_difference(const Matrix &a, const Matrix &b)
{
  double difference = 0., size = 0.;
  for (const auto row : a.locally_owned_range_indices())
    {
      for (auto entry = a.begin(row); entry != a.end(row); ++entry)
        {
          const double d =
            std::abs(entry->value() - b.el(row, entry->column()));
          difference = !(d <= difference) ? d : difference;
        }
      for (auto entry = b.begin(row); entry != b.end(row); ++entry)
        size = std::max(size, std::abs(entry->value()));
    }
  return Utilities::MPI::max(difference, MPI_COMM_WORLD) /
         Utilities::MPI::max(size, MPI_COMM_WORLD);
}

void
compare(const std::string    &name,
        const Discretization &discretization,
        const ShellModel     &shell,
        const MembraneStrain  strain)
{
  const ShellParts parts(*shell.section, shell.supports, shell.loads, strain);
  const Assembly   fast(discretization, parts);
  const ReferenceAssembly reference(discretization, parts, fast.penalty());
  // Without constraints: the diagonal of constrained dofs is arbitrary.
  AffineConstraints<double> none(discretization.locally_relevant_dofs());
  none.close();
  Matrix         K_fast, K;
  TrilinosVector f_fast(discretization.locally_owned_dofs(), MPI_COMM_WORLD);
  TrilinosVector f(f_fast);
  fast.reinit_matrix(none, K_fast);
  fast.assemble_system(none, K_fast, f_fast);
  reference.reinit_matrix(none, K);
  reference.assemble_system(none, K, f);

  check_below(name + ": matrix",
              std::max(one_way_difference(K_fast, K),
                       one_way_difference(K, K_fast)),
              1e-12);
  const double size = f.linfty_norm();
  f.add(-1., f_fast);
  check_below(name + ": right-hand side", f.linfty_norm() / size, 1e-12);
}

const std::string section = "subsection Section\n"
                            "  set Young's modulus = 10\n"
                            "  set Poisson's ratio = 0.3\n"
                            "  set Thickness = 0.05\n"
                            "  set Density = 2\n"
                            "  set Regions = left: h = 0.1; right: E = 20\n"
                            "end\n";

/** Meshes made here: every surface, orientation, element. */
void
test_meshes()
{
  MeshRegions regions;
  for (const char *const name : {"left", "right"})
    regions.regions.push_back({{name}, ""});
  const TextModel shell(section + "subsection Loads\n"
                                  "  set Force per area = 1, x*y, z\n"
                                  "  set Gravity = 0, 0, -10\n"
                                  "end\n",
                        {},
                        regions);
  const auto      test = [&](const std::string   &name,
                        const Mesh          &mesh,
                        const Element       &element,
                        const MembraneStrain strain) {
    const auto discretization = make_discretization(mesh, element);
    for (const auto &cell :
         discretization->triangulation().active_cell_iterators())
      if (!cell->is_artificial())
        cell->set_material_id(1 + cell->id().get_coarse_cell_id() % 2);
    compare(name + ", " + label(element) + ", " + name_of(strain),
            *discretization,
            shell.model,
            strain);
  };
  const auto lagrange = [](const unsigned int p) {
    return Element{ElementType::lagrange, p};
  };
  const auto flat   = make_mesh([](const auto &x) { return x; });
  auto       curved = make_mesh(bend), creased = make_mesh(fold);
  for (const auto &element : {lagrange(2), lagrange(4), serendipity, triangle})
    test("flat", flat, element, default_membrane_strain(element.type));
  for (const auto &element : {lagrange(2), lagrange(3), serendipity, triangle})
    for (const auto strain :
         {MembraneStrain::tied, MembraneStrain::full, MembraneStrain::reduced})
      test("curved", curved, element, strain);
  test("creased", creased, lagrange(3), MembraneStrain::tied);

  auto hanging    = curved;
  hanging.refined = {1, 5};
  for (const auto &element :
       {lagrange(2), lagrange(3), lagrange(4), serendipity})
    test("hanging", hanging, element, MembraneStrain::tied);

  auto opposite = curved;
  for (const unsigned int k : {1, 5})
    std::swap(opposite.cells[k][1], opposite.cells[k][2]);
  for (const auto &element : {lagrange(2), lagrange(3), serendipity})
    test("opposite", opposite, element, MembraneStrain::tied);
}

/** Conditions and loads of edges, and at points. */
void
test_edges()
{
  const TextModel shell(section_text(10., 0.3, 0.05) +
                        "subsection Mid-surface\n"
                        "  set Surface = hyperbolic paraboloid\n"
                        "  set Subdivisions = 3\n"
                        "end\n"
                        "subsection Boundary conditions\n"
                        "  set Edges = u=0: clamped; v=1: rotation = x*y\n"
                        "end\n"
                        "subsection Loads\n"
                        "  set Pressure = 1 + x\n"
                        "  set Edge forces = u=1, v=1: 1, y, z\n"
                        "  set Edge moments = u=1: 0.1*y\n"
                        "  set Point forces = (0, 0, 0): 1, 2, 3\n"
                        "end\n");
  for (const auto &element :
       {Element{ElementType::lagrange, 3}, serendipity, triangle})
    compare(
      "edges, " + label(element),
      Discretization(shell.model.midsurface, MPI_COMM_WORLD, element, 0, 0),
      shell.model,
      default_membrane_strain(element.type));
}

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.setstate(std::ios::failbit);
  test_meshes();
  test_edges();
  return n_failures > 0;
}
