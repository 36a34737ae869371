// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/cell_projection.h>
#include <nacre/discretization/discretization.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

namespace Nacre
{
  namespace
  {
    /** The nearest point on one of this rank's cells, or on a part. */
    struct NearCell
    {
      CellPart        part;
      Point<dim>      unit;
      Point<spacedim> position;
      double          distance;
      double          size;
    };

    NearCell
    nearest_point(const Discretization  &mesh,
                  const CellPart        &part,
                  const Point<spacedim> &point)
    {
      const auto &fe    = mesh.scalar_fe();
      const auto  nodes = mesh.node_positions(part);
      const auto  start =
        std::min_element(nodes.begin(),
                         nodes.end(),
                         [&](const auto &x, const auto &y) {
                           return x.distance(point) < y.distance(point);
                         });
      const NodeSurface surface{fe, nodes};
      NearCell          result;
      result.part = part;
      result.unit =
        project_to_cell(surface,
                        mesh.element().reference_cell(),
                        point,
                        fe.unit_support_point(start - nodes.begin()));
      result.position = surface.position(result.unit);
      result.distance = result.position.distance(point);
      const BoundingBox<spacedim> box(nodes);
      result.size =
        box.side_length(0) + box.side_length(1) + box.side_length(2);
      return result;
    }

    /** Points of the reference cell so near to a lip lie on it. */
    constexpr double on_lip = 1e-6;

    /**
     * Call @p use with the nearest points of this rank's cells, other than of
     * cells farther away than @p limit() for certain.
     */
    template <typename Limit, typename Use>
    void
    for_each_near_cell(const Discretization  &mesh,
                       const Point<spacedim> &point,
                       const Limit           &limit,
                       const Use             &use)
    {
      for (const CellPart &part : mesh.owned_parts())
        {
          const auto                  nodes = mesh.node_positions(part);
          const BoundingBox<spacedim> box(nodes);
          double nearest = std::numeric_limits<double>::max();
          for (const auto &node : nodes)
            nearest = std::min(nearest, node.distance(point));
          if (nearest - box.side_length(0) - box.side_length(1) -
                box.side_length(2) >
              limit())
            continue;
          const NearCell near = nearest_point(mesh, part, point);
          if (!part.is_cut() || part.polygon().contains(near.unit, on_lip))
            use(near);
        }
    }

    /**
     * This rank's cells that are as near to @p point as the nearest one of all
     * ranks, within a thousandth of its size.
     */
    std::vector<NearCell>
    nearest_cells(const Discretization  &mesh,
                  const Point<spacedim> &point,
                  double                &smallest)
    {
      double mine = std::numeric_limits<double>::max(), size = mine;
      for_each_near_cell(
        mesh,
        point,
        [&]() { return mine; },
        [&](const NearCell &near) {
          if (near.distance < mine)
            {
              mine = near.distance;
              size = near.size;
            }
        });
      smallest = Utilities::MPI::min(mine, mesh.communicator());
      if (mine > smallest)
        size = std::numeric_limits<double>::max();
      const double limit =
        smallest + 1e-3 * Utilities::MPI::min(size, mesh.communicator());
      std::vector<NearCell> cells;
      for_each_near_cell(
        mesh,
        point,
        [&]() { return limit; },
        [&](const NearCell &near) {
          if (near.distance <= limit)
            cells.push_back(near);
        });
      return cells;
    }

    /** A displacement by those of dofs, hanging nodes resolved. */
    using Weights = std::map<types::global_dof_index, double>;

    Weights
    weights_at(const Discretization &mesh,
               const CellPart       &part,
               const Point<dim>     &unit)
    {
      const auto                          &hanging = mesh.node_constraints();
      std::vector<types::global_dof_index> dofs;
      mesh.get_dof_indices(part, dofs);
      Weights weights;
      for (unsigned int a = 0; a < mesh.scalar_fe().n_dofs_per_cell(); ++a)
        {
          const double N = mesh.scalar_fe().shape_value(a, unit);
          const auto   i = dofs[mesh.node_dofs()[spacedim * a]];
          if (!hanging.is_constrained(i))
            weights[i] += N;
          else
            for (const auto &[j, weight] : *hanging.get_constraint_entries(i))
              weights[j] += weight * N;
        }
      return weights;
    }

    /** What the other ranks need to know of a near cell. */
    struct Candidate
    {
      CellId          id;
      unsigned int    number;
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
        archive &id &number &position &distance &size &inside &weights;
      }
    };

    Candidate
    make_candidate(const Discretization &mesh, const NearCell &near)
    {
      const auto middle = near.part.inner_point();
      const auto nodes  = mesh.node_positions(near.part);
      return {near.part.cell->id(),
              near.part.data != nullptr ? near.part.data->number : 0,
              near.position,
              near.distance,
              near.size,
              NodeSurface{mesh.scalar_fe(), nodes}.position(
                near.unit + 0.05 * (middle - near.unit)),
              weights_at(mesh, near.part, near.unit)};
    }

    bool
    is_of(const Candidate &candidate, const NearCell &near)
    {
      return candidate.id == near.part.cell->id() &&
             (near.part.data == nullptr ||
              candidate.number == near.part.data->number);
    }

    /**
     * Whether both are the displacement of one particle, or of two that are as
     * near to each other as those on the sides of a sharp fold.
     */
    bool
    are_same(const Weights &a, const Weights &b)
    {
      Weights difference = a;
      for (const auto &[dof, weight] : b)
        difference[dof] -= weight;
      return std::all_of(difference.begin(),
                         difference.end(),
                         [](const auto &entry) {
                           return std::abs(entry.second) < 0.1;
                         });
    }

    /**
     * The first of the near cells @p all that isn't joined to the cell @p best,
     * directly or by others of them; their number if there is none. Cells are
     * joined where the particle of one is one of the other. Collective.
     */
    std::size_t
    find_separate(const Discretization         &mesh,
                  const std::vector<NearCell>  &mine,
                  const std::vector<Candidate> &all,
                  const std::size_t             best)
    {
      std::vector<std::pair<unsigned int, unsigned int>> joints;
      for (unsigned int a = 0; a < all.size(); ++a)
        for (const auto &near : mine)
          if (all.size() > 1 && is_of(all[a], near))
            for (unsigned int b = 0; b < all.size(); ++b)
              if (are_same(
                    weights_at(
                      mesh,
                      near.part,
                      nearest_point(mesh, near.part, all[b].position).unit),
                    all[b].weights))
                joints.emplace_back(a, b);
      std::vector<bool> is_joined(all.size(), false);
      is_joined[best] = true;
      const auto joints_of_all =
        Utilities::MPI::all_gather(mesh.communicator(), joints);
      for (unsigned int round = 0; round < all.size(); ++round)
        for (const auto &list : joints_of_all)
          for (const auto &[a, b] : list)
            if (is_joined[a] || is_joined[b])
              is_joined[a] = is_joined[b] = true;
      return std::find(is_joined.begin(), is_joined.end(), false) -
             is_joined.begin();
    }

    std::string
    in_words(const Point<spacedim> &x)
    {
      std::ostringstream text;
      text << '(' << x[0] << ", " << x[1] << ", " << x[2] << ')';
      return text.str();
    }

    void
    check_distance(const Candidate &best, const std::string &source)
    {
      std::ostringstream off;
      off << source << ": the point lies off the mid-surface by "
          << best.distance << "; the nearest point of the mesh is "
          << in_words(best.position) << '.';
      AssertThrow(best.distance <= 0.02 * best.size, ExcMessage(off.str()));
    }

    /** What locate() finds, with its checks or without. */
    SurfacePoint
    find_point(const Discretization  &mesh,
               const Point<spacedim> &point,
               const std::string     &source,
               const bool             checks)
    {
      double                 smallest;
      const auto             mine = nearest_cells(mesh, point, smallest);
      std::vector<Candidate> candidates, all;
      for (const auto &near : mine)
        candidates.push_back(make_candidate(mesh, near));
      for (const auto &part :
           Utilities::MPI::all_gather(mesh.communicator(), candidates))
        all.insert(all.end(), part.begin(), part.end());
      // The lowest of the cells that share the point is the same on any number
      // of ranks.
      std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
        return std::tie(a.id, a.number) < std::tie(b.id, b.number);
      });
      const auto best =
        std::find_if(all.begin(), all.end(), [&](const auto &candidate) {
          return candidate.distance <= smallest + 1e-6 * candidate.size;
        });
      // Where pieces are removed, no part may be near.
      AssertThrow(best != all.end(),
                  ExcMessage(source + ": the point lies off the mid-surface, "
                                      "in a piece that is taken away "
                                      "(Cuts/Remove)."));
      if (checks)
        {
          check_distance(*best, source);
          const auto other = find_separate(mesh, mine, all, best - all.begin());
          AssertThrow(other == all.size(),
                      ExcMessage(source +
                                 ": the point lies on two parts of the surface "
                                 "that aren't joined there, as the lips of a "
                                 "slit. Choose a point further inside one of "
                                 "them, such as " +
                                 in_words(best->inside) + " or " +
                                 in_words(all[other].inside) + '.'));
        }

      SurfacePoint result;
      result.position      = best->position;
      result.distance      = best->distance;
      result.cell_diameter = best->size;
      for (const auto &near : mine)
        if (is_of(*best, near))
          {
            result.is_mine = true;
            result.part    = near.part;
            result.unit    = near.unit;
          }
      return result;
    }
  } // namespace

  SurfacePoint
  Discretization::locate(const Point<spacedim> &point,
                         const std::string     &source) const
  {
    return find_point(*this, point, source, !is_coarse_level_);
  }

  SurfacePoint
  Discretization::nearest(const Point<spacedim> &point) const
  {
    return find_point(*this, point, "", false);
  }
} // namespace Nacre
