// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/postprocess/point_results.h>
#include <nacre/postprocess/thick_fields.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    namespace Interpretation = DataComponentInterpretation;

    /** The points of a cell, and the linear cells that it is cut into. */
    struct FlatCells
    {
      std::vector<Point<dim>>                points;
      std::vector<std::vector<unsigned int>> corners;
    };

    FlatCells
    cut_quadrilateral(const unsigned int n)
    {
      FlatCells cells{QIterated<dim>(QTrapezoid<1>(), n).get_points(), {}};
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int v = j * (n + 1) + i;
            cells.corners.push_back({v, v + 1, v + n + 1, v + n + 2});
          }
      return cells;
    }

    FlatCells
    cut_triangle(const unsigned int n)
    {
      FlatCells                 cells;
      std::vector<unsigned int> first;
      for (unsigned int j = 0; j <= n; ++j)
        {
          first.push_back(cells.points.size());
          for (unsigned int i = 0; i + j <= n; ++i)
            cells.points.emplace_back(1. * i / n, 1. * j / n);
        }
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i + j < n; ++i)
          {
            const unsigned int v = first[j] + i, w = first[j + 1] + i;
            cells.corners.push_back({v, v + 1, w});
            if (i + j + 1 < n)
              cells.corners.push_back({v + 1, w + 1, w});
          }
      return cells;
    }

    /** A point of the body. */
    struct BodyPoint
    {
      Point<spacedim>     position;
      std::vector<double> data;
    };

    /**
     * The lower or upper @p face of the layer @p k at a point of the surface;
     * where there are fewer layers, the last one's.
     */
    BodyPoint
    body_point(const PointResults &r,
               const CellResults  &results,
               const unsigned int  q,
               const unsigned int  k,
               const unsigned int  face)
    {
      const auto &layer =
        r.layers[std::min<std::size_t>(k, r.layers.size() - 1)];
      const double bottom = r.layers.front().height[0];
      const double top    = r.layers.back().height[1];
      // A little inside, where it is certain which ply is meant.
      const double z      = layer.height[face];
      const double inside = z + 1e-6 * (layer.height[1 - face] - z);
      const double side = (2. * inside - bottom - top) / std::abs(top - bottom);
      const auto   stress = results.stress(q, side);

      BodyPoint p{r.point + z * r.normal, {}};
      for (unsigned int c = 0; c < spacedim; ++c)
        p.data.push_back(r.displacement[c] + z * r.normal_change[c]);
      for (unsigned int c = 0; c < 9; ++c)
        p.data.push_back(stress[c / 3][c % 3]);
      for (const auto &principal : r.principal(stress))
        p.data.push_back(principal.value);
      p.data.push_back(r.von_mises(stress));
      p.data.push_back(k + 1);
      for (const double result : results.state_results(q, side))
        p.data.push_back(result);
      return p;
    }
  } // namespace

  ThickFields::ThickFields(const ShellState  &state,
                           const unsigned int n_subdivisions)
    : state_results_(state.model.section->state_result_names())
  {
    const auto &discretization = state.discretization;
    const bool  triangles =
      discretization.element().type == ElementType::triangle;
    const unsigned int n =
      n_subdivisions == 0 ? discretization.degree() : n_subdivisions;
    const FlatCells flat = triangles ? cut_triangle(n) : cut_quadrilateral(n);
    const unsigned int n_components = get_dataset_names().size();
    const unsigned int n_layers = std::max(state.model.section->n_layers(), 1U);
    CellResults results(state, Quadrature<dim>(flat.points), false, true);
    for (const CellPart &part : discretization.owned_parts())
      {
        results.reinit(part);
        std::vector<PointResults> here;
        for (unsigned int q = 0; q < results.n_points(); ++q)
          here.push_back(results.with_layers(q));
        // Parts of divided cells have several lattices of points.
        std::vector<std::vector<unsigned int>> flat_cells;
        for (unsigned int first = 0; first < here.size();
             first += flat.points.size())
          for (auto corners : flat.corners)
            {
              for (unsigned int &q : corners)
                q += first;
              flat_cells.push_back(corners);
            }
        for (unsigned int k = 0; k < n_layers; ++k)
          for (const auto &corners : flat_cells)
            {
              Patch patch;
              patch.patch_index = patches_.size();
              patch.reference_cell =
                triangles ? ReferenceCells::Wedge : ReferenceCells::Hexahedron;
              patch.n_subdivisions = 1;
              patch.data.reinit(n_components, 2 * corners.size());
              unsigned int vertex = 0;
              // VTK's wedges begin with the triangle on the top.
              for (unsigned int f = 0; f < 2; ++f)
                for (const unsigned int q : corners)
                  {
                    const unsigned int face = triangles ? 1 - f : f;
                    const auto p = body_point(here[q], results, q, k, face);
                    patch.vertices[vertex] = p.position;
                    for (unsigned int c = 0; c < p.data.size(); ++c)
                      patch.data(c, vertex) = p.data[c];
                    ++vertex;
                  }
              patches_.push_back(std::move(patch));
            }
      }
    DataOutBase::VtkFlags flags;
    flags.print_date_and_time = false;
    this->set_flags(flags);
  }

  std::vector<std::string>
  ThickFields::get_dataset_names() const
  {
    std::vector<std::string> names(3, "displacement");
    names.insert(names.end(), 9, "stress");
    for (const auto *const name :
         {"principal_stress_1", "principal_stress_2", "von_mises", "layer"})
      names.emplace_back(name);
    for (const auto &name : state_results_)
      names.push_back(field_name(name));
    return names;
  }

  std::vector<ThickFields::NonscalarRange>
  ThickFields::get_nonscalar_data_ranges() const
  {
    return {{0, 2, "displacement", Interpretation::component_is_part_of_vector},
            {3, 11, "stress", Interpretation::component_is_part_of_tensor}};
  }
} // namespace Nacre
