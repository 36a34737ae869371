// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/problem/mesh_checks.h>
#include <nacre/problem/surface_projection.h>
#include <nacre/problem/surfaces.h>

#include <algorithm>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Nodes may lie off the surface by this part of their cell's size. */
    constexpr double projection_tolerance = 0.1;

    std::vector<std::string>
    named_surfaces()
    {
      std::vector<std::string> names;
      for (const SurfaceKind &kind : surface_kinds())
        if (kind.make != make_file_surface)
          names.push_back(kind.name);
      return names;
    }

    std::unique_ptr<const SurfaceProjection>
    make_projection(const SurfaceInput &input, const std::string &name)
    {
      const SurfaceInput of_surface = input.of_map(name);
      for (const SurfaceKind &kind : surface_kinds())
        if (kind.name == name)
          return std::make_unique<const SurfaceProjection>(kind.make(
                                                             of_surface),
                                                           of_surface.where());
      Assert(false, ExcInternalError());
      return nullptr;
    }

    /** A mesh of another surface must not be bent into this one. */
    void
    check_distances(const MeshFile          &mesh,
                    const SurfaceProjection &projection,
                    const std::string       &name)
    {
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        {
          const auto   points = mesh.points(k);
          const double size   = points[0].distance(points[1]);
          for (unsigned int i = 0; i < mesh.n_corners(k); ++i)
            {
              const double distance = points[i].distance(projection(points[i]));
              if (distance <= projection_tolerance * size)
                continue;
              std::ostringstream text;
              text << "The mesh file '" << mesh.path << "': the "
                   << mesh.describe_node(mesh.cells[k].nodes[i]) << " is "
                   << distance << " away from the surface '" << name
                   << "' of Mid-surface/file/Curvature, too far for "
                   << mesh.describe_cell(k)
                   << "; are the parameters in Mid-surface/" << name
                   << " those of the mesh?";
              AssertThrow(false, ExcMessage(text.str()));
            }
        }
    }

    /** Vertices are the corners, in the order of the nodes. */
    std::vector<unsigned int>
    number_vertices(const MeshFile &mesh, SurfaceDescription &surface)
    {
      std::vector<unsigned int> vertex(mesh.nodes.size(),
                                       numbers::invalid_unsigned_int);
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        for (unsigned int i = 0; i < mesh.n_corners(k); ++i)
          vertex[mesh.cells[k].nodes[i]] = 0;
      for (unsigned int &v : vertex)
        if (v == 0)
          v = surface.n_vertices++;
      return vertex;
    }

    SurfaceDescription
    describe_surface(const MeshFile &mesh, MeshNames &&names, const bool flat)
    {
      SurfaceDescription surface;
      const auto         vertex = number_vertices(mesh, surface);
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        {
          SurfaceDescription::Cell cell;
          const unsigned int       n_corners = mesh.n_corners(k);
          cell.vertices.clear();
          for (unsigned int i = 0; i < n_corners; ++i)
            cell.vertices.push_back(vertex[mesh.cells[k].nodes[i]]);
          cell.chart = mesh.points(k);
          if (flat)
            cell.chart.resize(n_corners);
          cell.region = names.region_of_cell[k];
          surface.cells.push_back(std::move(cell));
          surface.cell_names.push_back(mesh.describe_cell(k) + " of '" +
                                       mesh.path + "'");
        }
      for (const auto &[line, edge] : names.edge_of_line)
        surface
          .edge_of_line[std::minmax(vertex[line.first], vertex[line.second])] =
          edge;
      surface.edges      = std::move(names.edges);
      surface.edge_names = std::move(names.edge_names);
      surface.regions    = std::move(names.regions);
      for (const std::string &note : mesh.notes)
        surface.notes.push_back("The mesh file '" + mesh.path + "': " + note);
      return surface;
    }

    /** What nodes that lie at one place are. */
    enum class Slits
    {
      refused,
      allowed
    };

    const Selection<Slits> &
    selection(Slits)
    {
      static const Selection<Slits> table = {{Slits::refused, "refused"},
                                             {Slits::allowed, "allowed"}};
      return table;
    }

    double
    merge_distance(const SurfaceInput &input)
    {
      const double distance = input.number("Merge distance");
      AssertThrow(distance >= 0.,
                  ExcMessage(input.where("Merge distance") + ": found " +
                             input.text("Merge distance") +
                             "; it must not be negative."));
      return distance;
    }
  } // namespace


  SurfaceDescription
  make_file_surface(const SurfaceInput &input)
  {
    std::vector<std::string> curvatures = named_surfaces();
    curvatures.insert(curvatures.begin(), {"file", "flat"});
    const std::string curvature = input.choice("Curvature", curvatures);
    const InputFile   file      = input.file("File name");

    MeshFile mesh = read_mesh(file,
                              [&input](const std::string &name,
                                       const std::string &folder,
                                       const std::string &where) {
                                return input.file_beside(name, folder, where);
                              });
    leave_out_unused_nodes(mesh);
    merge_nodes(mesh, merge_distance(input));
    const bool slits = input.choice<Slits>("Slits") == Slits::allowed;
    check_places(mesh, slits);
    check_cells(mesh);
    const MeshSides sides = find_sides(mesh);
    if (!slits)
      check_hanging_nodes(mesh, sides);
    MeshNames names = find_names(mesh, sides);
    orient_cells(mesh, sides);
    SurfaceDescription surface =
      describe_surface(mesh, std::move(names), curvature == "flat");
    if (curvature == "file" || curvature == "flat")
      surface.map = make_chart_map([](const Point<3> &point) { return point; });
    else
      {
        auto projection = make_projection(input, curvature);
        check_distances(mesh, *projection, curvature);
        // Cells are as good on the surface as they are close to it.
        surface.is_checked = true;
        surface.map        = make_chart_map(
          [projection = std::move(projection)](const Point<3> &point) {
            return (*projection)(point);
          });
      }
    return surface;
  }


  std::vector<SurfaceParameter>
  file_surface_parameters()
  {
    return {
      {"File name",
       "",
       "The mesh: gmsh .msh (2.2, 4.1), legacy VTK, Abaqus .inp or UCD, as "
       "text; cells with 3, 4, 6, 8 or 9 nodes. Its groups of lines and sets "
       "of nodes or sides are the edges; what no edge of a condition or load "
       "holds is the edge 'boundary'; its groups of cells "
       "are regions for Section/Regions. A relative name starts from the "
       "folder of the parameter file if it exists there, else from the "
       "current folder. Units: none"},
      {"Curvature",
       "file",
       "file: the nodes define the surface, in second-order cells with the "
       "middles of the sides; flat: only the corners count, sides are "
       "straight; or the name of a surface: everything is projected onto that "
       "surface with the parameters of its subsection. Units: none"},
      {"Merge distance",
       "0",
       "Nodes at most so far from each other become one, as along a seam that "
       "isn't merged in the file; 0: none. Units: length"},
      {"Slits",
       "refused",
       "Nodes of different cells at the same place (nearer than 1/1000 of the "
       "sides of their cells), after merging: refused, they are a seam that "
       "isn't merged; allowed, they are the lips of a slit. Units: none"}};
  }
} // namespace Nacre
