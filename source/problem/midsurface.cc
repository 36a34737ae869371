// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/midsurface.h>
#include <nacre/problem/parametric_surface.h>
#include <nacre/problem/surfaces.h>

#include <deal.II/distributed/tria.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** "u = 0" and "u=0" are the same edge. */
    std::string
    without_spaces(std::string name)
    {
      name = Text::trim(name);
      for (std::size_t i = name.find('='); i != std::string::npos;
           i             = name.find('=', i))
        {
                      while (i > 0 && name[i - 1] == ' ')
            name.erase(--i, 1);
          while (i + 1 < name.size() && name[i + 1] == ' ')
            name.erase(i + 1, 1);
          ++i;
        }
      return name;
    }

    std::string
    list_of_surfaces()
    {
      std::string text;
      for (const SurfaceKind &kind : surface_kinds())
        text += (text.empty() ? "" : " | ") + kind.name;
      return text;
    }
  } // namespace


  Midsurface::Midsurface()
    : ParameterAcceptor("/Mid-surface")
  {
    add_parameter("Surface",
                  surface_name_,
                  "The surface: " + list_of_surfaces() +
                    "; its parameters are in the subsection of its name, "
                    "lengths and angles may be expressions of the constants. "
                    "Units: none");
    add_parameter("Subdivisions",
                  subdivisions_,
                  "Coarse cells along u and v, before any refinement; one "
                  "number for both. Closed directions need at least 3. Units: "
                  "none");
    add_parameter("Grading u",
                  grading_[0],
                  "Expression g(s) that grows from 0 at s = 0 to 1 at s = 1, "
                  "e.g. s^2: coarse mesh line i of n lies at g(i/n) of the "
                  "range of u (of each leg of a folded strip). Refinement "
                  "halves the coarse cells. Units: none");
    add_parameter("Grading v",
                  grading_[1],
                  "The same for the lines across v. Units: none");

    for (const SurfaceKind &kind : surface_kinds())
      {
        enter_subsection(kind.name);
        for (const SurfaceParameter &parameter : kind.parameters)
          {
            std::string &value = values_[kind.name][parameter.name];
            value              = parameter.default_value;
            add_parameter(parameter.name, value, parameter.documentation);
          }
        leave_subsection();
      }
  }


  Midsurface::~Midsurface() = default;


  void
  Midsurface::prepare(const Constants &constants)
  {
    const std::string        path  = "Mid-surface";
    const std::string        name  = Text::trim(surface_name_);
    const auto              &kinds = surface_kinds();
    std::vector<std::string> names;
    for (const SurfaceKind &kind : kinds)
      names.push_back(kind.name);
    const auto found = std::find(names.begin(), names.end(), name);
    AssertThrow(
      found != names.end(),
      ExcMessage(
        Text::unknown_name(path + "/Surface", "surface", name, names)));

    const SurfaceInput input(path,
                             name,
                             values_.at(name),
                             {subdivisions_, grading_},
                             constants);
    surface_ = std::make_unique<const ParametricSurface>(
      kinds[found - names.begin()].make(input),
      input.where());

    edge_names_.clear();
    for (const SurfaceDescription::Edge &edge : surface_->edges())
      edge_names_.push_back(edge.name);
  }


  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  Midsurface::create_triangulation(const MPI_Comm     communicator,
                                   const unsigned int n_refinements) const
  {
    Assert(surface_ != nullptr, ExcMessage("Call prepare() first."));

    std::vector<CellData<dim>> cells(surface_->cells().size());
    for (unsigned int k = 0; k < cells.size(); ++k)
      cells[k].vertices.assign(surface_->cells()[k].vertices.begin(),
                               surface_->cells()[k].vertices.end());
    SubCellData boundary;
    for (const ParametricSurface::BoundaryLine &line :
         surface_->boundary_lines())
      {
        CellData<1> data;
        data.vertices.assign(line.vertices.begin(), line.vertices.end());
        data.boundary_id = line.edge;
        boundary.boundary_lines.push_back(data);
      }

    auto triangulation =
      std::make_unique<parallel::distributed::Triangulation<dim, spacedim>>(
        communicator);
    triangulation->create_triangulation(surface_->vertices(), cells, boundary);
    triangulation->refine_global(n_refinements);

    // Without a manifold, refinement puts new vertices on chords. Only what
    // looks at the triangulation alone (a cell's diameter) notices.
    if (n_refinements > 0)
      for (const auto &cell : triangulation->active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          cell->vertex(v) = position(cell, Point<dim>(v % 2, v / 2));
    return triangulation;
  }


  Point<spacedim>
  Midsurface::position(const Triangulation<dim, spacedim>::cell_iterator &cell,
                       const Point<dim> &unit) const
  {
    Assert(surface_ != nullptr, ExcMessage("Call prepare() first."));

    // Up to the coarse cell. Its index is the order in which the cells were
    // given; the number in cell->id() is not, p4est has an order of its own.
    Point<dim> coarse_unit = unit;
    auto       ancestor    = cell;
    while (ancestor->level() > 0)
      {
        const auto   parent = ancestor->parent();
        unsigned int child  = 0;
        while (parent->child_index(child) != ancestor->index())
          ++child;
        coarse_unit[0] = 0.5 * (child % 2 + coarse_unit[0]);
        coarse_unit[1] = 0.5 * (child / 2 + coarse_unit[1]);
        ancestor       = parent;
      }
    return surface_->position(ancestor->index(), coarse_unit);
  }


  const std::vector<std::string> &
  Midsurface::edge_names() const
  {
    return edge_names_;
  }


  types::boundary_id
  Midsurface::edge_id(const std::string &name, const std::string &where) const
  {
    Assert(surface_ != nullptr, ExcMessage("Call prepare() first."));

    const std::string        wanted = without_spaces(name);
    std::vector<std::string> known;
    for (unsigned int e = 0; e < surface_->edges().size(); ++e)
      {
        const SurfaceDescription::Edge &edge = surface_->edges()[e];
        if (wanted == edge.name ||
            std::find(edge.aliases.begin(), edge.aliases.end(), wanted) !=
              edge.aliases.end())
          return e;
        known.push_back(edge.name);
        known.insert(known.end(), edge.aliases.begin(), edge.aliases.end());
      }
    AssertThrow(!known.empty(),
                ExcMessage(where + ": unknown edge '" + wanted +
                           "': the surface '" + Text::trim(surface_name_) +
                           "' is closed and has no edges."));
    AssertThrow(false,
                ExcMessage(Text::unknown_name(where, "edge", wanted, known)));
    return numbers::invalid_boundary_id;
  }
} // namespace Nacre
