// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/discretization.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

namespace Nacre
{
  namespace
  {
    /** Point and derivatives of a mid-surface given by nodes. */
    struct LocalSurface
    {
      const FiniteElement<dim, spacedim> &fe;
      const std::vector<Point<spacedim>> &nodes;

      Point<spacedim>
      position(const Point<dim> &unit) const
      {
        Point<spacedim> x;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          x += fe.shape_value(a, unit) * nodes[a];
        return x;
      }

      std::array<Tensor<1, spacedim>, dim>
      tangents(const Point<dim> &unit) const
      {
        std::array<Tensor<1, spacedim>, dim> tangents;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const auto gradient = fe.shape_grad(a, unit);
            for (unsigned int alpha = 0; alpha < dim; ++alpha)
              tangents[alpha] +=
                gradient[alpha] * Tensor<1, spacedim>(nodes[a]);
          }
        return tangents;
      }
    };

    /**
     * The unit point of the nearest point to @p target on one cell: projected
     * Gauss-Newton from @p start.
     */
    Point<dim>
    project(const LocalSurface    &surface,
            const ReferenceCell   &cell,
            const Point<spacedim> &target,
            Point<dim>             start)
    {
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
        {
          const auto   difference = target - surface.position(start);
          const auto   a          = surface.tangents(start);
          const double a_11 = a[0] * a[0], a_22 = a[1] * a[1],
                       a_12 = a[0] * a[1];
          const double b_1 = a[0] * difference, b_2 = a[1] * difference;
          const double det  = a_11 * a_22 - a_12 * a_12;
          Point<dim>   next = start;
          next[0] += (a_22 * b_1 - a_12 * b_2) / det;
          next[1] += (a_11 * b_2 - a_12 * b_1) / det;
          // Along an active bound the other coordinate moves alone.
          if (next[0] < 0. || next[0] > 1.)
            next[1] = start[1] + b_2 / a_22;
          if (next[1] < 0. || next[1] > 1.)
            next[0] = start[0] + b_1 / a_11;
          for (unsigned int alpha = 0; alpha < dim; ++alpha)
            next[alpha] = std::min(1., std::max(0., next[alpha]));
          if (cell == ReferenceCells::Triangle && next[0] + next[1] > 1.)
            {
              // Along the slanting edge, (1 - s, s).
              const auto   along = a[1] - a[0];
              const double s =
                start[1] +
                (along * (difference + (start[0] + start[1] - 1.) * a[0])) /
                  (along * along);
              next[1] = std::min(1., std::max(0., s));
              next[0] = 1. - next[1];
            }
          const double step = next.distance(start);
          start             = next;
          if (step < 1e-14)
            break;
        }
      return start;
    }

    /** The nearest point on one of this rank's cells. */
    struct NearCell
    {
      DoFHandler<dim, spacedim>::active_cell_iterator cell;
      Point<dim>                                      unit;
      Point<spacedim>                                 position;
      double                                          distance;
      double                                          size;
    };

    /** Cells whose distances differ by less than this share of their size. */
    constexpr double together = 1e-3;

    /** This rank's cells that may be the nearest ones to @p point. */
    std::vector<NearCell>
    nearest_cells(const Discretization  &discretization,
                  const Point<spacedim> &point)
    {
      const auto           &fe = discretization.scalar_fe();
      std::vector<NearCell> near;
      double                smallest = std::numeric_limits<double>::max();
      for (const auto &cell :
           discretization.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto nodes = discretization.node_positions(cell);
            const BoundingBox<spacedim> box(nodes);
            const double                size =
              box.side_length(0) + box.side_length(1) + box.side_length(2);
            const auto nearest =
              std::min_element(nodes.begin(),
                               nodes.end(),
                               [&](const auto &x, const auto &y) {
                                 return x.distance(point) < y.distance(point);
                               });
            if (nearest->distance(point) - size >= smallest + together * size)
              continue;
            const LocalSurface surface{fe, nodes};
            const Point<dim>   unit =
              project(surface,
                      discretization.element().reference_cell(),
                      point,
                      fe.unit_support_point(nearest - nodes.begin()));
            const Point<spacedim> position = surface.position(unit);
            const double          distance = position.distance(point);
            if (distance > smallest + together * size)
              continue;
            near.push_back({cell, unit, position, distance, size});
            smallest = std::min(smallest, distance);
          }
      return near;
    }

    /** A displacement by those of dofs, hanging nodes resolved. */
    using Weights = std::map<types::global_dof_index, double>;

    /** What the other ranks need to know of a near cell. */
    struct Candidate
    {
      CellId          id;
      Point<spacedim> position;
      double          distance;
      double          size;
      /** A point a twentieth of the way to the middle of the cell. */
      Point<spacedim> inside;
      /** Of the displacement along x. */
      Weights weights;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &id &position &distance &size &inside &weights;
      }
    };

    Candidate
    make_candidate(const Discretization &discretization, const NearCell &near)
    {
      const auto &fe    = discretization.scalar_fe();
      const auto  nodes = discretization.node_positions(near.cell);
      Candidate   result{near.cell->id(),
                       near.position,
                       near.distance,
                       near.size,
                       {},
                       {}};
      const auto  middle =
        discretization.element().reference_cell().template barycenter<dim>();
      result.inside = LocalSurface{fe, nodes}.position(
        near.unit + 0.05 * (middle - near.unit));

      const auto &hanging = discretization.hanging_node_constraints();
      std::vector<types::global_dof_index> dofs(
        discretization.node_dofs().size());
      near.cell->get_dof_indices(dofs);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          const double N = fe.shape_value(a, near.unit);
          const auto   i = dofs[discretization.node_dofs()[spacedim * a]];
          if (!hanging.is_constrained(i))
            result.weights[i] += N;
          else
            for (const auto &[j, weight] : *hanging.get_constraint_entries(i))
              result.weights[j] += weight * N;
        }
      return result;
    }

    /** Whether both cells hold the same particle of the surface. */
    bool
    are_joined(const Candidate &a, const Candidate &b)
    {
      // Over a distance that counts as none shape functions change by less
      // than 0.1.
      Weights difference = a.weights;
      for (const auto &[dof, weight] : b.weights)
        difference[dof] -= weight;
      return std::all_of(difference.begin(),
                         difference.end(),
                         [](const auto &entry) {
                           return std::abs(entry.second) < 0.1;
                         });
    }

    std::string
    in_words(const Point<spacedim> &x)
    {
      std::ostringstream text;
      text << '(' << x[0] << ", " << x[1] << ", " << x[2] << ')';
      return text.str();
    }

    void
    check_place(const Candidate              &best,
                const std::vector<Candidate> &all,
                const std::string            &source)
    {
      std::ostringstream off;
      off << source << ": the point lies off the mid-surface by "
          << best.distance << "; the nearest point of the mesh is "
          << in_words(best.position) << '.';
      AssertThrow(best.distance <= 0.02 * best.size, ExcMessage(off.str()));
      for (const auto &other : all)
        AssertThrow(are_joined(best, other),
                    ExcMessage(source +
                               ": the point lies on two parts of the surface "
                               "that aren't joined there, as the lips of a "
                               "slit. Choose a point further inside one of "
                               "them, such as " +
                               in_words(best.inside) + " or " +
                               in_words(other.inside) + '.'));
    }
  } // namespace

  SurfacePoint
  Discretization::locate(const Point<spacedim> &point,
                         const std::string     &source) const
  {
    const auto mine     = nearest_cells(*this, point);
    double     smallest = std::numeric_limits<double>::max();
    for (const auto &near : mine)
      smallest = std::min(smallest, near.distance);
    smallest = Utilities::MPI::min(smallest, communicator());

    std::vector<Candidate> candidates, all;
    for (const auto &near : mine)
      if (near.distance <= smallest + together * near.size)
        candidates.push_back(make_candidate(*this, near));
    for (const auto &part :
         Utilities::MPI::all_gather(communicator(), candidates))
      all.insert(all.end(), part.begin(), part.end());
    // The lowest of the cells that share the point: on any number of ranks.
    std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
      return a.id < b.id;
    });
    const auto best =
      std::find_if(all.begin(), all.end(), [&](const auto &candidate) {
        return candidate.distance <= smallest + 1e-6 * candidate.size;
      });
    Assert(best != all.end(), ExcInternalError());
    if (!is_coarse_level_)
      check_place(*best, all, source);

    SurfacePoint result;
    result.position      = best->position;
    result.distance      = best->distance;
    result.cell_diameter = best->size;
    for (const auto &near : mine)
      if (near.cell->id() == best->id)
        {
          result.is_mine = true;
          result.cell    = near.cell;
          result.unit    = near.unit;
        }
    return result;
  }
} // namespace Nacre
