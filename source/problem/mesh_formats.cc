// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/mesh_reader.h>

#include <deal.II/base/exceptions.h>

#include <cctype>
#include <sstream>

namespace Nacre
{
  namespace
  {
    struct Format
    {
      std::string name;
      /** How to make a file of it that Nacre reads. */
      std::string remedy;
    };

    const Format nastran = {"Nastran bulk data",
                            "gmsh FILE -save -format msh2 -o mesh.msh"};
    const Format ls_dyna = {"an LS-DYNA keyword file",
                            "write it as Abaqus .inp or gmsh .msh with the "
                            "preprocessor that made it"};
    const Format gmsh_1  = {"gmsh's format 1 ($NOD)",
                            "gmsh FILE -save -format msh2 -o mesh.msh"};

    /** Formats that the first characters tell. */
    const Format *
    by_first_characters(const std::string &content)
    {
      static const std::vector<std::pair<std::string, Format>> formats = {
        {"\x89HDF",
         {"an HDF5 file (as Exodus, MED, CGNS, XDMF)",
          "meshio convert FILE mesh.msh --output-format gmsh22 --ascii"}},
        {"CDF",
         {"a NetCDF file (as Exodus)",
          "meshio convert FILE mesh.msh --output-format gmsh22 --ascii"}},
        {"<?xml",
         {"XML (as VTK's .vtu)",
          "meshio convert FILE mesh.vtk --output-format vtk42 --ascii"}},
        {"<VTKFile",
         {"VTK's XML (.vtu)",
          "meshio convert FILE mesh.vtk --output-format vtk42 --ascii"}},
        {"ply",
         {"a PLY file",
          "meshio convert FILE mesh.msh --output-format gmsh22 --ascii"}},
        {"solid",
         {"an STL file, whose triangles aren't connected",
          "gmsh FILE -save -format msh2 -o mesh.msh"}},
        {"ISO-10303",
         {"a STEP file, a geometry without a mesh",
          "gmsh FILE -2 -format msh2 -o mesh.msh"}}};
      for (const auto &[begin, format] : formats)
        if (Text::begins_with(content, begin))
          return &format;
      return nullptr;
    }

    /** Formats that the first lines that aren't comments tell. */
    const Format *
    by_first_lines(const std::string &content)
    {
      static const Format obj = {"a Wavefront OBJ file",
                                 "meshio convert FILE mesh.msh "
                                 "--output-format gmsh22 --ascii"};
      static const Format geo = {"a gmsh geometry (.geo), not a mesh",
                                 "gmsh FILE -2 -format msh2 -o mesh.msh"};
      std::istringstream  in(content);
      std::string         line;
      bool                dollar = false;
      while (std::getline(in, line))
        {
          line = Text::trim(line);
          if (line.empty() || line[0] == '#' || Text::begins_with(line, "//"))
            continue;
          if (Text::begins_with(line, "$NOD"))
            return &gmsh_1;
          // A comment of Nastran and LS-DYNA.
          if (line[0] == '$')
            {
              dollar = true;
              continue;
            }
          std::string word;
          for (const char c : line.substr(0, line.find_first_of(" ,*\t=(", 1)))
            word += std::toupper(static_cast<unsigned char>(c));
          // Keywords of Abaqus have no underscore.
          if (word[0] == '*')
            return dollar || word == "*KEYWORD" ||
                       content.find("\n*ELEMENT_") != std::string::npos ?
                     &ls_dyna :
                     nullptr;
          for (const char *const card : {"SOL",
                                         "CEND",
                                         "BEGIN",
                                         "GRID",
                                         "CQUAD4",
                                         "CTRIA3",
                                         "NASTRAN",
                                         "ID",
                                         "INIT",
                                         "ASSIGN"})
            if (word == card)
              return &nastran;
          if (word == "V" || word == "VN" || word == "MTLLIB")
            return &obj;
          if (word == "POINT" || word == "SETFACTORY")
            return &geo;
          return nullptr;
        }
      return nullptr;
    }
  } // namespace


  void
  refuse_other_formats(const InputFile &file)
  {
    // Its title may be anything.
    if (Text::begins_with(file.content, "# vtk"))
      return;
    const Format *format = by_first_characters(file.content);
    if (format == nullptr)
      format = by_first_lines(file.content);
    if (format == nullptr)
      return;
    throw StandardExceptions::ExcMessage(
      "The mesh file '" + file.path + "' is " + format->name +
      ", which Nacre doesn't read. Known, as text: gmsh .msh 2.2 and 4.1, "
      "legacy VTK, Abaqus .inp, UCD. To convert it: " +
      format->remedy + ".");
  }
} // namespace Nacre
