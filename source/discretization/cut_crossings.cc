// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cell_projection.h>
#include <nacre/discretization/cut_crossings.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace Nacre
{
  namespace
  {
    // Round-off is far below, what a user means is far above.
    /** A vertex so near to a leg's plane lies on it (of the edge). */
    constexpr double on_plane = 1e-9;
    /** A point so near to an edge lies on it (of the edge). */
    constexpr double on_edge = 1e-8;
    /** Marks so near to each other are one (of the edge, of the leg). */
    constexpr double one_mark = 1e-7;

    /** Round to a multiple of 2^-50, so that 1 - s is exact. */
    double
    quantised(const double s)
    {
      return std::ldexp(std::round(std::ldexp(s, 50)), -50);
    }

    /** What round-off makes of a point's coordinates. */
    double
    round_off(const Point<spacedim> &x)
    {
      return 1e-14 * Tensor<1, spacedim>(x).norm();
    }
  } // namespace


  struct CutCrossings::EdgeCurve
  {
    static constexpr unsigned int n_samples = 5;

    EdgeCurve(const CellMaps    &maps,
              const Cell        &cell,
              const unsigned int face,
              const bool         in_chart)
      : map(in_chart ? maps.chart : maps.position)
      , cell(cell)
      , in_chart(in_chart)
    {
      for (unsigned int i = 0; i < 2; ++i)
        ends[i] = maps.reference_cell.template vertex<dim>(
          maps.reference_cell.face_to_cell_vertices(face, i, 1));
      for (unsigned int i = 0; i < n_samples; ++i)
        samples[i] = at(parameter(i));
      for (unsigned int i = 0; i + 1 < n_samples; ++i)
        length += samples[i].distance(samples[i + 1]);
    }

    static double
    parameter(const unsigned int i)
    {
      return static_cast<double>(i) / (n_samples - 1);
    }

    Point<dim>
    unit(const double t) const
    {
      return Point<dim>((1. - t) * ends[0] + t * ends[1]);
    }

    Point<spacedim>
    at(const double t) const
    {
      return map(cell, unit(t));
    }

    BoundingBox<spacedim>
    box() const
    {
      BoundingBox<spacedim> result(
        std::vector<Point<spacedim>>(samples.begin(), samples.end()));
      result.extend(0.1 * length);
      return result;
    }

    /** The surface's normal, of any length. */
    Tensor<1, spacedim>
    normal(const double t) const
    {
      const auto position = [&](const Point<dim> &unit) {
        return map(cell, unit);
      };
      const auto a =
        DifferentiatedMap<decltype(position)>{position}.tangents(unit(t));
      return cross_product_3d(a[0], a[1]);
    }

    const CellMaps::Map                   &map;
    const Cell                            &cell;
    const bool                             in_chart;
    std::array<Point<dim>, 2>              ends;
    std::array<Point<spacedim>, n_samples> samples;
    double                                 length = 0.;
  };


  CutCrossings::CutCrossings(const CellMaps             &maps,
                             const std::vector<CutPath> &paths,
                             const double                snap)
    : maps_(maps)
    , paths_(paths)
    , snap_(std::max(snap, one_mark))
  {
    std::array<std::vector<std::pair<Box, LegOfPath>>, 2> boxes;
    for (unsigned int p = 0; p < paths.size(); ++p)
      for (unsigned int l = 0; l < paths[p].legs.size(); ++l)
        {
          const CutLeg &leg = paths[p].legs[l];
          const auto    end = leg.begin + leg.length * leg.along;
          Box           box(std::make_pair(leg.begin, leg.begin));
          box.merge_with(Box(std::make_pair(end, end)));
          // In space the leg bends away from its chord.
          box.extend(paths[p].is_in_chart ?
                       1e-9 * leg.length + round_off(leg.begin) :
                       0.5 * leg.length);
          boxes[paths[p].is_in_chart].emplace_back(box, LegOfPath(p, l));
        }
    for (unsigned int i = 0; i < 2; ++i)
      legs_[i] = pack_rtree(boxes[i]);
  }


  Tensor<1, spacedim>
  CutCrossings::shift(const CutImage &image) const
  {
    Tensor<1, spacedim> result;
    for (unsigned int d = 0; d < 2; ++d)
      result[d] = image.periods[d] * maps_.periods[d];
    return result;
  }


  std::vector<CutCrossings::NearLeg>
  CutCrossings::near_legs(const Box &box, const bool in_chart) const
  {
    namespace bgi = boost::geometry::index;
    std::vector<NearLeg> result;
    const auto          &tree = legs_[in_chart];
    if (tree.empty())
      return result;
    // The images that can reach the box
    const auto         bounds = tree.bounds();
    std::array<int, 2> first{{0, 0}}, last{{0, 0}};
    for (unsigned int d = 0; d < 2; ++d)
      if (in_chart && maps_.periods[d] > 0.)
        {
          const auto  &low  = bounds.min_corner();
          const auto  &high = bounds.max_corner();
          const double down = d == 0 ? boost::geometry::get<0>(high) :
                                       boost::geometry::get<1>(high);
          const double up   = d == 0 ? boost::geometry::get<0>(low) :
                                       boost::geometry::get<1>(low);
          first[d] = std::ceil((box.lower_bound(d) - down) / maps_.periods[d]);
          last[d]  = std::floor((box.upper_bound(d) - up) / maps_.periods[d]);
        }
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        {
          const CutImage image{0, {{i, j}}};
          const auto     moved = shift(image);
          const auto    &ends  = box.get_boundary_points();
          const Box here(std::make_pair(Point<spacedim>(ends.first - moved),
                                        Point<spacedim>(ends.second - moved)));
          for (auto it = tree.qbegin(bgi::intersects(here)); it != tree.qend();
               ++it)
            result.push_back(
              {{it->second.first, image.periods}, it->second.second});
        }
    std::sort(result.begin(),
              result.end(),
              [](const NearLeg &a, const NearLeg &b) {
                return std::make_pair(a.image, a.leg) <
                       std::make_pair(b.image, b.leg);
              });
    return result;
  }


  bool
  CutCrossings::may_cross(const Cell &cell) const
  {
    for (const bool in_chart : {false, true})
      {
        if (legs_[in_chart].empty())
          continue;
        const auto &map = in_chart ? maps_.chart : maps_.position;
        std::vector<Point<spacedim>> corners;
        for (const unsigned int v : maps_.reference_cell.vertex_indices())
          corners.push_back(
            map(cell, maps_.reference_cell.template vertex<dim>(v)));
        Box box(corners);
        // A curved cell sticks out.
        box.extend(
          0.3 * (box.side_length(0) + box.side_length(1) + box.side_length(2)));
        if (!near_legs(box, in_chart).empty())
          return true;
      }
    return false;
  }


  void
  CutCrossings::add_crossings(const EdgeCurve      &edge,
                              const NearLeg        &near,
                              std::vector<CutMark> &marks) const
  {
    const CutLeg             &leg    = paths_[near.image.path].legs[near.leg];
    const Tensor<1, spacedim> moved  = shift(near.image);
    const auto                offset = [&](const double t) {
      return leg.offset(edge.at(t) - moved);
    };
    const auto add = [&](const double t) {
      const Point<spacedim> x     = edge.at(t) - moved;
      const double          part  = leg.part(x);
      const double          slack = 2. * on_edge * edge.length / leg.length;
      if (part < -slack || part > 1. + slack || !leg.is_near(x))
        return;
      if (!edge.in_chart && edge.normal(t) * leg.up <= 0.)
        return;
      marks.push_back({near.image,
                       near.leg + std::min(1., std::max(0., part)),
                       quantised(t),
                       {}});
    };

    constexpr unsigned int n = EdgeCurve::n_samples;
    std::array<double, n>  values;
    bool                   runs_along = true;
    const auto             is_on      = [&](const unsigned int i) {
      return std::abs(values[i]) <=
             on_plane * edge.length + round_off(edge.samples[i]);
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        values[i]  = leg.offset(edge.samples[i] - moved);
        runs_along = runs_along && is_on(i);
      }
    for (const unsigned int i : {0u, n - 1})
      if (is_on(i))
        add(EdgeCurve::parameter(i));
    if (runs_along)
      return;
    for (unsigned int i = 0; i + 1 < n; ++i)
      {
        const double a = EdgeCurve::parameter(i);
        if (i > 0 && values[i] == 0.)
          add(a);
        if (values[i] * values[i + 1] >= 0.)
          continue;
        boost::uintmax_t n_iterations = 100;
        const auto [low, high]        = boost::math::tools::toms748_solve(
          offset,
          a,
          EdgeCurve::parameter(i + 1),
          values[i],
          values[i + 1],
          boost::math::tools::eps_tolerance<double>(51),
          n_iterations);
        add(0.5 * (low + high));
      }
  }


  void
  CutCrossings::add_point(const EdgeCurve      &edge,
                          const CutImage       &image,
                          const unsigned int    index,
                          std::vector<CutMark> &marks) const
  {
    const Point<spacedim> target =
      paths_[image.path].points[index] + shift(image);
    unsigned int nearest = 0;
    for (unsigned int i = 1; i < EdgeCurve::n_samples; ++i)
      if (edge.samples[i].distance(target) <
          edge.samples[nearest].distance(target))
        nearest = i;
    double t = EdgeCurve::parameter(nearest);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const double          step    = t < 0.5 ? 1e-5 : -1e-5;
        const Point<spacedim> x       = edge.at(t);
        const auto            tangent = (edge.at(t + step) - x) / step;
        const double          before  = t;
        t += (target - x) * tangent / (tangent * tangent);
        t = std::min(1., std::max(0., t));
        if (std::abs(t - before) < 1e-14)
          break;
      }
    const Point<spacedim> x = edge.at(t);
    if (x.distance(target) <= on_edge * edge.length + round_off(x))
      marks.push_back({image, static_cast<double>(index), quantised(t), {}});
  }


  void
  CutCrossings::tidy(std::vector<CutMark> &marks) const
  {
    for (CutMark &mark : marks)
      {
        mark.s = mark.s < snap_ ? 0. : mark.s > 1. - snap_ ? 1. : mark.s;
        // The end of a closed cut is its begin.
        const CutPath &path = paths_[mark.image.path];
        if (path.is_closed && mark.along > path.legs.size() - one_mark)
          mark.along = 0.;
      }
    const auto is_own = [](const CutMark &mark) {
      return mark.along == std::floor(mark.along);
    };
    std::sort(marks.begin(),
              marks.end(),
              [&](const CutMark &a, const CutMark &b) {
                return std::make_tuple(a.image, a.along, a.s) <
                       std::make_tuple(b.image, b.along, b.s);
              });
    std::vector<CutMark> result;
    for (const CutMark &mark : marks)
      if (!result.empty() && result.back().image == mark.image &&
          mark.along - result.back().along < one_mark &&
          std::abs(mark.s - result.back().s) < one_mark)
        {
          // The leg's end is better known than its crossing there.
          if (is_own(mark) && !is_own(result.back()))
            result.back() = mark;
        }
      else
        result.push_back(mark);
    // Where a cut meets itself or another one on the edge
    std::vector<CutMark *> by_place;
    for (CutMark &mark : result)
      by_place.push_back(&mark);
    std::stable_sort(by_place.begin(),
                     by_place.end(),
                     [](const CutMark *a, const CutMark *b) {
                       return a->s < b->s;
                     });
    for (std::size_t i = 1; i < by_place.size(); ++i)
      if (by_place[i]->s - by_place[i - 1]->s < one_mark)
        by_place[i]->s = by_place[i - 1]->s;
    marks = std::move(result);
  }


  std::vector<CutMark>
  CutCrossings::marks_of(const Cell &cell, const unsigned int face) const
  {
    std::vector<CutMark> marks;
    for (const bool in_chart : {false, true})
      {
        if (legs_[in_chart].empty())
          continue;
        const EdgeCurve edge(maps_, cell, face, in_chart);
        std::set<std::pair<CutImage, unsigned int>> points;
        for (const NearLeg &near : near_legs(edge.box(), in_chart))
          {
            add_crossings(edge, near, marks);
            const auto n = paths_[near.image.path].points.size();
            points.emplace(near.image, near.leg);
            points.emplace(near.image, (near.leg + 1) % n);
          }
        for (const auto &[image, index] : points)
          add_point(edge, image, index, marks);
      }
    tidy(marks);
    return marks;
  }


  std::vector<CutMark>
  CutCrossings::on_face(const Cell &cell, const unsigned int face) const
  {
    const auto corner = [&](const unsigned int f, const unsigned int i) {
      return maps_.reference_cell.face_to_cell_vertices(f, i, 1);
    };
    Cell         lower      = cell;
    unsigned int lower_face = face;
    bool         is_turned  = false;
    if (!cell->at_boundary(face) && cell->neighbor(face)->is_active() &&
        cell->neighbor(face)->level() == cell->level() &&
        cell->neighbor(face)->id() < cell->id())
      {
        lower      = cell->neighbor(face);
        lower_face = cell->neighbor_of_neighbor(face);
        is_turned  = lower->vertex_index(corner(lower_face, 0)) !=
                    cell->vertex_index(corner(face, 0));
      }
    auto marks = marks_of(lower, lower_face);
    // Across the seam of a closed chart the other cell's image is another.
    std::array<int, 2> seam{{0, 0}};
    if (maps_.chart && !legs_[1].empty() && lower != cell)
      {
        const auto here  = EdgeCurve(maps_, cell, face, true).samples[2];
        const auto there = EdgeCurve(maps_, lower, lower_face, true).samples[2];
        for (unsigned int d = 0; d < 2; ++d)
          if (maps_.periods[d] > 0.)
            seam[d] = std::lround((here[d] - there[d]) / maps_.periods[d]);
      }
    const auto begin =
      maps_.reference_cell.template vertex<dim>(corner(face, 0));
    const auto end = maps_.reference_cell.template vertex<dim>(corner(face, 1));
    for (CutMark &mark : marks)
      {
        if (paths_[mark.image.path].is_in_chart)
          for (unsigned int d = 0; d < 2; ++d)
            mark.image.periods[d] += seam[d];
        if (is_turned)
          mark.s = 1. - mark.s;
        for (unsigned int d = 0; d < dim; ++d)
          mark.unit[d] = (1. - mark.s) * begin[d] + mark.s * end[d];
      }
    return marks;
  }


  std::vector<CutMark>
  CutCrossings::inside(const Cell &cell) const
  {
    std::vector<CutMark> marks;
    for (const bool in_chart : {false, true})
      {
        if (legs_[in_chart].empty())
          continue;
        const auto map = [&](const Point<dim> &unit) {
          return (in_chart ? maps_.chart : maps_.position)(cell, unit);
        };
        std::vector<Point<spacedim>> corners;
        for (const unsigned int v : maps_.reference_cell.vertex_indices())
          corners.push_back(map(maps_.reference_cell.template vertex<dim>(v)));
        double shortest = corners[0].distance(corners[1]);
        for (const auto &corner : corners)
          for (const auto &other : corners)
            if (&corner < &other)
              shortest = std::min(shortest, corner.distance(other));
        Box box(corners);
        box.extend(
          0.3 * (box.side_length(0) + box.side_length(1) + box.side_length(2)));
        std::set<std::pair<CutImage, unsigned int>> points;
        for (const NearLeg &near : near_legs(box, in_chart))
          {
            points.emplace(near.image, near.leg);
            points.emplace(near.image,
                           (near.leg + 1) %
                             paths_[near.image.path].points.size());
          }
        for (const auto &[image, index] : points)
          {
            const Point<spacedim> target =
              paths_[image.path].points[index] + shift(image);
            if (!box.point_inside(target))
              continue;
            const Point<dim> unit =
              project_to_cell(DifferentiatedMap<decltype(map)>{map},
                              maps_.reference_cell,
                              target,
                              maps_.reference_cell.template barycenter<dim>());
            // Points nearer to an edge have a mark there.
            if (map(unit).distance(target) <=
                0.1 * on_edge * shortest + round_off(target))
              marks.push_back({image, static_cast<double>(index), 0., unit});
          }
      }
    return marks;
  }
} // namespace Nacre
