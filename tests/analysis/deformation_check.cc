// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Deformations that can't be a step: a cell without area, a cell turned over,
// a cell that folds onto itself between its points, a fold that jumps beyond
// 180 degrees, at a hanging edge too; and great ones that can. Neighbours of
// opposite orientation, at a hanging edge too.

#include "../tests_common.h"
#include <nacre/analysis/deformation_check.h>
#include <nacre/discretization/orientation.h>

using namespace Tests;

using Map = std::function<Point<3>(const Point<3> &)>;

/** A mesh, and what is found wrong with its deformations. */
struct Shell
{
  Shell(const Mesh &mesh, const Element &element)
    : discretization(make_discretization(mesh, element))
  {}

  TrilinosVector
  deform(const Map &map) const
  {
    TrilinosVector owned(discretization->locally_owned_dofs(), MPI_COMM_WORLD);
    const auto    &node_dofs = discretization->node_dofs();
    std::vector<types::global_dof_index> dofs(node_dofs.size());
    for (const auto &cell :
         discretization->dof_handler().active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          const auto nodes = discretization->node_positions(cell);
          for (unsigned int k = 0; k < node_dofs.size(); ++k)
            {
              const auto  i = dofs[node_dofs[k]];
              const auto &x = nodes[k / 3];
              if (discretization->locally_owned_dofs().is_element(i))
                owned(i) = map(x)[k % 3] - x[k % 3];
            }
        }
    owned.compress(VectorOperation::insert);
    TrilinosVector ghosted(discretization->locally_owned_dofs(),
                           discretization->locally_relevant_dofs(),
                           MPI_COMM_WORLD);
    ghosted = owned;
    return ghosted;
  }

  std::string
  found(const Map &before, const Map &after) const
  {
    return find_impossible_deformation(*discretization,
                                       deform(before),
                                       deform(after));
  }

  /** Of the deformation by itself. */
  std::string
  found(const Map &map, const double allowed_bend = largest_bend) const
  {
    return find_impossible_state(*discretization, deform(map), allowed_bend);
  }

  std::unique_ptr<Discretization> discretization;
};

Element
lagrange(const unsigned int degree)
{
  return {ElementType::lagrange, degree};
}

void
expect(const std::string &name, const std::string &text, const char *word)
{
  const bool good =
    (*word == '\0' ? text.empty() : text.find(word) != std::string::npos);
  n_failures += (good ? 0 : 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << name << ": " << (good ? "OK" : "FAILED: " + text) << std::endl;
}

/** Two cells side by side in the plane; the edge between them is x = 1. */
Mesh
two_cells()
{
  Mesh mesh;
  mesh.vertices = {{0., 0., 0.},
                   {1., 0., 0.},
                   {2., 0., 0.},
                   {0., 1., 0.},
                   {1., 1., 0.},
                   {2., 1., 0.}};
  mesh.cells    = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
  return mesh;
}

Mesh
one_cell()
{
  Mesh mesh;
  mesh.vertices = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {1., 1., 0.}};
  mesh.cells    = {{{0, 1, 2, 3}}};
  return mesh;
}

Point<3>
rest(const Point<3> &x)
{
  return x;
}

/** The second cell folded up by an angle (degrees) about x = 1. */
Map
fold(const double degrees)
{
  const double angle = degrees * numbers::PI / 180.;
  return [angle](const Point<3> &x) {
    const double r = std::max(0., x[0] - 1.);
    return Point<3>(std::min(x[0], 1.) + r * std::cos(angle),
                    x[1],
                    r * std::sin(angle));
  };
}

void
test_two_cells()
{
  const Shell shell(two_cells(), lagrange(2));
  expect("no change", shell.found(rest, rest), "");
  expect("fold by 80 degrees", shell.found(rest, fold(80.)), "");
  expect("on to 160 degrees", shell.found(fold(80.), fold(160.)), "");
  expect("fold by 120 degrees in a step",
         shell.found(rest, fold(120.)),
         "90 degrees");
  expect("fold through itself",
         shell.found(fold(160.), fold(200.)),
         "180 degrees");
  expect("fold back", shell.found(fold(-160.), fold(-90.)), "");
  expect("a cell without area",
         shell.found(rest,
                     [](const Point<3> &x) {
                       return Point<3>(x[0] > 1. ? 1. + 1e-5 * (x[0] - 1.) :
                                                   x[0],
                                       x[1],
                                       x[2]);
                     }),
         "of its area");
  expect("a cell turned over",
         shell.found(rest,
                     [](const Point<3> &x) {
                       return Point<3>(-x[0], x[1], x[2]);
                     }),
         "turned over");
}

/** A cell bent to an arc by an angle (degrees). */
Map
arc(const double degrees)
{
  const double angle = degrees * numbers::PI / 180.;
  return [angle](const Point<3> &x) {
    return Point<3>(std::sin(angle * x[0]) / angle,
                    x[1],
                    (1. - std::cos(angle * x[0])) / angle);
  };
}

void
test_inside_of_cells()
{
  // x' = 2 (1 - 2 s), z' = 0.04: it turns back within a tenth of the cell.
  const Map hairpin = [](const Point<3> &x) {
    const double s = x[0];
    return Point<3>(2. * s * (1. - s), x[1], 0.04 * s);
  };
  // A corner alone turns over.
  const Map corner = [](const Point<3> &x) {
    const bool moves = (x[0] > 0.99 && x[1] > 0.99);
    return moves ? Point<3>(0.55, 0.55, 0.) : x;
  };
  for (const Element &element :
       {lagrange(2), lagrange(3), lagrange(4), serendipity, triangle})
    {
      const Shell       shell(one_cell(), element);
      const std::string name = label(element) + ": ";
      expect(name + "hairpin inside of a cell",
             shell.found(hairpin),
             "folds onto itself");
      expect(name + "hairpin inside of a moving cell",
             shell.found(hairpin, largest_bend_in_motions),
             "folds onto itself");
      expect(name + "arc of 120 degrees", shell.found(arc(120.)), "");
      expect(name + "corner turned over in a step",
             shell.found(rest, corner),
             "turned over");
      expect(name + "corner turned over", shell.found(corner), "cell");
    }
}

void
test_bends_of_motions()
{
  // From the middle on by 70 degrees within a quarter of the cell
  const Map bend = [](const Point<3> &x) {
    const double s = x[0];
    return Point<3>(2. * std::tan(7. / 18. * numbers::PI) * s * (1. - s),
                    x[1],
                    s);
  };
  const Shell shell(one_cell(), lagrange(2));
  expect("bend by 70 degrees", shell.found(bend), "70");
  expect("bend by 70 degrees in a motion",
         shell.found(bend, largest_bend_in_motions),
         "");
}

void
test_hanging_edges()
{
  for (const unsigned int refined : {0, 1})
    {
      Mesh mesh    = two_cells();
      mesh.refined = {refined};
      const Shell       shell(mesh, lagrange(2));
      const std::string name =
        "hanging edge, cell " + std::to_string(refined) + " refined: ";
      expect(name + "on to 160 degrees",
             shell.found(fold(80.), fold(160.)),
             "");
      expect(name + "fold through itself",
             shell.found(fold(160.), fold(200.)),
             "180 degrees");

      // The second cell's normal points down.
      Mesh mixed     = mesh;
      mixed.cells[1] = {{2, 1, 5, 4}};
      const Parameters parameters(section_text(1., 0., 0.1));
      for (const bool opposite : {false, true})
        {
          const auto discretization =
            make_discretization(opposite ? mixed : mesh, 2);
          const bool alike = is_consistently_oriented(*discretization);
          expect(name + (opposite ? "opposite" : "same") + " orientation",
                 alike != opposite ? "" : "not seen",
                 "");
        }
    }
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_two_cells();
  test_inside_of_cells();
  test_bends_of_motions();
  test_hanging_edges();
  return n_failures == 0 ? 0 : 1;
}
