// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/discretization/cell_projection.h>
#include <nacre/discretization/cut_growth.h>
#include <nacre/problem/midsurface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Nacre
{
  namespace
  {
    /** A tip doesn't stop so near before an edge or a cut: of its advance. */
    constexpr double narrow_ligament = 0.25;
    /** Along a crack with two tips. */
    constexpr unsigned int least_cells = 4;

    /** The mid-surface of a part, as its nodes give it. */
    struct GrownSurface
    {
      const Discretization &mesh;
      const CellPart       &part;

      Point<spacedim>
      operator()(const Point<dim> &unit) const
      {
        const auto      nodes = mesh.geometry_nodes(part);
        Point<spacedim> x;
        for (unsigned int b = 0; b < nodes.size(); ++b)
          x += mesh.geometry_fe().shape_value(b, unit) * nodes[b];
        return x;
      }

      std::array<Tensor<1, spacedim>, dim>
      tangents(const Point<dim> &unit) const
      {
        return DifferentiatedMap<GrownSurface>{*this}.tangents(unit);
      }
    };

    Tensor<1, spacedim>
    unit_normal(const std::array<Tensor<1, spacedim>, dim> &a)
    {
      const auto normal = cross_product_3d(a[0], a[1]);
      return normal / normal.norm();
    }

    /** Coefficients c of the part of @p v along the tangents, c_1 a_1 + .. */
    Tensor<1, dim>
    coefficients(const std::array<Tensor<1, spacedim>, dim> &a,
                 const Tensor<1, spacedim>                  &v)
    {
      const double a_11 = a[0] * a[0], a_22 = a[1] * a[1], a_12 = a[0] * a[1];
      const double b_1 = a[0] * v, b_2 = a[1] * v;
      const double det = a_11 * a_22 - a_12 * a_12;
      return Tensor<1, dim>(
        {(a_22 * b_1 - a_12 * b_2) / det, (a_11 * b_2 - a_12 * b_1) / det});
    }

    /** The rank's cell of @p tip, or nothing. */
    std::optional<CellPart>
    cell_of(const Discretization &discretization, const CutTrace::Tip &tip)
    {
      for (const CellPart &part : discretization.owned_parts())
        if (part.cell->id() == tip.cell)
          return CellPart(part.cell);
      return {};
    }

    /**
     * How far from the tip, straight along e_1 of @p axes, another cut or an
     * earlier part of the same one lies, and which: within @p reach. Cuts are
     * seen in the tangent plane. Collective.
     */
    std::pair<double, unsigned int>
    find_cut_ahead(const Discretization                     &discretization,
                   const Point<spacedim>                    &tip,
                   const std::array<Tensor<1, spacedim>, 3> &axes,
                   const double                              reach)
    {
      std::pair<double, unsigned int> nearest(
        std::numeric_limits<double>::max(),
        0);
      for (const auto &line : discretization.cut_lines())
        for (unsigned int i = 0; i + 1 < line.points.size(); ++i)
          {
            const auto a = line.points[i] - tip, b = line.points[i + 1] - tip;
            if (std::min(a.norm(), b.norm()) > 2. * reach)
              continue;
            const double y_a = a * axes[1], y_b = b * axes[1];
            if (y_a == y_b || y_a * y_b > 0.)
              continue;
            const double s = y_a / (y_a - y_b);
            const double x = (1. - s) * (a * axes[0]) + s * (b * axes[0]);
            // The cut itself ends at x = 0.
            if (x > 0.05 * reach && x <= reach)
              nearest = std::min(nearest, {x, line.cut});
          }
      for (const auto &of_rank :
           Utilities::MPI::all_gather(discretization.communicator(), nearest))
        nearest = std::min(nearest, of_rank);
      return nearest;
    }

    /** A place in the tangent plane of a tip, as the surface sees it. */
    struct Target
    {
      bool is_outside = false;
      /** In the coordinates of the curve. */
      Point<spacedim> point;
    };

    /**
     * @param target near the surface (length)
     * @param ahead by which a point outside is moved further (length)
     */
    Target
    find_target(const Discretization      &discretization,
                const Midsurface          &midsurface,
                const CutCurve            &curve,
                const Point<spacedim>     &target,
                const Tensor<1, spacedim> &ahead)
    {
      const MPI_Comm     communicator = discretization.communicator();
      const SurfacePoint foot         = discretization.nearest(target);
      double             outside      = 0.;
      Point<spacedim>    point;
      run_on_all_ranks(communicator, [&]() {
        if (!foot.is_mine)
          return;
        const GrownSurface surface{discretization, CellPart(foot.part.cell)};
        const auto         a      = surface.tangents(foot.unit);
        const auto         normal = unit_normal(a);
        // What is perpendicular to the surface is its curvature.
        Tensor<1, spacedim> beyond = target - foot.position;
        beyond -= (beyond * normal) * normal;
        if (beyond.norm() > 1e-3 * ahead.norm())
          outside = 1.;
        const bool in_space = curve.coordinates == CutCurve::Coordinates::space;
        const auto chart    = [&](const Point<dim> &unit) {
          return midsurface.chart(foot.part.cell, unit);
        };
        point = in_space ? foot.position : chart(foot.unit);
        if (outside == 0.)
          return;
        beyond += ahead - (ahead * normal) * normal;
        const auto c = coefficients(a, beyond);
        const auto t =
          in_space ?
            a :
            DifferentiatedMap<decltype(chart)>{chart}.tangents(foot.unit);
        point += c[0] * t[0] + c[1] * t[1];
      });
      return {Utilities::MPI::sum(outside, communicator) > 0.,
              Point<spacedim>(
                Utilities::MPI::sum(Tensor<1, spacedim>(point), communicator))};
    }

    /** Of a closed chart, the image nearest to the point @p to. */
    Point<spacedim>
    unwrapped(Point<spacedim>              x,
              const Point<spacedim>       &to,
              const std::array<double, 2> &periods)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (periods[c] > 0.)
          x[c] += periods[c] * std::round((to[c] - x[c]) / periods[c]);
      return x;
    }
  } // namespace

  std::array<Tensor<1, spacedim>, 3>
  tip_axes(const Discretization &discretization, const CutTrace::Tip &tip)
  {
    const MPI_Comm      communicator = discretization.communicator();
    Tensor<1, spacedim> normal;
    run_on_all_ranks(communicator, [&]() {
      if (const auto cell = cell_of(discretization, tip))
        normal =
          unit_normal(GrownSurface{discretization, *cell}.tangents(tip.unit));
    });
    normal = Utilities::MPI::sum(normal, communicator);
    return {{tip.direction, cross_product_3d(normal, tip.direction), normal}};
  }

  double
  cell_size_at(const Discretization &discretization, const CutTrace::Tip &tip)
  {
    double size = 0.;
    if (const auto part = cell_of(discretization, tip))
      size = discretization.longest_edge(part->cell);
    return Utilities::MPI::max(size, discretization.communicator());
  }

  std::vector<CoarseCrack>
  coarse_cracks(const Discretization &discretization)
  {
    std::map<unsigned int, unsigned int> n_tips;
    for (const auto &tip : discretization.tips())
      ++n_tips[tip.cut];
    std::vector<CoarseCrack> cracks;
    for (const auto &[cut, n] : n_tips)
      {
        if (n < 2)
          continue;
        unsigned int n_lines = 0;
        for (const auto &line : discretization.cut_lines())
          n_lines += (line.cut == cut);
        const unsigned int n_cells =
          Utilities::MPI::sum(n_lines, discretization.communicator());
        if (n_cells < least_cells)
          cracks.push_back({cut, n_cells});
      }
    return cracks;
  }

  std::string
  in_words(const CoarseCrack &crack, const Cuts &cuts)
  {
    return "the crack '" + cuts.curves[crack.cut].name + "' runs through " +
           std::to_string(crack.n_cells) +
           (crack.n_cells == 1 ? " cell" : " cells") +
           ", too few for what happens at its tips; take a mesh that has " +
           std::to_string(least_cells) + " at least along it";
  }

  TipAdvance
  advance_tip(const Discretization &discretization,
              const Midsurface     &midsurface,
              const CutTrace::Tip  &tip,
              const double          angle,
              const double          length,
              Cuts                 &cuts)
  {
    auto       axes    = tip_axes(discretization, tip);
    const auto ahead   = std::cos(angle) * axes[0] + std::sin(angle) * axes[1];
    axes               = {{ahead, cross_product_3d(axes[2], ahead), axes[2]}};
    CutCurve    &curve = cuts.curves[tip.cut];
    const double reach = (1. + narrow_ligament) * length;
    const auto [distance, cut] =
      find_cut_ahead(discretization, tip.position, axes, reach);
    TipAdvance advance;
    const auto target_at = [&](const double x) {
      return find_target(discretization,
                         midsurface,
                         curve,
                         tip.position + x * ahead,
                         narrow_ligament * length * ahead);
    };
    Target target;
    if (distance <= reach)
      {
        // A little beyond, so that nothing is left between.
        target      = target_at(distance + 0.02 * length);
        advance.met = cut;
      }
    else
      {
        target = target_at(reach);
        if (!target.is_outside)
          target = target_at(length);
        advance.leaves = target.is_outside;
      }
    const bool in_chart = curve.coordinates == CutCurve::Coordinates::chart;
    auto      &points   = curve.points;
    const auto place    = tip.at_end ? points.end() : points.begin();
    const auto from     = tip.at_end ? points.back() : points.front();
    points.insert(place,
                  in_chart ?
                    unwrapped(target.point, from, midsurface.chart_periods()) :
                    target.point);
    return advance;
  }
} // namespace Nacre
