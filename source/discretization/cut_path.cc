// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/cell_projection.h>
#include <nacre/discretization/cut_path.h>
#include <nacre/problem/midsurface.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <limits>
#include <map>
#include <memory>
#include <sstream>

namespace Nacre
{
  namespace
  {
    using MeshOfCuts = parallel::TriangulationBase<dim, spacedim>;

    /** The nearest point of the surface to a point of a cut. */
    struct CutFoot
    {
      double              distance = std::numeric_limits<double>::max();
      Point<spacedim>     position;
      Tensor<1, spacedim> normal;
      /** Sum of the sides of the cell's box (length). */
      double size = 0.;
      /** Whether it lies on the surface's boundary. */
      bool at_boundary = false;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &distance &position &normal &size &at_boundary;
      }
    };

    std::string
    describe(const CutCurve &curve, const std::size_t i)
    {
      std::ostringstream text;
      const auto        &x = curve.points[i];
      text << "the point " << i + 1 << ", (" << x[0] << ", " << x[1] << ", "
           << x[2] << ')';
      return text.str();
    }

    std::string
    describe(const CutCurve &curve)
    {
      return "Cuts/Cuts, '" + curve.name + "': ";
    }

    /** This rank's cells by boxes around them. */
    class CellBoxes
    {
    public:
      CellBoxes(const MeshOfCuts &mesh, const CellMaps &maps)
        : maps_(maps)
        , boundary_vertices_(GridTools::get_all_vertices_at_boundary(mesh))
      {
        const ReferenceCell &reference_cell = maps.reference_cell;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              std::vector<Point<spacedim>> points{
                maps.position(cell, reference_cell.template barycenter<dim>())};
              for (const unsigned int v : reference_cell.vertex_indices())
                points.push_back(
                  maps.position(cell, reference_cell.template vertex<dim>(v)));
              BoundingBox<spacedim> box(points);
              sizes_.push_back(box.side_length(0) + box.side_length(1) +
                               box.side_length(2));
              // A curved cell sticks out.
              box.extend(0.2 * sizes_.back());
              boxes_.emplace_back(box, cells_.size());
              cells_.push_back(cell);
            }
        tree_ = pack_rtree(boxes_);
      }

      CutFoot
      nearest(const Point<spacedim> &target) const
      {
        namespace bgi = boost::geometry::index;
        CutFoot best;
        for (auto it = tree_.qbegin(bgi::nearest(target, boxes_.size() + 1));
             it != tree_.qend() &&
             boost::geometry::distance(target, it->first) <= best.distance;
             ++it)
          {
            const CutFoot foot = on_cell(it->second, target);
            if (foot.distance < best.distance)
              best = foot;
          }
        return best;
      }

    private:
      CutFoot
      on_cell(const unsigned int number, const Point<spacedim> &target) const
      {
        const auto          &cell           = cells_[number];
        const ReferenceCell &reference_cell = maps_.reference_cell;
        const auto           map            = [&](const Point<dim> &unit) {
          return maps_.position(cell, unit);
        };
        const DifferentiatedMap<decltype(map)> surface{map};

        const Point<dim> unit =
          project_to_cell(surface,
                          reference_cell,
                          target,
                          reference_cell.template barycenter<dim>());
        const auto a = surface.tangents(unit);
        CutFoot    foot;
        foot.position = map(unit);
        foot.distance = foot.position.distance(target);
        foot.normal   = cross_product_3d(a[0], a[1]);
        foot.normal /= foot.normal.norm();
        foot.size        = sizes_[number];
        foot.at_boundary = is_at_boundary(cell, unit);
        return foot;
      }

      /** A cell may touch the boundary with a vertex only. */
      bool
      is_at_boundary(const CellMaps::Cell &cell, const Point<dim> &unit) const
      {
        const ReferenceCell &reference_cell = maps_.reference_cell;
        for (const unsigned int v : cell->vertex_indices())
          if (boundary_vertices_.count(cell->vertex_index(v)) == 1 &&
              unit.distance(reference_cell.template vertex<dim>(v)) < 1e-10)
            return true;
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f))
            {
              const auto corner = [&](const unsigned int v) {
                return reference_cell.template vertex<dim>(
                  reference_cell.face_to_cell_vertices(f, v, 1));
              };
              const Tensor<1, dim> face = corner(1) - corner(0);
              const Tensor<1, dim> to   = unit - corner(0);
              if (std::abs(face[0] * to[1] - face[1] * to[0]) < 1e-10)
                return true;
            }
        return false;
      }

      const CellMaps                               &maps_;
      const std::map<unsigned int, Point<spacedim>> boundary_vertices_;
      std::vector<CellMaps::Cell>                   cells_;
      std::vector<double>                           sizes_;
      std::vector<std::pair<BoundingBox<spacedim>, unsigned int>> boxes_;
      RTree<std::pair<BoundingBox<spacedim>, unsigned int>>       tree_;
    };

    /** The feet of all points of a curve, the same on all ranks. */
    std::vector<CutFoot>
    find_feet(const CellBoxes &boxes,
              const CutCurve  &curve,
              const MPI_Comm   communicator)
    {
      std::vector<CutFoot> feet;
      run_on_all_ranks(communicator, [&]() {
        for (const auto &point : curve.points)
          feet.push_back(boxes.nearest(point));
      });
      for (const auto &others : Utilities::MPI::all_gather(communicator, feet))
        for (std::size_t i = 0; i < feet.size(); ++i)
          if (others[i].distance < feet[i].distance)
            feet[i] = others[i];
      // Equal distances must not leave each rank with its own.
      return Utilities::MPI::broadcast(communicator, feet);
    }

    CutLeg
    make_leg(const Point<spacedim>     &begin,
             const Point<spacedim>     &end,
             const Tensor<1, spacedim> &up)
    {
      CutLeg leg;
      leg.begin  = begin;
      leg.length = begin.distance(end);
      leg.along  = (end - begin) / leg.length;
      leg.up     = up - (up * leg.along) * leg.along;
      leg.up /= leg.up.norm();
      leg.side = cross_product_3d(leg.up, leg.along);
      return leg;
    }

    /** Number of the legs of a curve of @p n points. */
    std::size_t
    n_legs(const CutCurve &curve)
    {
      return curve.points.size() - (curve.is_closed ? 0 : 1);
    }

    CutPath
    path_in_chart(const CutCurve &curve)
    {
      CutPath           path{true, curve.is_closed, curve.points, {}};
      const std::size_t n = curve.points.size();
      for (std::size_t i = 0; i < n_legs(curve); ++i)
        path.legs.push_back(make_leg(path.points[i],
                                     path.points[(i + 1) % n],
                                     Point<spacedim>(0., 0., 1.)));
      return path;
    }

    CutPath
    path_in_space(const CutCurve &curve, const std::vector<CutFoot> &feet)
    {
      CutPath           path{false, curve.is_closed, {}, {}};
      const std::size_t n = curve.points.size();
      for (std::size_t i = 0; i < n; ++i)
        {
          const auto  &x        = curve.points[i];
          const double off      = (x - feet[i].position) * feet[i].normal;
          const bool   beyond   = feet[i].at_boundary;
          const double distance = beyond ? std::abs(off) : feet[i].distance;
          std::ostringstream message;
          message << describe(curve) << describe(curve, i)
                  << ", lies off the surface by " << distance
                  << "; the nearest point of the surface is ("
                  << feet[i].position << ").";
          AssertThrow(distance <= 0.02 * feet[i].size,
                      ExcMessage(message.str()));
          path.points.push_back(beyond ? x - off * feet[i].normal :
                                         feet[i].position);
        }
      for (std::size_t i = 0; i < n_legs(curve); ++i)
        {
          const std::size_t next = (i + 1) % n;
          const auto        up   = feet[i].normal + feet[next].normal;
          const auto       &a = path.points[i], &b = path.points[next];
          AssertThrow(a.distance(b) > 1e-12 * feet[i].size,
                      ExcMessage(describe(curve) + describe(curve, i) +
                                 ", and the next one have the same nearest "
                                 "point of the surface; leave one out."));
          // A chord across a crease of 90 degrees is allowed.
          AssertThrow(feet[i].normal * feet[next].normal > -1e-3 &&
                        cross_product_3d(up, b - a).norm() >
                          0.1 * a.distance(b),
                      ExcMessage(describe(curve) +
                                 "the surface's normal turns by more than 90 "
                                 "degrees from " +
                                 describe(curve, i) +
                                 ", to the next; give points between."));
          path.legs.push_back(make_leg(a, b, up));
        }
      return path;
    }
  } // namespace


  CellMaps
  make_cell_maps(const Midsurface &surface, const ReferenceCell &reference_cell)
  {
    CellMaps maps{reference_cell,
                  [&surface](const CellMaps::Cell &cell, const Point<dim> &x) {
                    return surface.position(cell, x);
                  }};
    if (surface.has_chart())
      {
        maps.chart = [&surface](const CellMaps::Cell &cell,
                                const Point<dim>     &x) {
          return surface.chart(cell, x);
        };
        maps.periods = surface.chart_periods();
      }
    return maps;
  }


  std::vector<CutPath>
  make_cut_paths(const parallel::TriangulationBase<dim, spacedim> &mesh,
                 const CellMaps                                   &maps,
                 const Cuts                                       &cuts)
  {
    std::unique_ptr<CellBoxes> boxes;
    std::vector<CutPath>       paths;
    for (const CutCurve &curve : cuts.curves)
      if (curve.coordinates == CutCurve::Coordinates::chart)
        {
          AssertThrow(maps.chart,
                      ExcMessage(describe(curve) +
                                 "this surface isn't described over a "
                                 "rectangle of (u, v); give the points in "
                                 "space, 'xyz (x, y, z) ...'."));
          paths.push_back(path_in_chart(curve));
        }
      else
        {
          if (boxes == nullptr)
            run_on_all_ranks(mesh.get_communicator(), [&]() {
              boxes = std::make_unique<CellBoxes>(mesh, maps);
            });
          paths.push_back(
            path_in_space(curve,
                          find_feet(*boxes, curve, mesh.get_communicator())));
        }
    return paths;
  }
} // namespace Nacre
