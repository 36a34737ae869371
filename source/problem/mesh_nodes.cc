// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_checks.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /**
     * Nodes nearer to each other than this part of the sides around them are
     * meant to be one.
     */
    constexpr double seam_tolerance = 1e-3;

    std::string
    number(const MeshFile &mesh, const unsigned int node)
    {
      return std::to_string(mesh.node_numbers[node]);
    }

    std::vector<bool>
    nodes_of_cells(const MeshFile &mesh)
    {
      std::vector<bool> used(mesh.nodes.size(), false);
      for (const MeshFile::Element &cell : mesh.cells)
        for (const unsigned int node : cell.nodes)
          used[node] = true;
      return used;
    }

    /** The nodes of cells, found by their place. */
    class NodeTree
    {
    public:
      explicit NodeTree(const MeshFile &mesh)
        : mesh_(mesh)
      {
        const std::vector<bool> used = nodes_of_cells(mesh);
        for (unsigned int i = 0; i < used.size(); ++i)
          if (used[i])
            nodes_.emplace_back(mesh.nodes[i], i);
        tree_ = pack_rtree(nodes_);
      }

      /** All nodes of cells. */
      const std::vector<std::pair<Point<3>, unsigned int>> &
      nodes() const
      {
        return nodes_;
      }

      /** Those before @p node that are at most @p distance away, ascending. */
      std::vector<unsigned int>
      earlier(const unsigned int node, const double distance) const
      {
        namespace index               = boost::geometry::index;
        const Point<3>           &x   = mesh_.nodes[node];
        const Tensor<1, 3>        gap = distance * Tensor<1, 3>({1., 1., 1.});
        const BoundingBox<3>      box(std::make_pair(x - gap, x + gap));
        std::vector<unsigned int> result;
        for (const auto &[position, i] :
             tree_ | index::adaptors::queried(index::intersects(box)))
          if (i < node && position.distance(x) <= distance)
            result.push_back(i);
        std::sort(result.begin(), result.end());
        return result;
      }

    private:
      const MeshFile                                &mesh_;
      std::vector<std::pair<Point<3>, unsigned int>> nodes_;
      RTree<std::pair<Point<3>, unsigned int>>       tree_;
    };

    /** Of every node the least distance of corners on a side around it. */
    std::vector<double>
    sizes_of_sides(const MeshFile &mesh)
    {
      std::vector<double> sizes(mesh.nodes.size(),
                                std::numeric_limits<double>::max());
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        {
          const auto &nodes = mesh.cells[k].nodes;
          double      size  = std::numeric_limits<double>::max();
          for (const auto &side : CoarseCell::sides(mesh.n_corners(k)))
            size = std::min(size,
                            mesh.nodes[nodes[side.corners[0]]].distance(
                              mesh.nodes[nodes[side.corners[1]]]));
          for (const unsigned int node : nodes)
            sizes[node] = std::min(sizes[node], size);
        }
      return sizes;
    }

    /** "the nodes 5 and 8 ... apart" */
    std::string
    describe_pair(const MeshFile    &mesh,
                  const unsigned int first,
                  const unsigned int second)
    {
      const Point<3>    &x = mesh.nodes[first];
      std::ostringstream text;
      text << "the nodes " << number(mesh, first) << " and "
           << number(mesh, second) << " lie at the same place, (" << x[0]
           << ", " << x[1] << ", " << x[2] << ")";
      const double distance = x.distance(mesh.nodes[second]);
      if (distance > 0.)
        text << ", " << distance << " apart";
      return text.str();
    }

    /** A straight piece of a side of the boundary. */
    struct Piece
    {
      unsigned int begin;
      unsigned int end;
      MeshLine     line;
    };

    /** Sides of the boundary, in halves if they have a middle. */
    std::vector<Piece>
    boundary_pieces(const MeshSides &sides)
    {
      std::vector<Piece> pieces;
      for (const auto &[line, cells] : sides)
        {
          if (cells.size() != 1)
            continue;
          const unsigned int middle = cells[0].middle;
          if (middle == numbers::invalid_unsigned_int)
            pieces.push_back({line.first, line.second, line});
          else
            {
              pieces.push_back({line.first, middle, line});
              pieces.push_back({middle, line.second, line});
            }
        }
      return pieces;
    }

    /** From @p x to the straight line between two points. */
    double
    distance_to_piece(const Point<3> &x, const Point<3> &a, const Point<3> &b)
    {
      const Tensor<1, 3> along = b - a;
      const double       t =
        std::clamp((x - a) * along / along.norm_square(), 0., 1.);
      return x.distance(a + t * along);
    }

    /** Put @p into[node] in the place of each node of the mesh. */
    void
    renumber(MeshFile &mesh, const std::vector<unsigned int> &into)
    {
      for (auto *const elements : {&mesh.cells, &mesh.lines})
        for (MeshFile::Element &element : *elements)
          for (unsigned int &node : element.nodes)
            node = into[node];
      for (MeshFile::Set &set : mesh.node_sets)
        {
          for (unsigned int &node : set.members)
            node = into[node];
          std::sort(set.members.begin(), set.members.end());
          set.members.erase(std::unique(set.members.begin(), set.members.end()),
                            set.members.end());
        }
    }
  } // namespace


  void
  fail(const MeshFile &mesh, const std::string &text)
  {
    throw StandardExceptions::ExcMessage("The mesh file '" + mesh.path +
                                         "': " + text);
  }


  std::string
  describe(const MeshFile &mesh, const MeshLine &line)
  {
    return "the side between the nodes " + number(mesh, line.first) + " and " +
           number(mesh, line.second);
  }


  void
  leave_out_unused_nodes(MeshFile &mesh)
  {
    const std::vector<bool> used = nodes_of_cells(mesh);
    const auto              n    = std::count(used.begin(), used.end(), false);
    if (n == 0)
      return;
    for (MeshFile::Set &set : mesh.node_sets)
      set.members.erase(std::remove_if(set.members.begin(),
                                       set.members.end(),
                                       [&](const unsigned int node) {
                                         return !used[node];
                                       }),
                        set.members.end());
    const std::string first = mesh.describe_node(
      std::find(used.begin(), used.end(), false) - used.begin());
    mesh.notes.push_back(
      n == 1 ? "The " + first + " belongs to no cell and is left out." :
               std::to_string(n) +
                 " nodes belong to no cell and are left out; the first is " +
                 first + ".");
  }


  void
  merge_nodes(MeshFile &mesh, const double distance)
  {
    if (distance == 0.)
      return;
    std::vector<unsigned int> into(mesh.nodes.size());
    std::iota(into.begin(), into.end(), 0);
    const auto root = [&](unsigned int node) {
      while (into[node] != node)
        node = into[node] = into[into[node]];
      return node;
    };
    const NodeTree tree(mesh);
    for (const auto &[x, node] : tree.nodes())
      for (const unsigned int other : tree.earlier(node, distance))
        {
          const unsigned int first = root(node), second = root(other);
          into[std::max(first, second)] = std::min(first, second);
        }
    unsigned int n_merged = 0, first = 0;
    for (unsigned int node = into.size(); node-- > 0;)
      if (root(node) != node)
        {
          ++n_merged;
          first = node;
        }
    if (n_merged == 0)
      return;

    for (unsigned int node = 0; node < into.size(); ++node)
      into[node] = root(node);
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      {
        std::map<unsigned int, unsigned int> seen;
        for (const unsigned int node : mesh.cells[k].nodes)
          {
            const auto [other, is_new] = seen.emplace(into[node], node);
            if (!is_new && other->second != node)
              fail(mesh,
                   mesh.describe_cell(k) + " has both of the nodes " +
                     number(mesh, other->second) + " and " +
                     number(mesh, node) +
                     ", which Mid-surface/file/Merge distance would make "
                     "one; it must be smaller than the cells.");
          }
      }
    std::ostringstream text;
    text << n_merged << (n_merged == 1 ? " node is" : " nodes are")
         << " merged with others at most " << distance
         << " away; the first is the node " << number(mesh, first)
         << ", with the node " << number(mesh, into[first]) << ".";
    mesh.notes.push_back(text.str());
    renumber(mesh, into);
  }


  void
  check_places(MeshFile &mesh, const bool slits)
  {
    const NodeTree            tree(mesh);
    const std::vector<double> sizes   = sizes_of_sides(mesh);
    unsigned int              n_pairs = 0;
    std::string               first;
    for (const auto &[x, node] : tree.nodes())
      for (const unsigned int other :
           tree.earlier(node, seam_tolerance * sizes[node]))
        {
          const double size = std::min(sizes[node], sizes[other]);
          if (x.distance(mesh.nodes[other]) > seam_tolerance * size)
            continue;
          const std::string pair = describe_pair(mesh, other, node);
          if (!slits)
            fail(mesh,
                 pair +
                   "; the surface gapes there. Make them one (gmsh: Coherence "
                   "Mesh; or Mid-surface/file/Merge distance, larger than "
                   "that), or choose Mid-surface/file/Slits = allowed if a "
                   "slit is meant.");
          if (n_pairs++ == 0)
            first = pair;
        }
    if (n_pairs > 0)
      mesh.notes.push_back(
        std::to_string(n_pairs) +
        (n_pairs == 1 ? " pair of nodes is" : " pairs of nodes are") +
        " taken as the lips of slits; the first: " + first + ".");
  }


  void
  check_hanging_nodes(const MeshFile &mesh, const MeshSides &sides)
  {
    namespace index                     = boost::geometry::index;
    const std::vector<Piece>  pieces    = boundary_pieces(sides);
    const std::vector<double> sizes     = sizes_of_sides(mesh);
    const auto                tolerance = [&](const Piece &piece) {
      return seam_tolerance * std::min(sizes[piece.begin], sizes[piece.end]);
    };
    std::vector<std::pair<BoundingBox<3>, unsigned int>> boxes;
    for (unsigned int i = 0; i < pieces.size(); ++i)
      {
        BoundingBox<3> box(std::vector<Point<3>>{mesh.nodes[pieces[i].begin],
                                                 mesh.nodes[pieces[i].end]});
        box.extend(tolerance(pieces[i]));
        boxes.emplace_back(box, i);
      }
    const auto tree = pack_rtree(boxes);
    for (const Piece &own : pieces)
      for (const unsigned int node : {own.begin, own.end})
        for (const auto &[box, i] :
             tree |
               index::adaptors::queried(index::intersects(mesh.nodes[node])))
          {
            const Piece       &piece = pieces[i];
            const unsigned int cell  = sides.at(piece.line)[0].cell;
            const auto        &nodes = mesh.cells[cell].nodes;
            if (std::find(nodes.begin(), nodes.end(), node) == nodes.end() &&
                distance_to_piece(mesh.nodes[node],
                                  mesh.nodes[piece.begin],
                                  mesh.nodes[piece.end]) <=
                  std::min(tolerance(piece), tolerance(own)))
              fail(mesh,
                   "the " + mesh.describe_node(node) + " lies on " +
                     describe(mesh, piece.line) + " of " +
                     mesh.describe_cell(cell) +
                     ", which hasn't got it; the surface gapes there. Let "
                     "the cells on both sides have the same nodes, or choose "
                     "Mid-surface/file/Slits = allowed if a slit is meant.");
          }
  }
} // namespace Nacre
