// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

// Points found on a curved mesh.

#include "../tests_common.h"
#include "unit_test.h"

using namespace Nacre;
using namespace UnitTests;

BOOST_AUTO_TEST_SUITE(locate)

BOOST_AUTO_TEST_CASE(points_of_a_curved_mesh)
{
  Tests::Mesh mesh;
  mesh.vertices = {{0., 0., 0.},
                   {1., 0., 0.},
                   {2., 0., 0.},
                   {0., 1., 0.},
                   {1., 1.2, 0.},
                   {2., 1., 0.}};
  mesh.cells    = {{{0, 1, 3, 4}}, {{1, 2, 4, 5}}};
  mesh.map      = Tests::bend;
  mesh.refined  = {1};
  for (const Element element : {Element{ElementType::lagrange, 3},
                                Element{ElementType::lagrange, 2},
                                Tests::serendipity})
    {
      const auto shell = Tests::make_discretization(mesh, element);
      for (const auto &cell : shell->dof_handler().active_cell_iterators())
        for (const Point<spacedim> &node : shell->node_positions(cell))
          {
            const SurfacePoint found = shell->locate(node, "Test");
            BOOST_TEST(found.position.distance(node) < 1e-10);
            BOOST_TEST(found.is_mine);
          }
      // Off the surface by a tenth of a cell
      const auto node =
        shell->node_positions(shell->dof_handler().begin_active())[0];
      BOOST_TEST(holds(complaint([&] {
                         shell->locate(node + Point<spacedim>(-0.3, -0.3, 0.1),
                                       "Loads/Point forces");
                       }),
                       "Loads/Point forces"));
    }
}

BOOST_AUTO_TEST_SUITE_END()
