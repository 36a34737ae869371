// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cut_events.h>

#include <algorithm>
#include <map>

namespace Nacre
{
  namespace
  {
    /**
     * Whether the cut stays in a cell between two successive events: it has no
     * point of its own between them, which would be outside.
     */
    bool
    are_joined(const CutEvent &a, const CutEvent &b)
    {
      const double small = 1e-7;
      return std::floor(a.along + small) + 1. >= b.along - small;
    }

    /** The events of the cuts in a cell, in the order of each cut. */
    std::map<CutImage, CutRun>
    events_of(const CutCrossings         &crossings,
              const std::vector<CutPath> &paths,
              const CutFaces             &faces,
              const CellMaps::Cell       &cell)
    {
      std::map<CutImage, CutRun> events;
      const auto add = [&](const CutMark &mark, const unsigned int mask) {
        const CutPath &path = paths[mark.image.path];
        auto          &run  = events[mark.image];
        const bool     is_own =
          std::any_of(run.begin(), run.end(), [&](const CutEvent &event) {
            return event.along == mark.along;
          });
        // A cut's own point near to an edge has its mark there.
        if (mask == 0 && is_own)
          return;
        run.push_back({mark.along,
                       mark.unit,
                       mask,
                       !path.is_closed && mark.along == 0.,
                       !path.is_closed && mark.along == path.legs.size()});
      };
      for (unsigned int f = 0; f < faces.size(); ++f)
        for (const CutMark &mark : crossings.on_face(cell, f))
          add(mark, faces.mask(f, mark.s));
      for (const CutMark &mark : crossings.inside(cell))
        add(mark, 0);
      for (auto &[image, run] : events)
        std::stable_sort(run.begin(),
                         run.end(),
                         [](const CutEvent &a, const CutEvent &b) {
                           return a.along < b.along;
                         });
      return events;
    }

    /** Turn the events of a closed cut so that no run is torn. */
    void
    turn_closed(CutRun &events, const double n_legs)
    {
      const std::size_t n     = events.size();
      std::size_t       begin = n;
      const auto        next  = [&](const std::size_t i) {
        CutEvent event = events[(i + 1) % n];
        event.along += i + 1 == n ? n_legs : 0.;
        return event;
      };
      for (std::size_t i = 0; i < n && begin == n; ++i)
        if (!are_joined(events[i], next(i)))
          begin = (i + 1) % n;
      const bool is_whole = (begin == n);
      // Start where the cell changes, if it does.
      for (std::size_t i = 0; i < n && begin == n; ++i)
        if (events[i].faces != 0)
          begin = i;
      begin %= n;
      for (std::size_t i = 0; i < begin; ++i)
        events[i].along += n_legs;
      std::rotate(events.begin(), events.begin() + begin, events.end());
      if (is_whole && n > 1)
        {
          events.push_back(events.front());
          events.back().along += n_legs;
        }
    }

    /** Events between which the cut stays in the cell. */
    std::vector<CutRun>
    runs_of(const CutRun &events)
    {
      std::vector<CutRun> runs;
      for (const CutEvent &event : events)
        {
          if (runs.empty() || !are_joined(runs.back().back(), event))
            runs.emplace_back();
          else if (are_one_place(runs.back().back(), event))
            {
              runs.back().back().is_begin |= event.is_begin;
              runs.back().back().is_end |= event.is_end;
              runs.back().back().along = event.along;
              continue;
            }
          runs.back().push_back(event);
        }
      return runs;
    }
  } // namespace


  std::vector<std::pair<unsigned int, CutRun>>
  cut_runs(const CutCrossings         &crossings,
           const std::vector<CutPath> &paths,
           const CutFaces             &faces,
           const CellMaps::Cell       &cell)
  {
    std::vector<std::pair<unsigned int, CutRun>> result;
    for (auto &[image, events] : events_of(crossings, paths, faces, cell))
      {
        const CutPath &path = paths[image.path];
        if (path.is_closed)
          turn_closed(events, path.legs.size());
        for (const CutRun &run : runs_of(events))
          result.emplace_back(image.path, run);
      }
    return result;
  }


  void
  snap_points(CutRun &run, const CutFaces &faces, const double snap)
  {
    const auto move = [&](const std::size_t i, const std::size_t beside) {
      CutEvent &event = run[i];
      if (event.faces != 0)
        return;
      for (unsigned int f = 0; f < faces.size(); ++f)
        if (((run[beside].faces >> f) & 1u) != 0 &&
            faces.distance(f, event.unit) < snap)
          {
            double s = faces.parameter(f, event.unit);
            s        = std::ldexp(std::round(std::ldexp(s, 50)), -50);
            s        = s < snap ? 0. : s > 1. - snap ? 1. : s;
            if (std::abs(s - faces.parameter(f, run[beside].unit)) < snap)
              s = faces.parameter(f, run[beside].unit);
            event.unit     = faces.point(f, s);
            event.faces    = faces.mask(f, s);
            event.is_moved = true;
            return;
          }
    };
    for (std::size_t i = 1; i < run.size(); ++i)
      move(i, i - 1);
    for (std::size_t i = run.size(); i-- > 1;)
      move(i - 1, i);

    CutRun result;
    for (const CutEvent &event : run)
      {
        std::size_t n = result.size();
        if (n > 1 && result[n - 1].is_moved &&
            are_one_place(result[n - 2], event))
          {
            result.pop_back();
            --n;
          }
        if (n > 0 && are_one_place(result[n - 1], event))
          {
            result[n - 1].is_begin |= event.is_begin;
            result[n - 1].is_end |= event.is_end;
          }
        else
          result.push_back(event);
      }
    run = std::move(result);
  }
} // namespace Nacre
