// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/coarse_cell.h>
#include <nacre/problem/mesh_file.h>
#include <nacre/problem/mesh_reader.h>

#include <deal.II/base/exceptions.h>

#include <cctype>
#include <sstream>

namespace Nacre
{
  std::string
  MeshFile::describe_node(const unsigned int node) const
  {
    std::ostringstream text;
    text << "node " << node_numbers[node] << " at (" << nodes[node][0] << ", "
         << nodes[node][1] << ", " << nodes[node][2] << ')';
    return text.str();
  }


  std::string
  MeshFile::describe_cell(const unsigned int cell) const
  {
    const Element    &element = cells[cell];
    const std::string text    = "cell " + std::to_string(element.number);
    return instances.empty() || instances[element.instance].empty() ?
             text :
             text + " of '" + instances[element.instance] + "'";
  }


  unsigned int
  MeshFile::n_corners(const unsigned int cell) const
  {
    const auto n = cells[cell].nodes.size();
    return n == 3 || n == 6 ? 3 : 4;
  }


  std::vector<Point<3>>
  MeshFile::points(const unsigned int cell) const
  {
    std::vector<Point<3>> result;
    for (const unsigned int node : cells[cell].nodes)
      result.push_back(nodes[node]);
    if (result.size() == 8)
      result.push_back(CoarseCell::serendipity_centre(result));
    return result;
  }


  namespace
  {
    /** UCD files begin with comments, then five counts. */
    bool
    looks_like_ucd(const std::string &content)
    {
      std::istringstream in(content);
      std::string        line;
      while (std::getline(in, line))
        {
          std::istringstream words(line);
          std::string        word;
          unsigned int       n_words = 0;
          bool               digits  = true;
          while (words >> word)
            {
              if (n_words == 0 && word[0] == '#')
                break;
              ++n_words;
              for (const char c : word)
                digits =
                  digits && std::isdigit(static_cast<unsigned char>(c)) != 0;
            }
          if (n_words > 0)
            return n_words == 5 && digits;
        }
      return false;
    }

    [[noreturn]] void
    refuse_unknown_format(const std::string &path, std::string first)
    {
      for (char &c : first)
        if (std::isprint(static_cast<unsigned char>(c)) == 0)
          c = '?';
      throw StandardExceptions::ExcMessage(
        "The file '" + path +
        "' isn't a mesh of a known format; it begins with '" + first +
        "'. Known, as text: gmsh .msh 2.2 and 4.1 ($MeshFormat), "
        "legacy VTK (# vtk DataFile), Abaqus .inp (*HEADING, *NODE), "
        "UCD (five counts).");
    }
  } // namespace


  MeshFile
  read_mesh(const InputFile &file, const OpenFile &open)
  {
    MeshText          text(file.content, file.path);
    const bool        empty = text.at_end();
    const std::string first = text.peek_line().substr(0, 60);
    AssertThrow(!empty,
                ExcMessage("The mesh file '" + file.path + "' is empty."));
    refuse_other_formats(file);
    MeshFile mesh;
    if (Text::begins_with(first, "$"))
      mesh = read_gmsh_mesh(text);
    else if (Text::begins_with(first, "# vtk"))
      mesh = read_vtk_mesh(text);
    else if (Text::begins_with(first, "*"))
      mesh = read_abaqus_mesh(text, open);
    else if (looks_like_ucd(file.content))
      mesh = read_ucd_mesh(text);
    else
      refuse_unknown_format(file.path, first);
    make_triangles_of_collapsed_cells(mesh);
    return mesh;
  }
} // namespace Nacre
