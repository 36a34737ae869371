// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/postprocess/cut_quantities.h>
#include <nacre/postprocess/strain_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Nacre
{
  const Selection<CutQuantity::Kind> &
  selection(CutQuantity::Kind)
  {
    static const Selection<CutQuantity::Kind> table = {
      {CutQuantity::Kind::length, "length"},
      {CutQuantity::Kind::opening, "opening"}};
    return table;
  }

  namespace
  {
    using Vector3 = Tensor<1, spacedim>;

    const std::string opening_form =
      "write 'opening of CUT at (x, y, z)' for its size, or 'opening "
      "x|y|z|normal|(a, b, c) of CUT at (x, y, z)' for a component";

    /** A place on a cut, valid on all ranks. */
    struct CutPlace
    {
      Point<spacedim> position;
      /** Along a line of the trace, of length 1. */
      Vector3 tangent;
    };

    double
    length_of(const Discretization &discretization, const unsigned int cut)
    {
      double length = 0.;
      for (const auto &line : discretization.cut_lines())
        if (line.cut == cut)
          for (unsigned int i = 0; i + 1 < line.points.size(); ++i)
            length += line.points[i].distance(line.points[i + 1]);
      return Utilities::MPI::sum(length, discretization.communicator());
    }

    /** The place of the segment from @p a to @p b that is nearest to @p x. */
    Point<spacedim>
    nearest_on(const Point<spacedim> &a,
               const Point<spacedim> &b,
               const Point<spacedim> &x)
    {
      const Vector3 along = b - a;
      const double  part  = ((x - a) * along) / (along * along);
      return a + std::min(1., std::max(0., part)) * along;
    }

    CutPlace
    nearest_place(const Discretization  &discretization,
                  const unsigned int     cut,
                  const Point<spacedim> &x)
    {
      const MPI_Comm communicator = discretization.communicator();
      double         mine         = std::numeric_limits<double>::max();
      CutPlace       place;
      for (const auto &line : discretization.cut_lines())
        if (line.cut == cut)
          for (unsigned int i = 0; i + 1 < line.points.size(); ++i)
            {
              const Vector3 along = line.points[i + 1] - line.points[i];
              if (along.norm() == 0.)
                continue;
              const auto near =
                nearest_on(line.points[i], line.points[i + 1], x);
              if (near.distance(x) < mine)
                {
                  mine  = near.distance(x);
                  place = {near, along / along.norm()};
                }
            }
      const auto nearest = Utilities::MPI::min_max_avg(mine, communicator);
      const bool is_mine =
        nearest.min_index == Utilities::MPI::this_mpi_process(communicator);
      if (!is_mine)
        place = CutPlace();
      place.position = Point<spacedim>(
        Utilities::MPI::sum(Vector3(place.position), communicator));
      place.tangent = Utilities::MPI::sum(place.tangent, communicator);
      return place;
    }

    /** Direction of the segment of @p curve that is nearest to @p x. */
    Vector3
    direction_near(const CutCurve              &curve,
                   const Point<spacedim>       &x,
                   const std::array<double, 2> &periods)
    {
      const unsigned int n    = curve.points.size();
      double             best = std::numeric_limits<double>::max();
      Vector3            direction;
      for (unsigned int i = 0; i + (curve.is_closed ? 0 : 1) < n; ++i)
        {
          const auto     &a = curve.points[i];
          const auto     &b = curve.points[(i + 1) % n];
          Point<spacedim> here(x);
          for (unsigned int c = 0; c < dim; ++c)
            if (periods[c] > 0.)
              here[c] += periods[c] *
                         std::round((0.5 * (a[c] + b[c]) - x[c]) / periods[c]);
          const double distance = nearest_on(a, b, here).distance(here);
          if (distance < best)
            {
              best      = distance;
              direction = b - a;
            }
        }
      return direction;
    }

    /**
     * +1 if the tangent of a place points along the cut, -1 if against it: in
     * a cut that runs along an edge it is that of the edge.
     */
    double
    sense(const ShellState     &state,
          const CutCurve       &curve,
          const CutPlace       &place,
          const SurfacePoint   &at,
          const SurfaceFrame<> &frame)
    {
      if (curve.coordinates == CutCurve::Coordinates::space)
        return direction_near(curve, place.position, {{0., 0.}}) *
                     place.tangent <
                   0. ?
                 -1. :
                 1.;
      const auto chart = [&](const double step) {
        Point<dim> unit = at.unit;
        for (unsigned int c = 0; c < dim; ++c)
          unit[c] += step * (frame.a_con[c] * place.tangent);
        return state.model.midsurface.chart(at.part.cell, unit);
      };
      const double  step  = 1e-3 * at.cell_diameter;
      const Vector3 along = chart(step) - chart(-step);
      return direction_near(curve,
                            chart(0.),
                            state.model.midsurface.chart_periods()) *
                   along <
                 0. ?
               -1. :
               1.;
    }

    /** The displacement of the lip on the side @p aside of a place. */
    Vector3
    lip_displacement(const ShellState      &state,
                     const Point<spacedim> &position,
                     const Vector3         &aside,
                     const std::string     &where)
    {
      const auto &discretization = state.discretization;
      const auto  at = discretization.locate(position + aside, where);
      Vector3     u;
      run_on_all_ranks(discretization.communicator(), [&]() {
        if (!at.is_mine)
          return;
        // The part's polynomial, continued to the lip.
        Point<dim> unit = at.unit;
        for (unsigned int step = 0; step < 8; ++step)
          {
            ShellCellValues values(discretization,
                                   Quadrature<dim>(unit),
                                   false,
                                   ShellCellValues::Points::given);
            values.reinit_frames(at.part);
            for (unsigned int c = 0; c < dim; ++c)
              unit[c] +=
                values.frame(0).a_con[c] * (position - values.point(0));
          }
        StrainValues strains(state, Quadrature<dim>(unit));
        strains.reinit(at.part);
        u = strains.displacement(0);
      });
      return Utilities::MPI::sum(u, discretization.communicator());
    }

    double
    opening(const ShellState &state, const CutQuantity &quantity)
    {
      const auto    &discretization = state.discretization;
      const MPI_Comm communicator   = discretization.communicator();
      const CutPlace place =
        nearest_place(discretization, quantity.cut, quantity.point);
      const auto at = discretization.nearest(place.position);
      Vector3    normal, left;
      run_on_all_ranks(communicator, [&]() {
        if (!at.is_mine)
          return;
        ShellCellValues values(discretization,
                               Quadrature<dim>(at.unit),
                               false,
                               ShellCellValues::Points::given);
        values.reinit_frames(at.part);
        normal = values.frame(0).t0;
        left   = sense(state,
                     state.model.cuts.curves[quantity.cut],
                     place,
                     at,
                     values.frame(0)) *
               cross_product_3d(normal, place.tangent);
      });
      normal = Utilities::MPI::sum(normal, communicator);
      left   = Utilities::MPI::sum(left, communicator);
      // Farther than locate() takes the other lip for one that is near, too.
      const Vector3 aside = 5e-3 * at.cell_diameter / left.norm() * left;
      const Vector3 u =
        lip_displacement(state, place.position, aside, quantity.where) -
        lip_displacement(state, place.position, -aside, quantity.where);
      if (quantity.is_norm)
        return u.norm();
      return u * quantity.direction.value_or(normal);
    }
  } // namespace

  std::optional<CutQuantity>
  parse_cut_quantity(QuantityPhrase  &phrase,
                     const Cuts      &cuts,
                     const Constants &constants)
  {
    using Kind = CutQuantity::Kind;
    CutQuantity quantity{Kind::length};
    quantity.where = phrase.where;
    if (phrase.take("length"))
      {
        AssertThrow(phrase.take("of"),
                    ExcMessage(phrase.where + ": write 'length of CUT'."));
        quantity.cut = find_cut(phrase.text, cuts, phrase.where);
        return quantity;
      }
    if (!phrase.take("opening"))
      return {};
    quantity.kind = Kind::opening;
    // "of" may be the first word that is left.
    phrase.text                 = " " + phrase.text;
    const std::string direction = phrase.up_to("of");
    const std::string name      = phrase.up_to("at");
    AssertThrow(!phrase.text.empty(),
                ExcMessage(phrase.where + ": " + opening_form + "."));
    quantity.is_norm = direction.empty();
    if (!quantity.is_norm)
      quantity.direction = parse_direction(direction, phrase.where, constants);
    quantity.cut   = find_cut(name, cuts, phrase.where);
    quantity.point = evaluate_point(phrase.text, phrase.where, constants);
    return quantity;
  }

  double
  evaluate_cut_quantity(const ShellState &state, const CutQuantity &quantity)
  {
    return quantity.kind == CutQuantity::Kind::length ?
             length_of(state.discretization, quantity.cut) :
             opening(state, quantity);
  }
} // namespace Nacre
