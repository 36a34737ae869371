// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/mesh_reader.h>

#include <sstream>

namespace Nacre
{
  namespace
  {
    ElementKind
    to_kind(const std::string &type, const unsigned int n_nodes)
    {
      using Shape                                      = ElementShape;
      static const std::map<std::string, Shape> shapes = {
        {"pt", Shape::point},
        {"line", Shape::line},
        {"tri", Shape::triangle},
        {"quad", Shape::quadrilateral},
        {"tet", Shape::solid},
        {"hex", Shape::solid},
        {"prism", Shape::solid},
        {"pyr", Shape::solid}};
      const auto found = shapes.find(type);
      return {found == shapes.end() ? Shape::other : found->second,
              n_nodes,
              "'" + type + "' with " + std::to_string(n_nodes) + " nodes"};
    }
  } // namespace


  MeshFile
  read_ucd_mesh(MeshText &text)
  {
    MeshBuilder builder(text);
    while (text.peek_line().find('#') == 0)
      {
        text.at_end();
        text.line("a comment");
      }
    const auto n_nodes = text.count("the number of nodes");
    const auto n_cells = text.count("the number of cells");
    for (const char *const data : {"nodal", "cell", "model"})
      text.count("the number of " + std::string(data) + " data");
    for (std::size_t i = 0; i < n_nodes; ++i)
      {
        const std::string what =
          "node " + std::to_string(i + 1) + " of " + std::to_string(n_nodes);
        const long long number = text.integer(what);
        builder.add_node(number, text.point(what));
      }
    for (std::size_t i = 0; i < n_cells; ++i)
      {
        const std::string what =
          "cell " + std::to_string(i + 1) + " of " + std::to_string(n_cells);
        text.at_end();
        std::istringstream     words(text.line(what));
        std::string            number, material, type, node;
        std::vector<long long> nodes;
        words >> number >> material >> type;
        while (words >> node)
          nodes.push_back(text.to_integer(node, "a node of " + what));
        const long long cell = text.to_integer(number, "the number of " + what);
        const long long group =
          text.to_integer(material, "the material of " + what);
        builder.add_element(cell,
                            to_kind(type, nodes.size()),
                            nodes,
                            group_names(group));
      }
    return builder.finish();
  }
} // namespace Nacre
