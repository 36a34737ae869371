// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cell_part.h>
#include <nacre/discretization/part_enrichment.h>
#include <nacre/discretization/part_quadrature.h>
#include <nacre/discretization/plane_geometry.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /**
     * The functions N_a psi_i e_i, N_a (1 - psi_i) e_i of open nodes, or those
     * of one scalar psi.
     */
    void
    append_jumps(const PartEnrichment::Share         &share,
                 const std::vector<FieldDerivatives> &fields,
                 const ShapeTable                    &shapes,
                 const unsigned int                   q,
                 std::vector<FieldDerivatives>       &result)
    {
      for (const auto &[a, opens_left] : share.open_nodes)
        for (unsigned int i = 0; i < fields.size(); ++i)
          {
            FieldDerivatives f;
            if (!opens_left)
              f.value = share.functions->direction(i);
            f.add(opens_left ? 1. : -1., fields[i]);
            const double     N   = shapes.value(q, a);
            const auto      &dN  = shapes.gradient(q, a);
            const auto      &d2N = shapes.hessian(q, a);
            FieldDerivatives psi;
            psi.value = N * f.value;
            for (unsigned int k = 0; k < 2; ++k)
              {
                psi.first[k] = N * f.first[k] + dN[k] * f.value;
                psi.second[k] =
                  N * f.second[k] + 2. * dN[k] * f.first[k] + d2N[k] * f.value;
              }
            psi.second[2] = N * f.second[2] + dN[0] * f.first[1] +
                            dN[1] * f.first[0] + d2N[2] * f.value;
            result.push_back(psi);
          }
    }
  } // namespace

  void
  PartEnrichment::evaluate(const ShapeTable              &shapes,
                           const GeometryTable::Values   &geometry,
                           const unsigned int             q,
                           const Point<dim>              &unit,
                           std::vector<FieldDerivatives> &result,
                           const Tensor<1, dim>          &lip) const
  {
    const FieldDerivatives        surface{geometry.position(q),
                                   {{geometry.tangent(q, 0),
                                            geometry.tangent(q, 1)}},
                                   geometry.second_derivatives(q)};
    std::vector<FieldDerivatives> fields;
    for (const Share &share : shares)
      {
        const double back = share.holds_tip ? lip * share.backward : 0.;
        const int    side = back < 0. ? 1 : back > 0. ? -1 : share.side;
        share.functions->evaluate(surface, side, fields);
        if (!share.open_nodes.empty())
          {
            append_jumps(share, fields, shapes, q, result);
            continue;
          }
        const auto                 &c   = share.cutoff;
        const double                chi = PartEnrichment::chi(c, unit);
        const std::array<double, 2> dchi{
          {c[1] + c[3] * unit[1], c[2] + c[3] * unit[0]}};
        for (unsigned int k = 0; k < fields.size(); ++k)
          {
            FieldDerivatives &g = fields[k];
            for (unsigned int a = 0; a < shapes.n_nodes(); ++a)
              {
                const auto &F = share.at_nodes[a][k];
                g.value -= shapes.value(q, a) * F;
                for (unsigned int i = 0; i < 2; ++i)
                  g.first[i] -= shapes.gradient(q, a)[i] * F;
                for (unsigned int v = 0; v < 3; ++v)
                  g.second[v] -= shapes.hessian(q, a)[v] * F;
              }
            FieldDerivatives psi;
            psi.value = chi * g.value;
            for (unsigned int i = 0; i < 2; ++i)
              {
                psi.first[i]  = chi * g.first[i] + dchi[i] * g.value;
                psi.second[i] = chi * g.second[i] + 2. * dchi[i] * g.first[i];
              }
            psi.second[2] = chi * g.second[2] + dchi[0] * g.first[1] +
                            dchi[1] * g.first[0] + c[3] * g.value;
            result.push_back(psi);
          }
      }
  }

  namespace
  {
    /**
     * The triangle from @p apex to the side from @p begin to @p end; x = apex +
     * r^2 (side(s) - apex).
     */
    void
    append_fan(const Point<dim>        &apex,
               const Point<dim>        &begin,
               const Point<dim>        &end,
               const Quadrature<dim>   &rule,
               std::vector<Point<dim>> &points,
               std::vector<double>     &weights)
    {
      const double area = PlaneGeometry::twice_area(apex, begin, end);
      if (area < PlaneGeometry::round_off)
        return;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double r = rule.point(q)[0], s = rule.point(q)[1];
          const auto   on_side = begin + s * (end - begin);
          points.push_back(apex + r * r * (on_side - apex));
          weights.push_back(rule.weight(q) * area * 2. * r * r * r);
        }
    }

    /** Coordinate of @p x along the side from begin to end. */
    double
    coordinate_on(const Point<dim> &begin,
                  const Point<dim> &end,
                  const Point<dim> &x)
    {
      const auto along = end - begin;
      return (x - begin) * along / along.norm_square();
    }

  } // namespace

  Point<dim>
  crack_entry(const PartEnrichment::Share &share, const CellPolygon &outline)
  {
    Point<dim> entry;
    double     nearest = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < outline.n_vertices(); ++i)
      {
        const auto  &begin = outline.vertex(i);
        const auto  &end   = outline.vertex((i + 1) % outline.n_vertices());
        const double s =
          PlaneGeometry::ray_on_line(share.tip, share.backward, begin, end);
        if (s < -PlaneGeometry::snap_distance ||
            s > 1. + PlaneGeometry::snap_distance)
          continue;
        const Point<dim> x = begin + s * (end - begin);
        if (x.distance(share.tip) < nearest)
          {
            nearest = x.distance(share.tip);
            entry   = x;
          }
      }
    Assert(nearest < std::numeric_limits<double>::max(), ExcInternalError());
    return entry;
  }

  namespace
  {
    /** Of a convex polygon, vertices counterclockwise. */
    void
    append_near_tip(const std::vector<Point<dim>> &vertices,
                    const PartEnrichment::Share   &share,
                    const Quadrature<dim>         &rule,
                    std::vector<Point<dim>>       &points,
                    std::vector<double>           &weights)
    {
      const unsigned int n       = vertices.size();
      Point<dim>         apex    = share.tip;
      double             nearest = std::numeric_limits<double>::max();
      bool               inside  = true;
      for (unsigned int i = 0; i < n; ++i)
        inside &= PlaneGeometry::twice_area(vertices[i],
                                            vertices[(i + 1) % n],
                                            share.tip) >= 0.;
      for (unsigned int i = 0; i < n && !inside; ++i)
        {
          const auto x =
            PlaneGeometry::nearest_on_segment(vertices[i],
                                              vertices[(i + 1) % n],
                                              share.tip);
          if (x.distance(share.tip) < nearest)
            {
              nearest = x.distance(share.tip);
              apex    = x;
            }
        }
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto         &begin = vertices[i], &end = vertices[(i + 1) % n];
          std::vector<double> breaks{coordinate_on(begin, end, apex)};
          if (share.holds_tip)
            breaks.push_back(PlaneGeometry::ray_on_line(share.tip,
                                                        share.backward,
                                                        begin,
                                                        end));
          std::sort(breaks.begin(), breaks.end());
          double last = 0.;
          breaks.push_back(1.);
          for (const double s : breaks)
            if (s > last + PlaneGeometry::snap_distance &&
                (s == 1. || s < 1. - PlaneGeometry::snap_distance))
              {
                append_fan(apex,
                           begin + last * (end - begin),
                           begin + s * (end - begin),
                           rule,
                           points,
                           weights);
                last = s;
              }
        }
    }

    std::vector<std::vector<Point<dim>>>
    convex_pieces(const CellPart &part)
    {
      std::vector<std::vector<Point<dim>>> pieces;
      if (part.is_cut())
        for (const auto &triangle : part.polygon().triangles())
          pieces.emplace_back(triangle.begin(), triangle.end());
      else
        {
          const auto whole = CellPolygon::whole(part.cell->reference_cell());
          pieces.emplace_back();
          for (unsigned int i = 0; i < whole.n_vertices(); ++i)
            pieces.back().push_back(whole.vertex(i));
        }
      return pieces;
    }
  } // namespace

  Quadrature<dim>
  enriched_quadrature(const CellPart &part, const unsigned int degree)
  {
    const auto &shares = part.data->enrichment->shares;
    // Of two tips, the parts of one lie far from the other.
    const auto share = std::find_if(shares.begin(),
                                    shares.end(),
                                    [](const auto &s) { return s.is_near; });
    if (share == shares.end())
      return part_quadrature(part.outline(), degree + 3);
    // Harmonic functions have terms up to r^12.5, biharmonic ones up to r^11.
    const QGauss<dim>       rule(share->open_nodes.empty() ? 2 * degree + 4 :
                                                       2 * degree + 12);
    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    for (const auto &piece : convex_pieces(part))
      append_near_tip(piece, *share, rule, points, weights);
    return Quadrature<dim>(points, weights);
  }

  Quadrature<1>
  enriched_edge_quadrature(const PartEnrichment &enrichment,
                           const Point<dim>     &begin,
                           const Point<dim>     &end,
                           const unsigned int    degree)
  {
    std::vector<double> breaks{0., 1.};
    for (const auto &share : enrichment.shares)
      {
        const auto nearest =
          PlaneGeometry::nearest_on_segment(begin, end, share.tip);
        if (nearest.distance(share.tip) > begin.distance(end))
          continue;
        const double s = coordinate_on(begin, end, nearest);
        for (const double distance : {0., .005, .015, .05, .15, .4})
          for (const double x : {s - distance, s + distance})
            if (x > 1e-4 && x < 1. - 1e-4)
              breaks.push_back(x);
      }
    std::sort(breaks.begin(), breaks.end());
    const bool            is_near = breaks.size() > 2;
    const QGauss<1>       rule(is_near ? degree + 3 : 2 * degree + 4);
    std::vector<Point<1>> points;
    std::vector<double>   weights;
    for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
      {
        const double length = breaks[i + 1] - breaks[i];
        for (unsigned int q = 0; q < rule.size() && length > 0.; ++q)
          {
            points.emplace_back(breaks[i] + length * rule.point(q)[0]);
            weights.push_back(length * rule.weight(q));
          }
      }
    return Quadrature<1>(points, weights);
  }
} // namespace Nacre
