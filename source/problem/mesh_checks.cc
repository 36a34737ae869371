// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_file.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** See check_mesh(). */
    class MeshChecker
    {
    public:
      explicit MeshChecker(MeshFile &mesh)
        : mesh_(mesh)
      {}

      void
      check_cells() const;

      void
      find_sides();

      void
      orient_cells();

      MeshBoundary
      find_boundary() const;

    private:
      /** Ends, the smaller node first. */
      using Line = std::pair<unsigned int, unsigned int>;

      struct Side
      {
        unsigned int cell;
        /** Whether the cell goes from the smaller node to the larger. */
        bool forward;
        /** The node in the middle, or none. */
        unsigned int middle;
      };

      [[noreturn]] void
      fail(const std::string &text) const
      {
        throw StandardExceptions::ExcMessage("The mesh file '" + mesh_.path +
                                             "': " + text);
      }

      std::string
      node(const unsigned int index) const
      {
        return std::to_string(mesh_.node_numbers[index]);
      }

      std::string
      describe(const Line &line) const
      {
        return "the side between the nodes " + node(line.first) + " and " +
               node(line.second);
      }

      void
      check_kinds() const;
      void
      check_nodes() const;
      void
      check_places() const;
      void
      check_middles(const unsigned int cell) const;
      void
      check_area(const unsigned int cell) const;

      const Side *
      neighbor(const Line &line, const unsigned int cell) const;

      void
      turn_over(const unsigned int cell);

      Line
      side_of(const MeshFile::Element &element) const;

      std::map<Line, std::string>
      named_lines() const;

      void
      add_node_sets(std::map<Line, std::string> &names) const;

      MeshFile                         &mesh_;
      std::map<Line, std::vector<Side>> sides_;
      /** The side sets, taken before any cell is turned over. */
      std::vector<std::pair<std::string, std::vector<Line>>> side_sets_;
    };


    void
    MeshChecker::check_cells() const
    {
      if (mesh_.cells.empty())
        fail("it has no cells of a surface (triangles or quadrilaterals).");
      check_kinds();
      check_nodes();
      check_places();
      for (unsigned int k = 0; k < mesh_.cells.size(); ++k)
        {
          if (mesh_.cells[k].nodes.size() > mesh_.n_corners(k))
            check_middles(k);
          check_area(k);
        }
    }


    void
    MeshChecker::check_kinds() const
    {
      const auto n_nodes = mesh_.cells[0].nodes.size();
      std::map<std::vector<unsigned int>, unsigned int> known;
      for (unsigned int k = 0; k < mesh_.cells.size(); ++k)
        {
          const std::string cell  = mesh_.describe_cell(k);
          const auto       &nodes = mesh_.cells[k].nodes;
          if (nodes.size() != n_nodes)
            fail(cell + " has " + std::to_string(nodes.size()) + " nodes and " +
                 mesh_.describe_cell(0) + " has " + std::to_string(n_nodes) +
                 "; all cells must be of one shape and degree.");
          std::set<unsigned int> seen;
          for (const unsigned int i : nodes)
            if (!seen.insert(i).second)
              fail(cell + " has the node " + node(i) + " twice.");
          std::vector<unsigned int> corners(nodes.begin(),
                                            nodes.begin() + mesh_.n_corners(k));
          std::sort(corners.begin(), corners.end());
          const auto [entry, is_new] = known.emplace(corners, k);
          if (!is_new)
            fail(cell + " has the same corners as " +
                 mesh_.describe_cell(entry->second) +
                 "; remove one, or put it into one group only.");
        }
    }


    void
    MeshChecker::check_nodes() const
    {
      std::vector<bool> used(mesh_.nodes.size(), false);
      for (const auto &cell : mesh_.cells)
        for (const unsigned int i : cell.nodes)
          used[i] = true;
      const auto unused = std::find(used.begin(), used.end(), false);
      if (unused == used.end())
        return;
      const auto n = std::count(used.begin(), used.end(), false);
      fail("the " + mesh_.describe_node(unused - used.begin()) +
           " belongs to no cell" +
           (n == 1 ? "" : " (nor do " + std::to_string(n - 1) + " others)") +
           "; remove it (gmsh writes such nodes with Mesh.SaveAll; with "
           "physical groups alone it doesn't).");
    }


    /** Nodes are sorted into boxes; neighbours are in one of 27. */
    void
    MeshChecker::check_places() const
    {
      const BoundingBox<3> box(mesh_.nodes);
      const double         extent = box.get_boundary_points().first.distance(
        box.get_boundary_points().second);
      const double tolerance = 1e-9 * extent;
      using Box              = std::array<long long, 3>;
      std::map<Box, std::vector<unsigned int>> boxes;
      for (unsigned int i = 0; i < mesh_.nodes.size(); ++i)
        {
          Box home;
          for (unsigned int c = 0; c < 3; ++c)
            home[c] = std::llround((mesh_.nodes[i][c] - box.lower_bound(c)) /
                                   (4. * tolerance));
          for (int n = 0; n < 27; ++n)
            {
              const auto found = boxes.find({{home[0] + n % 3 - 1,
                                              home[1] + n / 3 % 3 - 1,
                                              home[2] + n / 9 - 1}});
              if (found == boxes.end())
                continue;
              for (const unsigned int j : found->second)
                if (mesh_.nodes[i].distance(mesh_.nodes[j]) <= tolerance)
                  fail("the nodes " + node(j) + " and " + node(i) +
                       " lie at the same place; make them one (gmsh: "
                       "Coherence Mesh), or move them apart if a slit is "
                       "meant.");
            }
          boxes[home].push_back(i);
        }
    }


    /**
     * A middle must lie between the quarter points of its side, where the
     * Jacobian vanishes, and not further off than the side is long.
     */
    void
    MeshChecker::check_middles(const unsigned int cell) const
    {
      const auto &nodes = mesh_.cells[cell].nodes;
      const auto  far   = [&](const unsigned int i, const std::string &of) {
        fail("the " + mesh_.describe_node(nodes[i]) + " should be in the " +
             "middle of " + of + " of " + mesh_.describe_cell(cell) +
             " and is far off; is the order of the nodes right?");
      };
      for (const auto &side : CoarseCell::sides(mesh_.n_corners(cell)))
        {
          const Point<3>    &a     = mesh_.nodes[nodes[side.corners[0]]];
          const Point<3>    &b     = mesh_.nodes[nodes[side.corners[1]]];
          const Tensor<1, 3> chord = b - a;
          const Tensor<1, 3> offset =
            mesh_.nodes[nodes[side.middle]] - (a + 0.5 * chord);
          if (std::abs(offset * chord) >= 0.25 * chord.norm_square() ||
              offset.norm() > chord.norm())
            far(side.middle,
                describe({nodes[side.corners[0]], nodes[side.corners[1]]}));
        }
      if (nodes.size() < 9)
        return;
      const auto     points = mesh_.points(cell);
      const Point<3> centre = CoarseCell::serendipity_centre(points);
      const double   size =
        std::min(points[0].distance(points[3]), points[1].distance(points[2]));
      if (points[8].distance(centre) > 0.25 * size)
        far(8, "the nodes");
    }


    void
    MeshChecker::check_area(const unsigned int cell) const
    {
      const auto            points    = mesh_.points(cell);
      const unsigned int    n_corners = mesh_.n_corners(cell);
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
          fail(mesh_.describe_cell(cell) +
               " is degenerate: its area is zero, or zero at a point (corners "
               "at one place, on one line, or middles on quarter points).");
      for (const Tensor<1, 3> &normal : normals)
        if (!(normal * mean > 1e-8 * longest * mean.norm()))
          fail(mesh_.describe_cell(cell) +
               " is folded: its normal turns by more than 90 degrees within "
               "the cell (wrong order of nodes, a concave corner, or too "
               "large a cell).");
    }


    void
    MeshChecker::find_sides()
    {
      for (unsigned int k = 0; k < mesh_.cells.size(); ++k)
        for (const auto &side : CoarseCell::sides(mesh_.n_corners(k)))
          {
            const auto        &nodes  = mesh_.cells[k].nodes;
            const unsigned int a      = nodes[side.corners[0]];
            const unsigned int b      = nodes[side.corners[1]];
            const unsigned int middle = nodes.size() > mesh_.n_corners(k) ?
                                          nodes[side.middle] :
                                          numbers::invalid_unsigned_int;
            sides_[std::minmax(a, b)].push_back({k, a < b, middle});
          }
      for (const MeshFile::SideSet &set : mesh_.side_sets)
        {
          side_sets_.push_back({set.name, {}});
          for (const auto &[cell, side] : set.sides)
            {
              const auto &ends =
                CoarseCell::sides(mesh_.n_corners(cell))[side].corners;
              const auto &nodes = mesh_.cells[cell].nodes;
              side_sets_.back().second.push_back(
                std::minmax(nodes[ends[0]], nodes[ends[1]]));
            }
        }
      for (const auto &[line, sides] : sides_)
        {
          if (sides.size() > 2)
            fail(
              describe(line) + " is shared by " + std::to_string(sides.size()) +
              " cells: " + std::to_string(mesh_.cells[sides[0].cell].number) +
              ", " + std::to_string(mesh_.cells[sides[1].cell].number) + ", " +
              std::to_string(mesh_.cells[sides[2].cell].number) +
              (sides.size() > 3 ? ", ..." : "") +
              "; surfaces that branch aren't possible.");
          if (sides.size() == 2 && sides[0].middle != sides[1].middle)
            fail(describe(line) + " has the middle " + node(sides[0].middle) +
                 " in " + mesh_.describe_cell(sides[0].cell) + " and " +
                 node(sides[1].middle) + " in " +
                 mesh_.describe_cell(sides[1].cell) + ".");
        }
    }


    const MeshChecker::Side *
    MeshChecker::neighbor(const Line &line, const unsigned int cell) const
    {
      const auto &sides = sides_.at(line);
      if (sides.size() < 2)
        return nullptr;
      return &(sides[0].cell == cell ? sides[1] : sides[0]);
    }


    void
    MeshChecker::turn_over(const unsigned int cell)
    {
      const std::vector<unsigned int> old = mesh_.cells[cell].nodes;
      for (unsigned int i = 0; i < old.size(); ++i)
        mesh_.cells[cell].nodes[i] =
          old[CoarseCell::turned_over(old.size())[i]];
    }


    void
    MeshChecker::orient_cells()
    {
      enum : int
      {
        unknown = 0,
        kept    = 1,
        turned  = -1
      };
      std::vector<int>          state(mesh_.cells.size(), unknown);
      std::vector<unsigned int> reached = {0};
      state[0]                          = kept;
      for (unsigned int i = 0; i < reached.size(); ++i)
        {
          const unsigned int cell  = reached[i];
          const auto        &nodes = mesh_.cells[cell].nodes;
          for (const auto &[ends, middle] :
               CoarseCell::sides(mesh_.n_corners(cell)))
            {
              (void)middle;
              const unsigned int a = nodes[ends[0]], b = nodes[ends[1]];
              const Line         line  = std::minmax(a, b);
              const Side *const  other = neighbor(line, cell);
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
                fail("the cells can't be given one orientation: across " +
                     describe(line) + " " + mesh_.describe_cell(cell) +
                     " and " + mesh_.describe_cell(other->cell) +
                     " have opposite ones, whichever way one goes round; a "
                     "surface with one side only (a Moebius strip) isn't "
                     "possible.");
            }
        }
      const auto apart = std::find(state.begin(), state.end(), unknown);
      if (apart != state.end())
        fail("the mesh has several parts: " + mesh_.describe_cell(0) + " and " +
             mesh_.describe_cell(apart - state.begin()) +
             " aren't connected by common sides.");
      const int few = 2 * std::count(state.begin(), state.end(), turned) >
                          static_cast<std::ptrdiff_t>(state.size()) ?
                        kept :
                        turned;
      for (unsigned int k = 0; k < state.size(); ++k)
        if (state[k] == few)
          turn_over(k);
    }


    /** The side of a cell that a line element is; any order of its nodes. */
    MeshChecker::Line
    MeshChecker::side_of(const MeshFile::Element &element) const
    {
      const auto &nodes = element.nodes;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const auto found = sides_.find(std::minmax(nodes[i], nodes[j]));
            if (found != sides_.end() &&
                (nodes.size() == 2 ||
                 found->second[0].middle == nodes[3 - i - j]))
              return found->first;
          }
      fail("the line " + std::to_string(element.number) +
           " between the nodes " + node(nodes[0]) + " and " + node(nodes[1]) +
           " is no side of a cell.");
    }


    /** Groups of lines inside of the surface are no edges. */
    std::map<MeshChecker::Line, std::string>
    MeshChecker::named_lines() const
    {
      std::map<Line, std::string>                      names;
      std::map<std::string, const MeshFile::Element *> inside, outside;
      for (const MeshFile::Set &set : mesh_.line_sets)
        for (const unsigned int index : set.members)
          {
            const MeshFile::Element &element  = mesh_.lines[index];
            const Line               line     = side_of(element);
            const bool               interior = sides_.at(line).size() == 2;
            auto                    &found    = interior ? inside : outside;
            const auto              &other    = interior ? outside : inside;
            found[set.name]                   = &element;
            const auto part                   = other.find(set.name);
            if (part != other.end())
              fail("the group '" + set.name +
                   "' is partly inside of the surface: the line " +
                   std::to_string((interior ? element : *part->second).number) +
                   " lies between two cells.");
            if (interior)
              continue;
            const auto [entry, is_new] = names.emplace(line, set.name);
            if (!is_new && entry->second != set.name)
              fail(describe(line) + " is in two groups, '" + entry->second +
                   "' and '" + set.name + "'; one is possible.");
          }
      for (const auto &[name, lines] : side_sets_)
        for (const Line &line : lines)
          if (sides_.at(line).size() == 1)
            names.emplace(line, name);
      add_node_sets(names);
      return names;
    }


    /** A set of nodes stands for the sides of which it holds all nodes. */
    void
    MeshChecker::add_node_sets(std::map<Line, std::string> &names) const
    {
      std::map<Line, std::string> found;
      for (const MeshFile::Set &set : mesh_.node_sets)
        {
          const std::set<unsigned int> nodes(set.members.begin(),
                                             set.members.end());
          if (nodes.size() == mesh_.nodes.size())
            continue;
          for (const auto &[line, sides] : sides_)
            if (sides.size() == 1 && names.count(line) == 0 &&
                nodes.count(line.first) > 0 && nodes.count(line.second) > 0 &&
                (sides[0].middle == numbers::invalid_unsigned_int ||
                 nodes.count(sides[0].middle) > 0))
              {
                const auto [entry, is_new] = found.emplace(line, set.name);
                if (!is_new && entry->second != set.name)
                  fail(describe(line) + " is in two sets of nodes, '" +
                       entry->second + "' and '" + set.name +
                       "'; one is possible.");
              }
        }
      names.insert(found.begin(), found.end());
    }


    MeshBoundary
    MeshChecker::find_boundary() const
    {
      const auto   names = named_lines();
      MeshBoundary boundary;
      const auto   index_of = [&](const std::string &name) {
        const auto found =
          std::find(boundary.names.begin(), boundary.names.end(), name);
        if (found == boundary.names.end())
          {
            boundary.names.push_back(name);
            return boundary.names.size() - 1;
          }
        return static_cast<std::size_t>(found - boundary.names.begin());
      };
      // The order of the file first.
      for (const MeshFile::Set &set : mesh_.line_sets)
        if (sides_.at(side_of(mesh_.lines[set.members[0]])).size() == 1)
          index_of(set.name);
      std::set<std::string> in_use;
      for (const auto &[line, name] : names)
        in_use.insert(name);
      for (const MeshFile::Set &set : mesh_.node_sets)
        if (in_use.count(set.name) > 0)
          index_of(set.name);
      for (const auto &[line, sides] : sides_)
        if (sides.size() == 1)
          {
            const auto         name = names.find(line);
            const unsigned int edge =
              index_of(name == names.end() ? "boundary" : name->second);
            boundary.lines.push_back({line.first, line.second, edge});
          }
      return boundary;
    }
  } // namespace


  MeshBoundary
  check_mesh(MeshFile &mesh)
  {
    MeshChecker checker(mesh);
    checker.check_cells();
    checker.find_sides();
    checker.orient_cells();
    return checker.find_boundary();
  }
} // namespace Nacre
