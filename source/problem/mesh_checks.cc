// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_checks.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace Nacre
{
  namespace
  {
    std::string
    node(const MeshFile &mesh, const unsigned int index)
    {
      return std::to_string(mesh.node_numbers[index]);
    }


    /** 8-node cells get a centre: they are 9-node cells. */
    std::size_t
    kind(const std::size_t n_nodes)
    {
      return n_nodes == 8 ? 9 : n_nodes;
    }


    void
    check_kinds(const MeshFile &mesh)
    {
      const auto n_nodes = mesh.cells[0].nodes.size();
      std::map<std::vector<unsigned int>, unsigned int> known;
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        {
          const std::string cell  = mesh.describe_cell(k);
          const auto       &nodes = mesh.cells[k].nodes;
          if (kind(nodes.size()) != kind(n_nodes))
            fail(mesh,
                 cell + " has " + std::to_string(nodes.size()) + " nodes and " +
                   mesh.describe_cell(0) + " has " + std::to_string(n_nodes) +
                   "; all cells must be of one shape and degree.");
          std::set<unsigned int> seen;
          for (const unsigned int i : nodes)
            if (!seen.insert(i).second)
              fail(mesh, cell + " has the node " + node(mesh, i) + " twice.");
          std::vector<unsigned int> corners(nodes.begin(),
                                            nodes.begin() + mesh.n_corners(k));
          std::sort(corners.begin(), corners.end());
          const auto [entry, is_new] = known.emplace(corners, k);
          if (!is_new)
            fail(mesh,
                 cell + " has the same corners as " +
                   mesh.describe_cell(entry->second) + "; remove one.");
        }
    }


    /**
     * A middle must lie between the quarter points of its side, where the
     * Jacobian vanishes, and not further off than the side is long.
     */
    void
    check_middles(const MeshFile &mesh, const unsigned int cell)
    {
      const auto &nodes = mesh.cells[cell].nodes;
      const auto  far   = [&](const unsigned int i, const std::string &of) {
        fail(mesh,
             "the " + mesh.describe_node(nodes[i]) + " should be in the " +
               "middle of " + of + " of " + mesh.describe_cell(cell) +
               " and is far off; is the order of the nodes right?");
      };
      for (const auto &side : CoarseCell::sides(mesh.n_corners(cell)))
        {
          const Point<3>    &a     = mesh.nodes[nodes[side.corners[0]]];
          const Point<3>    &b     = mesh.nodes[nodes[side.corners[1]]];
          const Tensor<1, 3> chord = b - a;
          const Tensor<1, 3> offset =
            mesh.nodes[nodes[side.middle]] - (a + 0.5 * chord);
          if (std::abs(offset * chord) >= 0.25 * chord.norm_square() ||
              offset.norm() > chord.norm())
            far(side.middle,
                describe(mesh,
                         {nodes[side.corners[0]], nodes[side.corners[1]]}));
        }
      if (nodes.size() < 9)
        return;
      const auto     points = mesh.points(cell);
      const Point<3> centre = CoarseCell::serendipity_centre(points);
      const double   size =
        std::min(points[0].distance(points[3]), points[1].distance(points[2]));
      if (points[8].distance(centre) > 0.25 * size)
        far(8, "the nodes");
    }


    void
    check_area(const MeshFile &mesh, const unsigned int cell)
    {
      const auto            points    = mesh.points(cell);
      const unsigned int    n_corners = mesh.n_corners(cell);
      std::vector<Point<2>> units     = n_corners == 3 ?
                                          QGaussSimplex<2>(3).get_points() :
                                          QGauss<2>(3).get_points();
      for (unsigned int i = 0; i < n_corners; ++i)
        units.push_back(CoarseCell::unit_corner(n_corners, i));

      std::vector<Tensor<1, 3>> normals;
      Tensor<1, 3>              mean;
      double                    longest = 0.;
      for (const Point<2> &unit : units)
        {
          const auto t = CoarseCell::tangents(points, unit);
          longest = std::max({longest, t[0].norm_square(), t[1].norm_square()});
          normals.push_back(cross_product_3d(t[0], t[1]));
          mean += normals.back();
        }
      for (const Tensor<1, 3> &normal : normals)
        if (!(normal.norm() > 1e-8 * longest))
          fail(
            mesh,
            mesh.describe_cell(cell) +
              " is degenerate: its area is zero, or zero at a point (corners "
              "at one place, on one line, or middles on quarter points).");
      for (const Tensor<1, 3> &normal : normals)
        if (!(normal * mean > 1e-8 * longest * mean.norm()))
          fail(mesh,
               mesh.describe_cell(cell) +
                 " is folded: its normal turns by more than 90 degrees within "
                 "the cell (wrong order of nodes, a concave corner, or too "
                 "large a cell).");
    }


    const MeshSide *
    neighbor(const MeshSides   &all,
             const MeshLine    &line,
             const unsigned int cell)
    {
      const auto &sides = all.at(line);
      if (sides.size() < 2)
        return nullptr;
      return &(sides[0].cell == cell ? sides[1] : sides[0]);
    }


    void
    turn_over(MeshFile &mesh, const unsigned int cell)
    {
      const std::vector<unsigned int> old = mesh.cells[cell].nodes;
      for (unsigned int i = 0; i < old.size(); ++i)
        mesh.cells[cell].nodes[i] = old[CoarseCell::turned_over(old.size())[i]];
    }
  } // namespace


  void
  check_cells(const MeshFile &mesh)
  {
    if (mesh.cells.empty())
      fail(mesh, "it has no cells of a surface (triangles or quadrilaterals).");
    check_kinds(mesh);
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      {
        if (mesh.cells[k].nodes.size() > mesh.n_corners(k))
          check_middles(mesh, k);
        check_area(mesh, k);
      }
  }


  MeshSides
  find_sides(const MeshFile &mesh)
  {
    MeshSides result;
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      for (const auto &side : CoarseCell::sides(mesh.n_corners(k)))
        {
          const auto        &nodes  = mesh.cells[k].nodes;
          const unsigned int a      = nodes[side.corners[0]];
          const unsigned int b      = nodes[side.corners[1]];
          const unsigned int middle = nodes.size() > mesh.n_corners(k) ?
                                        nodes[side.middle] :
                                        numbers::invalid_unsigned_int;
          result[std::minmax(a, b)].push_back({k, a < b, middle});
        }
    for (const auto &[line, sides] : result)
      {
        if (sides.size() > 2)
          fail(mesh,
               describe(mesh, line) + " is shared by " +
                 std::to_string(sides.size()) +
                 " cells: " + std::to_string(mesh.cells[sides[0].cell].number) +
                 ", " + std::to_string(mesh.cells[sides[1].cell].number) +
                 ", " + std::to_string(mesh.cells[sides[2].cell].number) +
                 (sides.size() > 3 ? ", ..." : "") +
                 "; surfaces that branch aren't possible.");
        if (sides.size() == 2 && sides[0].middle != sides[1].middle)
          fail(mesh,
               describe(mesh, line) + " has the middle " +
                 node(mesh, sides[0].middle) + " in " +
                 mesh.describe_cell(sides[0].cell) + " and " +
                 node(mesh, sides[1].middle) + " in " +
                 mesh.describe_cell(sides[1].cell) + ".");
      }
    return result;
  }


  namespace
  {
    enum : int
    {
      unknown = 0,
      kept    = 1,
      turned  = -1
    };

    /**
     * For each cell whether it is kept or turned over such that all have the
     * orientation of the first one. Throws where that is impossible, and for
     * cells that no way along common sides leads to.
     */
    std::vector<int>
    find_orientations(const MeshFile &mesh, const MeshSides &sides)
    {
      std::vector<int>          state(mesh.cells.size(), unknown);
      std::vector<unsigned int> reached = {0};
      state[0]                          = kept;
      for (unsigned int i = 0; i < reached.size(); ++i)
        {
          const unsigned int cell  = reached[i];
          const auto        &nodes = mesh.cells[cell].nodes;
          for (const auto &[ends, middle] :
               CoarseCell::sides(mesh.n_corners(cell)))
            {
              (void)middle;
              const unsigned int    a = nodes[ends[0]], b = nodes[ends[1]];
              const MeshLine        line  = std::minmax(a, b);
              const MeshSide *const other = neighbor(sides, line, cell);
              if (other == nullptr)
                continue;
              // Neighbours of one orientation go along a side both ways.
              const int wanted =
                (other->forward != (a < b)) ? state[cell] : -state[cell];
              if (state[other->cell] == unknown)
                {
                  state[other->cell] = wanted;
                  reached.push_back(other->cell);
                }
              else if (state[other->cell] != wanted)
                fail(mesh,
                     "the cells can't be given one orientation: across " +
                       describe(mesh, line) + " " + mesh.describe_cell(cell) +
                       " and " + mesh.describe_cell(other->cell) +
                       " have opposite ones, whichever way one goes round; a "
                       "surface with one side only (a Moebius strip) isn't "
                       "possible.");
            }
        }
      const auto apart = std::find(state.begin(), state.end(), unknown);
      if (apart != state.end())
        fail(mesh,
             "the mesh has several parts: " + mesh.describe_cell(0) + " and " +
               mesh.describe_cell(apart - state.begin()) +
               " aren't connected by common sides.");
      return state;
    }
  } // namespace


  void
  orient_cells(MeshFile &mesh, const MeshSides &sides)
  {
    const std::vector<int> state = find_orientations(mesh, sides);
    const int    few      = 2 * std::count(state.begin(), state.end(), turned) >
                        static_cast<std::ptrdiff_t>(state.size()) ?
                              kept :
                              turned;
    unsigned int n_turned = 0, first = 0;
    for (unsigned int k = 0; k < state.size(); ++k)
      if (state[k] == few)
        {
          turn_over(mesh, k);
          if (n_turned++ == 0)
            first = k;
        }
    if (n_turned > 0)
      mesh.notes.push_back(
        std::to_string(n_turned) + " of " + std::to_string(state.size()) +
        (n_turned == 1 ? " cells is" : " cells are") +
        " turned over to the orientation of the others; the first is " +
        mesh.describe_cell(first) + ".");
  }
} // namespace Nacre
