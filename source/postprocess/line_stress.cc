// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/cell_projection.h>
#include <nacre/postprocess/line_stress.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Nacre
{
  namespace
  {
    /** Points of a line, r = l t^2 with the points t of Gauss. */
    constexpr unsigned int n_line_points = 16;
    /** Pieces of an edge of the surface, which may be curved. */
    constexpr unsigned int n_edge_pieces = 8;
    /** A line may be so far off the surface, of its length. */
    constexpr double off_surface = 0.5;
    /** Of a point: three components by face, and from how many cells. */
    constexpr unsigned int n_sums = 3 * n_faces + 1;

    /**
     * Where the piece from @p a to @p b of an edge or a cut crosses a line
     * (length), seen in the tangent plane; behind its origin or beyond its end:
     * infinity.
     */
    double
    crossing(const SurfaceLine     &line,
             const Point<spacedim> &a,
             const Point<spacedim> &b)
    {
      const double never = std::numeric_limits<double>::infinity();
      const auto   side  = cross_product_3d(line.normal, line.direction);
      const double y_a   = (a - line.origin) * side;
      const double y_b   = (b - line.origin) * side;
      if (y_a == y_b || y_a * y_b > 0.)
        return never;
      const auto   place = (a - line.origin) + y_a / (y_a - y_b) * (b - a);
      const double x     = place * line.direction;
      // The other side of a tube doesn't count.
      const bool is_near = std::abs(place * line.normal) <= x;
      return is_near && x > 1e-6 * line.length && x <= line.length ? x : never;
    }

    /** Call @p use(a, b) with the pieces of this rank's edges of the surface.
     */
    template <typename Use>
    void
    for_each_edge_piece(const Discretization &discretization, const Use &use)
    {
      const auto &fe = discretization.scalar_fe();
      for (const CellPart &part : discretization.owned_parts())
        for (const unsigned int face : part.cell->face_indices())
          {
            if (!part.cell->at_boundary(face))
              continue;
            const auto        nodes = discretization.node_positions(part);
            const NodeSurface surface{fe, nodes};
            const auto        reference = part.cell->reference_cell();
            const auto        point     = [&](const unsigned int k) {
              const auto vertex = [&](const unsigned int i) {
                return reference.template vertex<dim>(
                  reference.face_to_cell_vertices(face, i, 1));
              };
              const double s = double(k) / n_edge_pieces;
              return surface.position(vertex(0) + s * (vertex(1) - vertex(0)));
            };
            for (unsigned int k = 0; k < n_edge_pieces; ++k)
              use(point(k), point(k + 1));
          }
    }

    /** The stresses at points of lines, from this rank's parts. */
    class LinePoints
    {
    public:
      LinePoints(const ShellState               &state,
                 const std::vector<SurfaceLine> &lines);

      /** Find the points on this rank's parts. */
      void
      find();

      /** Add the stresses of parts as near as @p nearest (length) to sums. */
      void
      add(const std::vector<double> &nearest, std::vector<double> &sums);

      /** Distances (length) of this rank's nearest parts. */
      std::vector<double> distances;

    private:
      struct Hit
      {
        unsigned int point;
        Point<dim>   unit;
        double       distance;
      };

      struct PartHits
      {
        const CellPart  *part;
        double           size;
        std::vector<Hit> hits;
      };

      /** Upper bounds of distances, from nodes of undivided cells. */
      std::vector<double>
      bounds() const;

      const ShellState                state_;
      const std::vector<SurfaceLine> &lines_;
      const QGauss<1>                 rule_;
      std::vector<Point<spacedim>>    points_;
      std::vector<PartHits>           hits_;
    };

    LinePoints::LinePoints(const ShellState               &state,
                           const std::vector<SurfaceLine> &lines)
      : state_(state)
      , lines_(lines)
      , rule_(n_line_points)
    {
      for (const SurfaceLine &line : lines)
        for (const auto &t : rule_.get_points())
          points_.push_back(line.origin +
                            line.length * t[0] * t[0] * line.direction);
      distances.assign(points_.size(), std::numeric_limits<double>::max());
    }

    std::vector<double>
    LinePoints::bounds() const
    {
      std::vector<double> result(points_.size(),
                                 std::numeric_limits<double>::max());
      for (const CellPart &part : state_.discretization.owned_parts())
        if (!part.is_cut())
          {
            const auto x = state_.discretization.geometry_nodes(part)[0];
            for (unsigned int p = 0; p < points_.size(); ++p)
              result[p] = std::min(result[p], x.distance(points_[p]));
          }
      return result;
    }

    void
    LinePoints::find()
    {
      const auto &mesh   = state_.discretization;
      const auto &fe     = mesh.scalar_fe();
      const auto  bounds = this->bounds();
      for (const CellPart &part : mesh.owned_parts())
        {
          const auto          nodes = mesh.node_positions(part);
          Tensor<1, spacedim> sum;
          for (const auto &x : nodes)
            sum += x;
          const Point<spacedim> centre(sum / double(nodes.size()));
          double                radius = 0.;
          for (const auto &x : nodes)
            radius = std::max(radius, x.distance(centre));
          const NodeSurface surface{fe, nodes};
          PartHits          of_part{&part, radius, {}};
          for (unsigned int p = 0; p < points_.size(); ++p)
            {
              const double nearest =
                std::min(bounds[p], distances[p] + 1e-3 * radius);
              if (points_[p].distance(centre) > 1.2 * radius + nearest)
                continue;
              const auto unit = project_to_cell(
                surface,
                mesh.element().reference_cell(),
                points_[p],
                mesh.element().reference_cell().template barycenter<dim>());
              if (part.is_cut() && !part.polygon().contains(unit, 1e-6))
                continue;
              const double distance =
                surface.position(unit).distance(points_[p]);
              distances[p] = std::min(distances[p], distance);
              of_part.hits.push_back({p, unit, distance});
            }
          if (!of_part.hits.empty())
            hits_.push_back(of_part);
        }
    }

    void
    LinePoints::add(const std::vector<double> &nearest,
                    std::vector<double>       &sums)
    {
      for (const PartHits &of_part : hits_)
        {
          std::vector<Hit>        hits;
          std::vector<Point<dim>> units;
          for (const Hit &hit : of_part.hits)
            if (hit.distance <= nearest[hit.point] + 1e-6 * of_part.size)
              {
                hits.push_back(hit);
                units.push_back(hit.unit);
              }
          if (hits.empty())
            continue;
          CellResults results(state_, Quadrature<dim>(units), false);
          results.reinit(*of_part.part);
          for (unsigned int q = 0; q < hits.size(); ++q)
            {
              const unsigned int p    = hits[q].point;
              const SurfaceLine &line = lines_[p / n_line_points];
              const PointResults r    = results.at(q);
              const auto         along =
                line.direction - (line.direction * r.normal) * r.normal;
              const auto m = cross_product_3d(r.normal, along) / along.norm();
              const auto c = along / along.norm();
              double    *s = &sums[p * n_sums];
              for (const auto &S : r.stress)
                {
                  *s++ += m * (S * m);
                  *s++ += m * (S * c);
                  *s++ += c * (S * c);
                }
              *s += 1.;
            }
        }
    }
  } // namespace

  void
  check_stress(const double stress)
  {
    AssertThrow(std::isfinite(stress),
                ExcMessage("Growth/Criterion: where 'strength' looks, a layer "
                           "is pressed to nothing and has no finite stress; "
                           "take finer cells."));
  }

  std::vector<LineEnd>
  find_line_ends(const Discretization             &discretization,
                 const std::vector<SurfaceLine>   &lines,
                 const std::optional<unsigned int> ignored)
  {
    if (lines.empty())
      return {};
    // Of edges, then of cuts.
    std::vector<double> nearest(2 * lines.size(),
                                std::numeric_limits<double>::infinity());
    const auto          take =
      [&](const unsigned int first, const auto &a, const auto &b) {
        for (unsigned int l = 0; l < lines.size(); ++l)
          nearest[first + l] =
            std::min(nearest[first + l], crossing(lines[l], a, b));
      };
    run_on_all_ranks(discretization.communicator(), [&]() {
      for_each_edge_piece(discretization,
                          [&](const auto &a, const auto &b) { take(0, a, b); });
      for (const auto &cut : discretization.cut_lines())
        if (!ignored || cut.cut != *ignored)
          for (unsigned int i = 0; i + 1 < cut.points.size(); ++i)
            take(lines.size(), cut.points[i], cut.points[i + 1]);
    });
    std::vector<double> of_all(nearest.size());
    Utilities::MPI::min(nearest, discretization.communicator(), of_all);
    std::vector<LineEnd> ends;
    for (unsigned int l = 0; l < lines.size(); ++l)
      {
        const double edge = of_all[l], cut = of_all[lines.size() + l];
        LineEnd      end{std::min({edge, cut, lines[l].length})};
        end.at_cut  = std::isfinite(cut) && cut <= edge;
        end.at_edge = std::isfinite(edge) && edge < cut;
        ends.push_back(end);
      }
    return ends;
  }

  std::vector<std::array<LineStress, n_faces>>
  mean_stresses(const ShellState &state, const std::vector<SurfaceLine> &lines)
  {
    if (lines.empty())
      return {};
    const MPI_Comm communicator = state.discretization.communicator();
    LinePoints     points(state, lines);
    run_on_all_ranks(communicator, [&]() { points.find(); });
    std::vector<double> nearest(points.distances.size());
    Utilities::MPI::min(points.distances, communicator, nearest);
    std::vector<double> mine(nearest.size() * n_sums, 0.);
    run_on_all_ranks(communicator, [&]() { points.add(nearest, mine); });
    std::vector<double> sums(mine.size());
    Utilities::MPI::sum(mine, communicator, sums);
    for (const double s : sums)
      check_stress(s);

    const QGauss<1>                              rule(n_line_points);
    std::vector<std::array<LineStress, n_faces>> means(lines.size());
    for (unsigned int l = 0; l < lines.size(); ++l)
      {
        // What share of the line is on the surface: dr/l = 2 t dt
        std::array<double, n_line_points> weights{};
        double                            share = 0.;
        for (unsigned int i = 0; i < n_line_points; ++i)
          {
            const unsigned int p = l * n_line_points + i;
            if (sums[p * n_sums + n_sums - 1] > 0. &&
                nearest[p] <= off_surface * lines[l].length)
              weights[i] = 2. * rule.point(i)[0] * rule.weight(i);
            share += weights[i];
          }
        for (unsigned int i = 0; i < n_line_points; ++i)
          {
            const double *s = &sums[(l * n_line_points + i) * n_sums];
            if (weights[i] == 0.)
              continue;
            const double part = weights[i] / (share * s[n_sums - 1]);
            for (LineStress &mean : means[l])
              {
                mean.across += part * *s++;
                mean.shear += part * *s++;
                mean.along += part * *s++;
              }
          }
      }
    return means;
  }
} // namespace Nacre
