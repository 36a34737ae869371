// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/simulation/stress_criterion.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace Nacre
{
  namespace
  {
    /** Degrees between the lines ahead of a tip, and how many on a side. */
    constexpr double degrees_between_lines = 5.;
    constexpr int    n_lines_on_side       = 18;
    /** Stresses that differ by less, in shares of the largest, are equal. */
    constexpr double equal_stress = 1e-6;
    /** Lines that are looked at together. */
    constexpr unsigned int n_together = 16;
    /** A crack doesn't end so near before an edge or a cut: of its step. */
    constexpr double least_ligament = 0.25;

    SurfaceLine
    line_ahead(const CrackTip &crack, const double angle, const double length)
    {
      const auto &e = crack.axes;
      return {crack.position,
              std::cos(angle) * e[0] + std::sin(angle) * e[1],
              e[2],
              length};
    }

    /** Whole steps of the size @p unit, for an order without round-off. */
    double
    rounded(const double x, const double unit)
    {
      return unit > 0. ? std::round(x / unit) : 0.;
    }

    /** The sign of a line's direction means nothing: make it the same. */
    Tensor<1, spacedim>
    with_sign(const Tensor<1, spacedim> &direction)
    {
      for (unsigned int c = 0; c < spacedim; ++c)
        if (std::abs(direction[c]) > 1e-6)
          return direction[c] > 0. ? direction : -direction;
      return direction;
    }

    /** What a point of a part gives, without what depends on lines. */
    CrackStart
    start_at(const PointResults &r)
    {
      CrackStart place;
      for (const auto &stress : r.stress)
        {
          const auto s = r.principal(stress);
          check_stress(s[0].value);
          if (s[0].value <= (1. + equal_stress) * place.stress)
            continue;
          // Equal tensions on all sides have no direction of their own.
          const bool is_equal =
            s[0].value - s[1].value <= 1e-3 * std::abs(s[0].value);
          const auto across = is_equal ? r.e[0] : s[0].direction;
          place.stress      = s[0].value;
          place.direction   = with_sign(cross_product_3d(r.normal, across));
        }
      place.position = r.point;
      place.normal   = r.normal;
      return place;
    }

    /** Points well inside of a cell. */
    Quadrature<dim>
    inner_points(const Discretization &discretization)
    {
      const auto middle =
        discretization.element().reference_cell().template barycenter<dim>();
      std::vector<Point<dim>> points;
      for (const auto &x : discretization.scalar_fe().get_unit_support_points())
        points.push_back(middle + 0.8 * (x - middle));
      return Quadrature<dim>(points);
    }

    bool
    is_near_tip(const Discretization &discretization,
                const CrackStart     &place,
                const double          cell_size)
    {
      return std::any_of(discretization.tips().begin(),
                         discretization.tips().end(),
                         [&](const CutTrace::Tip &tip) {
                           return tip.position.distance(place.position) <
                                  2. * place.distance + cell_size;
                         });
    }

    /** This rank's places, one of each part: where it is pulled the most. */
    std::vector<CrackStart>
    own_places(const ShellState &state, const Growth &growth)
    {
      const auto             &discretization = state.discretization;
      std::vector<CrackStart> places;
      CellResults results(state, inner_points(discretization), false, true);
      for (const CellPart &part : discretization.owned_parts())
        {
          // Small parts continue their roots' stresses.
          if (discretization.is_small(part))
            continue;
          const double size = discretization.longest_edge(part.cell);
          CrackStart   best;
          results.reinit(part);
          for (unsigned int q = 0; q < results.n_points(); ++q)
            {
              CrackStart place = start_at(results.at(q));
              place.step       = growth.step.at(size);
              place.distance   = growth.averaging_distance.at(size);
              if (place.stress > (1. + equal_stress) * best.stress &&
                  !is_near_tip(discretization, place, size))
                best = place;
            }
          if (best.stress > 0.)
            places.push_back(best);
        }
      return places;
    }

    /** The places of all ranks, in the order of their stress. */
    std::vector<CrackStart>
    all_places(const ShellState &state, const Growth &growth)
    {
      const MPI_Comm communicator = state.discretization.communicator();
      std::vector<CrackStart> mine, all;
      run_on_all_ranks(communicator,
                       [&]() { mine = own_places(state, growth); });
      using Message = std::tuple<Point<spacedim>,
                                 Tensor<1, spacedim>,
                                 Tensor<1, spacedim>,
                                 double,
                                 double,
                                 double>;
      std::vector<Message> messages;
      for (const CrackStart &p : mine)
        messages.emplace_back(p.position,
                              p.direction,
                              p.normal,
                              p.step,
                              p.distance,
                              p.stress);
      for (const auto &of_rank :
           Utilities::MPI::all_gather(communicator, messages))
        for (const auto &[x, direction, normal, step, distance, stress] :
             of_rank)
          all.push_back({x, direction, normal, step, distance, stress});
      return all;
    }

    /** Sort by @p value, equal ones by their positions. */
    void
    sort_places(std::vector<CrackStart> &places,
                double CrackStart::*const value,
                const double              extent)
    {
      double largest = 0.;
      for (const CrackStart &place : places)
        largest = std::max(largest, place.*value);
      const auto key = [&](const CrackStart &place) {
        const auto x = [&](const unsigned int c) {
          return rounded(place.position[c], 1e-8 * extent);
        };
        return std::make_tuple(-rounded(place.*value, equal_stress * largest),
                               x(0),
                               x(1),
                               x(2));
      };
      std::sort(places.begin(),
                places.end(),
                [&](const auto &a, const auto &b) { return key(a) < key(b); });
    }

    /**
     * The line over which the stress of a place is averaged. It is within the
     * line between place.ends.
     */
    SurfaceLine
    averaging_line(const CrackStart &place)
    {
      const double d = place.distance;
      // From an edge that is near, if both are, from one to the other.
      double begin = -0.5 * d, end = 0.5 * d;
      if (place.ends[0].distance < 0.5 * d)
        {
          begin = -place.ends[0].distance;
          end   = std::min(begin + d, place.ends[1].distance);
        }
      else if (place.ends[1].distance < 0.5 * d)
        {
          end   = place.ends[1].distance;
          begin = std::max(end - d, -place.ends[0].distance);
        }
      return {place.position + begin * place.direction,
              place.direction,
              place.normal,
              end - begin};
    }

    /** Two lines from each place, against a direction and along it. */
    std::vector<SurfaceLine>
    lines_both_ways(
      const std::vector<CrackStart>                                &places,
      const std::function<Tensor<1, spacedim>(const CrackStart &)> &direction,
      const std::function<double(const CrackStart &)>              &length)
    {
      std::vector<SurfaceLine> lines;
      for (const CrackStart &place : places)
        for (const double sign : {-1., 1.})
          lines.push_back({place.position,
                           sign * direction(place),
                           place.normal,
                           length(place)});
      return lines;
    }

    /** Fill in ends and drives. Collective. */
    void
    evaluate_places(const ShellState        &state,
                    const Growth            &growth,
                    std::vector<CrackStart> &places)
    {
      auto lines = lines_both_ways(
        places,
        [](const CrackStart &place) { return place.direction; },
        [](const CrackStart &place) {
          return std::max(place.distance, (1. + least_ligament) * place.step);
        });
      const auto ends = find_line_ends(state.discretization, lines);
      lines.clear();
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          places[i].ends = {{ends[2 * i], ends[2 * i + 1]}};
          lines.push_back(averaging_line(places[i]));
        }
      const auto means = mean_stresses(state, lines);
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          places[i].drive = 0.;
          for (const LineStress &s : means[i])
            if (s.across / growth.strength > places[i].drive)
              {
                places[i].drive = s.across / growth.strength;
                // To the principal direction, unless all are
                const double difference = s.across - s.along;
                places[i].turn =
                  std::abs(difference) + std::abs(s.shear) < 1e-3 * s.across ?
                    0. :
                    0.5 * std::atan2(-2. * s.shear, difference);
              }
        }
    }

    /** Replace places by candidates where these are pulled more. Collective. */
    void
    take_better(const ShellState        &state,
                const Growth            &growth,
                std::vector<CrackStart>  candidates,
                std::vector<CrackStart> &places)
    {
      evaluate_places(state, growth, candidates);
      for (unsigned int i = 0; i < places.size(); ++i)
        if (candidates[i].drive > (1. + equal_stress) * places[i].drive)
          places[i] = candidates[i];
    }

    /**
     * Move places across their cracks to where the mean tension is largest,
     * and turn them perpendicular to it. Collective.
     */
    void
    improve_places(const ShellState        &state,
                   const Growth            &growth,
                   std::vector<CrackStart> &places)
    {
      const auto lines = lines_both_ways(
        places,
        [](const CrackStart &place) {
          return cross_product_3d(place.normal, place.direction);
        },
        [](const CrackStart &place) { return 0.5 * place.distance; });
      const auto ends = find_line_ends(state.discretization, lines);
      const std::vector<CrackStart> from = places;
      const auto moved = [&](const unsigned int i, const double share) {
        const unsigned int end   = 2 * i + (share > 0. ? 1 : 0);
        CrackStart         place = from[i];
        place.position =
          state.discretization
            .nearest(place.position + std::abs(share) * ends[end].distance *
                                        lines[end].direction)
            .position;
        return place;
      };
      for (const double share :
           {-0.75, -0.5, -0.25, -0.1, 0.1, 0.25, 0.5, 0.75})
        {
          std::vector<CrackStart> candidates;
          for (unsigned int i = 0; i < places.size(); ++i)
            candidates.push_back(moved(i, share));
          take_better(state, growth, candidates, places);
        }
      std::vector<CrackStart> turned = places;
      for (CrackStart &place : turned)
        {
          const auto m = cross_product_3d(place.normal, place.direction);
          place.direction =
            std::cos(place.turn) * place.direction + std::sin(place.turn) * m;
        }
      take_better(state, growth, turned, places);
    }

    /** Whether one of @p others lies within @p distance(other) of a place. */
    template <typename Distance>
    bool
    has_neighbor(const CrackStart              &place,
                 const std::vector<CrackStart> &others,
                 const Distance                &distance)
    {
      return std::any_of(others.begin(), others.end(), [&](const auto &other) {
        return other.position.distance(place.position) < distance(other);
      });
    }

    /** An end of the cut of a crack that starts. */
    struct CutEnd
    {
      Point<spacedim> point;
      bool            is_tip;
    };

    /**
     * @param end along the line from the place to @p side times its direction
     * @param length of the crack on this side, if nothing ends it
     */
    CutEnd
    cut_end(const Discretization &discretization,
            const CrackStart     &place,
            const double          side,
            const LineEnd        &end,
            const double          length)
    {
      const auto along = side * place.direction;
      const bool is_tip =
        end.is_free() || end.distance > length + least_ligament * place.step;
      const double inside = is_tip ? length : end.distance;
      const auto foot = discretization.nearest(place.position + inside * along);
      if (is_tip)
        return {foot.position, true};
      // Through the edge, or a little beyond the cut.
      const double beyond = (end.at_cut ? 0.02 : least_ligament) * place.step;
      return {foot.position + beyond * along, false};
    }
  } // namespace

  AveragedHoopStress
  averaged_hoop_stress(const ShellState           &state,
                       const CrackTip             &crack,
                       const unsigned int          cut,
                       const double                distance,
                       const std::optional<double> angle,
                       const std::string          &tip)
  {
    AssertThrow(
      crack.has_functions || distance >= (1. - 1e-6) * crack.cell_size,
      ExcMessage("Growth/Averaging distance: " + Text::number(distance) +
                 " is less than a cell (" + Text::number(crack.cell_size) +
                 ") at the tip '" + tip +
                 "', where stresses of single cells mean nothing; choose a "
                 "finer mesh, or 'Cuts/Tips = branch functions'."));
    const int                n = angle ? 0 : n_lines_on_side;
    std::vector<SurfaceLine> lines;
    for (int k = -n; k <= n; ++k)
      lines.push_back(line_ahead(crack,
                                 angle.value_or(k * degrees_between_lines *
                                                numbers::PI / 180.),
                                 distance));
    const auto ends = find_line_ends(state.discretization, lines, cut);
    for (unsigned int l = 0; l < lines.size(); ++l)
      lines[l].length = ends[l].distance;
    const auto means = mean_stresses(state, lines);

    AveragedHoopStress best{angle.value_or(0.)};
    // Of equal stresses that which turns the crack the least is taken.
    for (int i = 0; i <= 2 * n; ++i)
      for (unsigned int face = 0; face < n_faces; ++face)
        {
          const int    k     = i % 2 == 0 ? i / 2 : -(i + 1) / 2;
          const double value = means[k + n][face].across;
          if (value <= (1. + 1e-9) * best.value)
            continue;
          best.value = value;
          if (angle)
            continue;
          double between = 0.;
          if (std::abs(k) < n)
            {
              // The top of the parabola through three lines
              const double before = means[k + n - 1][face].across,
                           after  = means[k + n + 1][face].across;
              const double bend   = before - 2. * value + after;
              if (bend < 0. && before <= value && after <= value)
                {
                  between    = 0.5 * (before - after) / bend;
                  best.value = value - 0.25 * (before - after) * between;
                }
            }
          best.angle =
            (k + between) * degrees_between_lines * numbers::PI / 180.;
        }
    return best;
  }

  std::vector<CrackStart>
  find_crack_starts(const ShellState  &state,
                    const Growth      &growth,
                    const unsigned int n_most)
  {
    const double            extent = state.discretization.extent().second;
    std::vector<CrackStart> places = all_places(state, growth);
    sort_places(places, &CrackStart::stress, extent);
    // Where the stress itself is smaller than a mean one, means are, too.
    const double            share = n_most > 1 ? 1. - growth.tolerance : 1.;
    double                  least = 0.;
    std::vector<CrackStart> seen;
    for (auto place = places.begin(); place != places.end();)
      {
        std::vector<CrackStart> next;
        for (; place != places.end() && next.size() < n_together; ++place)
          {
            const auto near = [](const CrackStart &other) {
              return 0.25 * other.distance;
            };
            if (place->stress > (1. + equal_stress) * least &&
                !has_neighbor(*place, seen, near) &&
                !has_neighbor(*place, next, near))
              next.push_back(*place);
          }
        if (next.empty())
          break;
        evaluate_places(state, growth, next);
        for (const CrackStart &found : next)
          least = std::max(least, share * found.drive * growth.strength);
        seen.insert(seen.end(), next.begin(), next.end());
      }
    sort_places(seen, &CrackStart::drive, extent);
    std::vector<CrackStart> chosen;
    for (const CrackStart &place : seen)
      if (chosen.size() < n_most && place.drive > 0. &&
          place.drive >= share * seen.front().drive &&
          !has_neighbor(place, chosen, [](const CrackStart &other) {
            return other.distance + other.step;
          }))
        chosen.push_back(place);
    improve_places(state, growth, chosen);
    sort_places(chosen, &CrackStart::drive, extent);
    return chosen;
  }

  CutStart
  make_cut(const Discretization &discretization,
           const CrackStart     &place,
           const Cuts           &cuts)
  {
    std::array<double, 2> length{{place.step, place.step}};
    for (const unsigned int side : {0, 1})
      {
        const LineEnd &near = place.ends[side];
        if (!near.is_free() && near.distance <= place.distance)
          // From there, over the place, a step inwards
          length[1 - side] = std::max(place.step - near.distance,
                                      place.distance - near.distance);
      }
    const CutEnd begin =
      cut_end(discretization, place, -1., place.ends[0], length[0]);
    const CutEnd end =
      cut_end(discretization, place, 1., place.ends[1], length[1]);

    CutStart start;
    start.has_begin         = begin.is_tip;
    start.has_end           = end.is_tip;
    start.curve.coordinates = CutCurve::Coordinates::space;
    start.curve.points      = {begin.point, end.point};
    unsigned int number     = 0;
    do
      start.curve.name = "started " + std::to_string(++number);
    while (std::any_of(cuts.curves.begin(),
                       cuts.curves.end(),
                       [&](const CutCurve &other) {
                         return other.name == start.curve.name;
                       }));
    return start;
  }
} // namespace Nacre
