// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_reader.h>

#include <deal.II/base/exceptions.h>

#include <array>
#include <optional>

namespace Nacre
{
  namespace
  {
    /** The side of a quadrilateral whose ends (and middle) are one node. */
    std::optional<unsigned int>
    collapsed_side(const MeshFile::Element &cell)
    {
      const auto &nodes = cell.nodes;
      if (nodes.size() != 4 && nodes.size() != 8)
        return {};
      const auto &sides = CoarseCell::sides(4);
      for (unsigned int s = 0; s < 4; ++s)
        {
          const unsigned int node = nodes[sides[s].corners[0]];
          if (nodes[sides[s].corners[1]] == node &&
              (nodes.size() == 4 || nodes[sides[s].middle] == node))
            return s;
        }
      return {};
    }

    /** Its nodes as a triangle's: CoarseCell's order. */
    std::vector<unsigned int>
    as_triangle(const std::vector<unsigned int> &nodes, const unsigned int side)
    {
      std::vector<unsigned int> corners, middles;
      for (unsigned int s = 0; s < 4; ++s)
        if (s != side)
          {
            const auto &kept = CoarseCell::sides(4)[s];
            // The corners of the side are one: the side after it begins there.
            corners.push_back(nodes[kept.corners[0]]);
            if (nodes.size() == 8)
              middles.push_back(nodes[kept.middle]);
          }
      corners.insert(corners.end(), middles.begin(), middles.end());
      return corners;
    }
  } // namespace


  void
  make_triangles_of_collapsed_cells(MeshFile &mesh)
  {
    std::vector<std::optional<unsigned int>> sides;
    unsigned int                             first = mesh.cells.size();
    bool                                     all   = true;
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      {
        sides.push_back(collapsed_side(mesh.cells[k]));
        all = all && sides[k];
        if (sides[k] && first == mesh.cells.size())
          first = k;
      }
    if (first == mesh.cells.size())
      return;
    const auto        &cell = mesh.cells[first];
    const unsigned int node =
      cell.nodes[CoarseCell::sides(4)[*sides[first]].corners[0]];
    AssertThrow(all,
                ExcMessage("The mesh file '" + mesh.path +
                           "': " + mesh.describe_cell(first) +
                           " is a quadrilateral with the node " +
                           std::to_string(mesh.node_numbers[node]) +
                           " twice, which is a triangle. Triangles and "
                           "quadrilaterals in one mesh aren't possible: mesh "
                           "the surface with one of them alone."));
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      mesh.cells[k].nodes = as_triangle(mesh.cells[k].nodes, *sides[k]);
    for (MeshFile::SideSet &set : mesh.side_sets)
      {
        std::vector<std::pair<unsigned int, unsigned int>> kept;
        for (const auto &[k, side] : set.sides)
          if (side != *sides[k])
            kept.emplace_back(k, side - (side > *sides[k] ? 1 : 0));
        set.sides = std::move(kept);
      }
    mesh.notes.push_back("All cells are quadrilaterals with a node twice; they "
                         "are taken as triangles.");
  }
} // namespace Nacre
