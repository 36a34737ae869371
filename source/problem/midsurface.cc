// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/text.h>
#include <nacre/problem/midsurface.h>
#include <nacre/problem/parametric_surface.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

#include <algorithm>
#include <cmath>
#include <map>

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

    /** Without quotes; if it has none, without spaces that don't matter. */
    std::string
    plain_name(const std::string &name)
    {
      const std::string text  = Text::trim(name);
      const std::string plain = Text::unquoted(text);
      return plain == text ? without_spaces(plain) : plain;
    }

    /** Whether a plain_name() is a name of the surface. */
    bool
    is_same_name(const std::string &known,
                 const std::string &plain,
                 const bool         ignore_case)
    {
      if (ignore_case)
        return is_same_name(Text::lower_case(known),
                            Text::lower_case(plain),
                            false);
      return known == plain || without_spaces(known) == plain;
    }

    using cell_iterator = Triangulation<dim, spacedim>::cell_iterator;

    /**
     * The reference coordinates in the parent of a point of a child cell.
     * Lines of cells are halved, so that the corners of a child are corners
     * of the parent or mid-points of its lines, but for the centre of a
     * quadrilateral.
     */
    Point<dim>
    to_parent(const cell_iterator &parent,
              const cell_iterator &child,
              const unsigned int   number,
              const Point<dim>    &unit)
    {
      const ReferenceCell cell = parent->reference_cell();
      if (cell == ReferenceCells::Quadrilateral)
        return Point<dim>(0.5 * (number % 2 + unit[0]),
                          0.5 * (number / 2 + unit[1]));
      std::array<Point<dim>, 3> corners;
      for (const unsigned int v : child->vertex_indices())
        for (unsigned int k = 0; k < 3; ++k)
          {
            const auto line = parent->line(k);
            const auto end  = [&](const unsigned int e) {
              return cell.vertex<dim>(cell.face_to_cell_vertices(k, e, 1));
            };
            if (parent->vertex_index(k) == child->vertex_index(v))
              corners[v] = cell.vertex<dim>(k);
            // Both halves of a line share its middle.
            const auto first = line->child(0), second = line->child(1);
            for (const unsigned int e : {0, 1})
              if (first->vertex_index(e) == child->vertex_index(v) &&
                  (second->vertex_index(0) == child->vertex_index(v) ||
                   second->vertex_index(1) == child->vertex_index(v)))
                corners[v] = 0.5 * (end(0) + Tensor<1, dim>(end(1)));
          }
      return corners[0] + unit[0] * (corners[1] - corners[0]) +
             unit[1] * (corners[2] - corners[0]);
    }

    /** Local corners of the halves of a quadrilateral, by its diagonal. */
    constexpr unsigned int halves[2][2][3] = {{{0, 1, 3}, {0, 3, 2}},
                                              {{0, 1, 2}, {3, 2, 1}}};

    /** The point @p unit of a half in the quadrilateral. */
    Point<dim>
    to_quadrilateral(const unsigned int diagonal,
                     const unsigned int half,
                     const Point<dim>  &unit)
    {
      if (diagonal == 0)
        return half == 0 ? Point<dim>(unit[0] + unit[1], unit[1]) :
                           Point<dim>(unit[0], unit[0] + unit[1]);
      return half == 0 ? unit : Point<dim>(1. - unit[0], 1. - unit[1]);
    }

    /**
     * The diagonals along which quadrilaterals are cut, 0 from the first to the
     * last corner: those between vertices of one colour if two colours do for
     * the mesh, so that the diagonals of neighbours meet and no corner of a
     * rectangle lies in one triangle only.
     */
    std::vector<unsigned int>
    choose_diagonals(const std::vector<SurfaceDescription::Cell> &cells,
                     const unsigned int                           n_vertices)
    {
      const unsigned int        none = 2;
      std::vector<unsigned int> colours(n_vertices, none);
      // Spread the colours from cell to cell.
      for (bool spreads = true; spreads;)
        {
          spreads = false;
          for (const auto &cell : cells)
            {
              const auto  &v     = cell.vertices;
              unsigned int known = 4;
              for (unsigned int i = 0; i < 4; ++i)
                if (colours[v[i]] != none)
                  known = i;
              const bool starts = (known == 4 && &cell == &cells.front());
              if (known == 4 && !starts)
                continue;
              // Corners 0 and 3, and 1 and 2, lie opposite to each other.
              const auto parity = [](const unsigned int i) {
                return i == 1 || i == 2 ? 1U : 0U;
              };
              for (unsigned int i = 0; i < 4; ++i)
                if (colours[v[i]] == none)
                  {
                    const unsigned int base =
                      starts ? 0 : colours[v[known]] ^ parity(known);
                    colours[v[i]] = base ^ parity(i);
                    spreads       = true;
                  }
            }
        }
      std::vector<unsigned int> diagonals(cells.size(), 0);
      for (unsigned int k = 0; k < cells.size(); ++k)
        {
          const auto &v = cells[k].vertices;
          if (colours[v[0]] == colours[v[1]] || colours[v[0]] == colours[v[2]])
            return std::vector<unsigned int>(cells.size(), 0);
          diagonals[k] = (colours[v[0]] == 0 ? 0 : 1);
        }
      return diagonals;
    }
  } // namespace


  Midsurface::Midsurface(std::unique_ptr<const ParametricSurface> surface,
                         const std::string                       &name)
    : surface_(std::move(surface))
    , name_(name)
  {
    Assert(surface_ != nullptr, ExcInternalError());
    if (!surface_->has_triangles())
      diagonals_ =
        choose_diagonals(surface_->cells(), surface_->vertices().size());
    for (const SurfaceDescription::Edge &edge : surface_->edges())
      edge_names_.push_back(edge.name);
  }


  Midsurface::Midsurface(SurfaceDescription &&description,
                         const std::string   &name)
    : Midsurface(
        std::make_unique<const ParametricSurface>(std::move(description), name),
        name)
  {}


  Midsurface::Midsurface(Midsurface &&) noexcept = default;
  Midsurface &
  Midsurface::operator=(Midsurface &&) noexcept = default;
  Midsurface::~Midsurface()                     = default;


  std::unique_ptr<parallel::TriangulationBase<dim, spacedim>>
  Midsurface::create_triangulation(const MPI_Comm       communicator,
                                   const ReferenceCell &reference_cell,
                                   const unsigned int   n_refinements) const
  {
    const bool triangles = (reference_cell == ReferenceCells::Triangle);
    AssertThrow(triangles || !surface_->has_triangles(),
                ExcMessage("Mid-surface/" + name_ +
                           ": the mesh has triangles, and the element in "
                           "Discretization/Element needs quadrilaterals."));
    std::vector<CellData<dim>> cells;
    for (const SurfaceDescription::Cell &cell : surface_->cells())
      {
        const auto add = [&](const std::vector<unsigned int> &vertices) {
          cells.emplace_back(vertices.size());
          cells.back().vertices    = vertices;
          cells.back().material_id = cell.region;
        };
        const auto &v = cell.vertices;
        if (triangles && !surface_->has_triangles())
          for (const auto &half :
               halves[diagonals_[&cell - surface_->cells().data()]])
            add({v[half[0]], v[half[1]], v[half[2]]});
        else
          add(v);
      }
    SubCellData boundary;
    for (const ParametricSurface::BoundaryLine &line :
         surface_->boundary_lines())
      {
        CellData<1> data;
        data.vertices.assign(line.vertices.begin(), line.vertices.end());
        data.boundary_id = line.edge;
        boundary.boundary_lines.push_back(data);
      }

    // p4est takes no triangles.
    std::unique_ptr<parallel::TriangulationBase<dim, spacedim>> triangulation;
    using SharedMesh = parallel::shared::Triangulation<dim, spacedim>;
    if (triangles)
      triangulation =
        std::make_unique<SharedMesh>(communicator,
                                     Triangulation<dim, spacedim>::none,
                                     true,
                                     SharedMesh::partition_zorder);
    else
      triangulation =
        std::make_unique<parallel::distributed::Triangulation<dim, spacedim>>(
          communicator);
    triangulation->create_triangulation(surface_->vertices(), cells, boundary);
    triangulation->refine_global(n_refinements);

    // Without a manifold, refinement puts new vertices on chords. Only what
    // looks at the triangulation alone (a cell's diameter) notices.
    if (n_refinements > 0)
      for (const auto &cell : triangulation->active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          cell->vertex(v) =
            position(cell, reference_cell.template vertex<dim>(v));
    return triangulation;
  }


  Midsurface::CoarsePoint
  Midsurface::coarse_point(
    const Triangulation<dim, spacedim>::cell_iterator &cell,
    const Point<dim>                                  &unit) const
  {
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
        coarse_unit = to_parent(parent, ancestor, child, coarse_unit);
        ancestor    = parent;
      }
    const bool is_half = cell->reference_cell() == ReferenceCells::Triangle &&
                         !surface_->has_triangles();
    return {static_cast<unsigned int>(ancestor->index()), is_half, coarse_unit};
  }


  Point<spacedim>
  Midsurface::position(const Triangulation<dim, spacedim>::cell_iterator &cell,
                       const Point<dim> &unit) const
  {
    const auto            coarse = coarse_point(cell, unit);
    const Point<spacedim> x =
      perfect_position(coarse.cell, coarse.is_half, coarse.unit);
    if (imperfection_ == nullptr)
      return x;
    return x + (*imperfection_)(x,
                                perfect_normal(coarse.cell,
                                               coarse.is_half,
                                               coarse.unit));
  }


  bool
  Midsurface::has_chart() const
  {
    return surface_->has_parameter_lines();
  }


  Point<spacedim>
  Midsurface::chart(const Triangulation<dim, spacedim>::cell_iterator &cell,
                    const Point<dim> &unit) const
  {
    Assert(has_chart(), ExcInternalError());
    const auto coarse = coarse_point(cell, unit);
    if (coarse.is_half)
      return surface_->chart(coarse.cell / 2,
                             to_quadrilateral(diagonals_[coarse.cell / 2],
                                              coarse.cell % 2,
                                              coarse.unit));
    return surface_->chart(coarse.cell, coarse.unit);
  }


  std::array<double, 2>
  Midsurface::chart_periods() const
  {
    Assert(has_chart(), ExcInternalError());
    // A vertex of the seam has another chart in the cells of its two sides.
    std::array<double, 2>                   periods{{0., 0.}};
    std::map<unsigned int, Point<spacedim>> charts;
    for (const SurfaceDescription::Cell &cell : surface_->cells())
      for (unsigned int i = 0; i < cell.vertices.size(); ++i)
        {
          const Point<spacedim> &first =
            charts.emplace(cell.vertices[i], cell.chart[i]).first->second;
          for (unsigned int d = 0; d < 2; ++d)
            periods[d] =
              std::max(periods[d], std::abs(cell.chart[i][d] - first[d]));
        }
    return periods;
  }


  void
  Midsurface::set_imperfection(std::unique_ptr<const Imperfection> imperfection)
  {
    imperfection_ = std::move(imperfection);
  }


  Point<spacedim>
  Midsurface::perfect_position(const unsigned int cell,
                               const bool         is_half,
                               const Point<dim>  &unit) const
  {
    if (is_half)
      return surface_->position(cell / 2,
                                to_quadrilateral(diagonals_[cell / 2],
                                                 cell % 2,
                                                 unit));
    return surface_->position(cell, unit);
  }


  Tensor<1, spacedim>
  Midsurface::perfect_normal(const unsigned int cell,
                             const bool         is_half,
                             const Point<dim>  &unit) const
  {
    // Differences of the fourth order, into the cell: maps needn't go on
    // beyond their edges. Error and round-off are both about 1e-12.
    const double                         step = 1e-3;
    std::array<Tensor<1, spacedim>, dim> a;
    const double weights[5] = {-25. / 12., 4., -3., 4. / 3., -1. / 4.};
    const double middle = surface_->has_triangles() || is_half ? 1. / 3. : 0.5;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double sign = unit[d] <= middle ? 1. : -1.;
        for (unsigned int i = 0; i < 5; ++i)
          {
            Point<dim> place = unit;
            place[d] += sign * i * step;
            a[d] += sign * weights[i] *
                    Tensor<1, spacedim>(perfect_position(cell, is_half, place));
          }
      }
    const auto normal = cross_product_3d(a[0], a[1]);
    return normal / normal.norm();
  }


  const std::vector<std::string> &
  Midsurface::edge_names() const
  {
    return edge_names_;
  }


  const MeshRegions &
  Midsurface::regions() const
  {
    return surface_->regions();
  }


  bool
  Midsurface::has_triangles() const
  {
    return surface_->has_triangles();
  }


  bool
  Midsurface::has_name(const unsigned int edge, const std::string &name) const
  {
    const SurfaceDescription::Edge &entry = surface_->edges()[edge];
    const bool ignore_case                = surface_->edge_names().ignore_case;
    if (is_same_name(entry.name, name, ignore_case))
      return true;
    return std::any_of(entry.aliases.begin(),
                       entry.aliases.end(),
                       [&](const std::string &alias) {
                         return is_same_name(alias, name, ignore_case);
                       });
  }


  void
  Midsurface::use_edges(const std::vector<std::string> &names)
  {
    edges_in_use_.clear();
    for (const std::string &name : names)
      edges_in_use_.insert(plain_name(name));
  }


  bool
  Midsurface::is_left(const unsigned int edge) const
  {
    const EdgeNames &names = surface_->edge_names();
    return std::none_of(edges_in_use_.begin(),
                        edges_in_use_.end(),
                        [&](const std::string &used) {
                          return !is_same_name(names.rest,
                                               used,
                                               names.ignore_case) &&
                                 has_name(edge, used);
                        });
  }


  std::vector<std::string>
  Midsurface::known_edges() const
  {
    std::vector<std::string> known;
    const auto               add = [&](const std::string &name) {
      if (!name.empty() &&
          std::find(known.begin(), known.end(), Text::quoted(name)) ==
            known.end())
        known.push_back(Text::quoted(name));
    };
    for (const SurfaceDescription::Edge &edge : surface_->edges())
      {
        add(edge.name);
        for (const std::string &alias : edge.aliases)
          add(alias);
      }
    if (!surface_->edges().empty())
      add(surface_->edge_names().rest);
    return known;
  }


  std::string
  Midsurface::unknown_edge(const std::string &name,
                           const std::string &where) const
  {
    const EdgeNames               &names = surface_->edge_names();
    const std::vector<std::string> known = known_edges();
    if (known.empty())
      return where + ": unknown edge '" + name + "': the surface '" + name_ +
             "' is closed and has no edges.";
    std::string message = Text::unknown_name(where, "edge", name, known);
    std::vector<std::string> others;
    for (const auto &[other, why] : names.no_edges)
      if (is_same_name(other, name, names.ignore_case))
        return message + ' ' + why;
      else
        others.push_back(other);
    if (others.empty())
      return message;
    const auto near = Text::nearest(name, others, 1);
    if (!near.empty())
      message += ' ' + names.no_edges.at(near.front());
    for (std::string &other : others)
      other = Text::quoted(other);
    return message +
           " Sets of the file that are no edges: " + Text::list(others) + ".";
  }


  std::set<types::boundary_id>
  Midsurface::edge_ids(const std::string &name, const std::string &where) const
  {
    const EdgeNames  &names  = surface_->edge_names();
    const std::string wanted = plain_name(name);
    const bool        rest   = !names.rest.empty() &&
                      is_same_name(wanted, names.rest, names.ignore_case);
    std::set<types::boundary_id> ids;
    for (unsigned int e = 0; e < surface_->edges().size(); ++e)
      if (rest ? is_left(e) : has_name(e, wanted))
        ids.insert(e);
    AssertThrow(!rest || !ids.empty() || surface_->edges().empty(),
                ExcMessage(where + ": no side is left for the edge '" + wanted +
                           "'; other edges that are named hold the whole "
                           "boundary."));
    for (const auto &[other, why] : names.no_edges)
      AssertThrow(!is_same_name(other, wanted, names.ignore_case),
                  ExcMessage(unknown_edge(wanted, where)));
    AssertThrow(!ids.empty(), ExcMessage(unknown_edge(wanted, where)));
    return ids;
  }


  std::string
  Midsurface::describe_side(const types::boundary_id id) const
  {
    const SurfaceDescription::Edge &edge = surface_->edges().at(id);
    return edge.example.empty() ? "the edge '" + edge.name + "'" : edge.example;
  }


  std::vector<std::string>
  Midsurface::notes() const
  {
    const EdgeNames         &names  = surface_->edge_names();
    std::vector<std::string> result = surface_->notes();
    for (const auto &[name, note] : names.notes)
      for (const std::string &used : edges_in_use_)
        if (is_same_name(name, used, names.ignore_case))
          result.push_back(note);
    return result;
  }
} // namespace Nacre
