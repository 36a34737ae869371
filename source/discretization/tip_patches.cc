// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/mpi_errors.h>
#include <nacre/base/text.h>
#include <nacre/discretization/part_extension.h>
#include <nacre/discretization/tip_frame.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /** The set of all ranks' numbers. */
    std::set<types::global_dof_index>
    joined_sets(const std::set<types::global_dof_index> &mine,
                const MPI_Comm                           communicator)
    {
      const std::vector<types::global_dof_index> list(mine.begin(), mine.end());
      std::set<types::global_dof_index>          all;
      for (const auto &of_rank : Utilities::MPI::all_gather(communicator, list))
        all.insert(of_rank.begin(), of_rank.end());
      return all;
    }
  } // namespace

  TipPatches::TipPatches(const MeshNodes                   &mesh,
                         const Cuts                        &cuts,
                         const std::vector<CutTrace::Tip>  &tips,
                         const std::vector<CutTrace::Line> &lines,
                         CellParts                         &parts)
    : TipDofs(mesh.dof_handler.get_communicator(), tips.size())
    , mesh_(mesh)
    , tips_(tips)
    , patches_(tips.size())
  {
    run_on_all_ranks(communicator_, [&]() { find_frames(cuts); });
    share_frames();
    find_vertices(cuts.tip_radius);
    check(cuts);
    for (unsigned int t = 0; t < tips.size(); ++t)
      {
        Patch &patch    = patches_[t];
        patch.functions = std::make_shared<const TipFunctions>(
          cuts.tips_turn ? TipFunctions::branch_scalars(patch.frame,
                                                        patch.poissons_ratio,
                                                        patch.size) :
                           TipFunctions::branch_functions(patch.frame,
                                                          patch.poissons_ratio,
                                                          patch.size));
        ranges_[t].n_functions = patch.functions->size();
        make_path(lines, cuts.tip_radius + 8. * patch.size, t);
      }
    check_bends(cuts);
    for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const Patch &patch : patches_)
          if (is_in(patch, cell))
            parts.touch(cell);
  }

  void
  TipPatches::find_frames(const Cuts &cuts)
  {
    const unsigned int me = Utilities::MPI::this_mpi_process(communicator_);
    for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
      for (unsigned int t = 0; t < tips_.size(); ++t)
        if (cell->is_locally_owned() && cell->id() == tips_[t].cell)
          {
            Patch     &patch = patches_[t];
            const auto nodes = mesh_.positions(CellPart(cell));
            const auto surface =
              surface_at(mesh_.scalar_fe, nodes, tips_[t].unit);
            ranges_[t].owner = me;
            patch.size       = cell->diameter();
            patch.frame      = tip_frame(tips_[t], surface);
            patch.poissons_ratio =
              cuts.poissons_ratio(SectionPoint(tips_[t].position,
                                               cell->material_id()),
                                  patch.frame.axes[0],
                                  patch.frame.axes[1]);
            for (const auto v : cell->vertex_indices())
              patch.tip_vertices.insert(cell->vertex_dof_index(v, 0));
          }
  }

  void
  TipPatches::share_frames()
  {
    const unsigned int me = Utilities::MPI::this_mpi_process(communicator_);
    // A tip's number and what its cell's rank knows
    std::vector<std::vector<double>> mine;
    for (unsigned int t = 0; t < tips_.size(); ++t)
      {
        const Patch &patch = patches_[t];
        if (ranges_[t].owner != me)
          continue;
        mine.push_back(
          {static_cast<double>(t), patch.poissons_ratio, patch.size});
        for (const auto &axis : patch.frame.axes)
          for (unsigned int c = 0; c < spacedim; ++c)
            mine.back().push_back(axis[c]);
      }
    const auto all = Utilities::MPI::all_gather(communicator_, mine);
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (const auto &message : all[rank])
        {
          const auto t         = static_cast<unsigned int>(message[0]);
          Patch     &patch     = patches_[t];
          ranges_[t].owner     = rank;
          patch.poissons_ratio = message[1];
          patch.size           = message[2];
          patch.frame.position = tips_[t].position;
          for (unsigned int i = 0; i < spacedim; ++i)
            for (unsigned int c = 0; c < spacedim; ++c)
              patch.frame.axes[i][c] = message[3 + spacedim * i + c];
        }
  }

  void
  TipPatches::find_vertices(const double radius)
  {
    for (Patch &patch : patches_)
      {
        patch.tip_vertices = joined_sets(patch.tip_vertices, communicator_);
        for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const auto is_one = vertices_in(patch.tip_vertices, cell);
              const bool touches =
                std::find(is_one.begin(), is_one.end(), true) != is_one.end();
              const auto nodes = mesh_.positions(CellPart(cell));
              // The first nodes of a cell are those of its vertices.
              for (const auto v : cell->vertex_indices())
                if (touches || nodes[v].distance(patch.frame.position) < radius)
                  patch.whole_vertices.insert(cell->vertex_dof_index(v, 0));
            }
        patch.whole_vertices = joined_sets(patch.whole_vertices, communicator_);
      }
  }

  std::vector<bool>
  TipPatches::vertices_in(const std::set<Dof> &vertices, const Cell &cell) const
  {
    std::vector<bool> result;
    for (const auto v : cell->vertex_indices())
      result.push_back(vertices.count(cell->vertex_dof_index(v, 0)) > 0);
    return result;
  }

  bool
  TipPatches::is_in(const Patch &patch, const Cell &cell) const
  {
    const auto is_one = vertices_in(patch.whole_vertices, cell);
    return std::find(is_one.begin(), is_one.end(), true) != is_one.end();
  }

  std::string
  TipPatches::where(const Cuts &cuts, const unsigned int t) const
  {
    const auto &x = tips_[t].position;
    return "Cuts/Tips: branch functions of the tip of '" +
           cuts.curves[tips_[t].cut].name + "' at (" + Text::number(x[0]) +
           ", " + Text::number(x[1]) + ", " + Text::number(x[2]) + ")";
  }

  void
  TipPatches::check_bends(const Cuts &cuts) const
  {
    // How far the cut may leave the tip's line, in diameters of the cell.
    constexpr double straight = 0.02;
    run_on_all_ranks(communicator_, [&]() {
      for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
        for (unsigned int t = 0; t < tips_.size(); ++t)
          {
            if (!cell->is_locally_owned() || cell->id() != tips_[t].cell)
              continue;
            const Patch &patch = patches_[t];
            const auto   nodes = mesh_.positions(CellPart(cell));
            for (const auto &x : patch.path)
              {
                const auto unit = continued_point(mesh_.scalar_fe, nodes, x);
                if (!cell->reference_cell().contains_point(unit, 1e-8))
                  break;
                AssertThrow(
                  std::abs((x - patch.frame.position) * patch.frame.axes[1]) <
                    straight * patch.size,
                  ExcMessage(where(cuts, t) +
                             " are those of a straight cut; it turns in the "
                             "cell in which it ends. Refine the mesh there."));
              }
          }
    });
  }

  void
  TipPatches::check(const Cuts &cuts) const
  {
    run_on_all_ranks(communicator_, [&]() {
      for (const auto &cell : mesh_.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (unsigned int t = 0; t < tips_.size(); ++t)
            {
              if (!is_in(patches_[t], cell))
                continue;
              for (const auto face : cell->face_indices())
                AssertThrow(cell->at_boundary(face) ||
                              (cell->neighbor(face)->is_active() &&
                               cell->neighbor(face)->level() == cell->level()),
                            ExcMessage(where(cuts, t) +
                                       " need cells of one size around it, "
                                       "and one cell beyond those in which "
                                       "they are whole; refine there."));
              check_turn(cuts, t, cell);
              for (unsigned int s = 0; s < tips_.size(); ++s)
                AssertThrow(s == t || cell->id() != tips_[s].cell,
                            ExcMessage(where(cuts, t) + " reach the tip of '" +
                                       cuts.curves[tips_[s].cut].name +
                                       "', nearer than three cells or "
                                       "'Cuts/Tip radius'; refine the mesh, or "
                                       "choose a smaller radius."));
            }
    });
  }

  void
  TipPatches::check_turn(const Cuts        &cuts,
                         const unsigned int t,
                         const Cell        &cell) const
  {
    // Nearer cells are those that hold the crack's end, whatever they are.
    const Patch &patch = patches_[t];
    const auto   x =
      surface_at(mesh_.scalar_fe,
                 mesh_.positions(CellPart(cell)),
                 cell->reference_cell().template barycenter<dim>());
    if (Point<spacedim>(x.value).distance(patch.frame.position) <
        2. * patch.size)
      return;
    const auto normal = cross_product_3d(x.first[0], x.first[1]);
    AssertThrow(normal * patch.frame.axes[2] > 0.5 * normal.norm(),
                ExcMessage(where(cuts, t) +
                           " are fields of its tangent plane, and within "
                           "'Cuts/Tip radius' the surface turns by more than "
                           "60 degrees; choose a smaller radius."));
  }

  void
  TipPatches::make_path(const std::vector<CutTrace::Line> &lines,
                        const double                       radius,
                        const unsigned int                 t)
  {
    Patch &patch = patches_[t];
    // Ends of the segments near to the tip
    std::vector<Point<spacedim>> mine;
    for (const auto &line : lines)
      if (line.cut == tips_[t].cut)
        for (unsigned int i = 0; i + 1 < line.points.size(); ++i)
          if (line.points[i].distance(tips_[t].position) < radius)
            {
              mine.push_back(line.points[i]);
              mine.push_back(line.points[i + 1]);
            }
    std::vector<Point<spacedim>> ends;
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator_, mine))
      ends.insert(ends.end(), of_rank.begin(), of_rank.end());
    std::vector<bool> is_used(ends.size() / 2, false);
    patch.path          = {tips_[t].position};
    const double equals = 1e-7 * patch.size;
    for (bool goes_on = true; goes_on;)
      {
        goes_on = false;
        for (unsigned int i = 0; i < is_used.size() && !goes_on; ++i)
          for (const unsigned int first : {2 * i, 2 * i + 1})
            if (!is_used[i] && ends[first].distance(patch.path.back()) < equals)
              {
                patch.path.push_back(ends[4 * i + 1 - first]);
                is_used[i] = goes_on = true;
              }
      }
  }

  int
  TipPatches::side_of(const unsigned int t,
                      const CellPart    &part,
                      const bool         is_cut) const
  {
    if (holds_tip(tips_[t], part))
      return 0;
    const Patch          &patch = patches_[t];
    const Point<dim>      unit  = part.inner_point();
    const Point<spacedim> x(
      surface_at(mesh_.scalar_fe, mesh_.positions(part), unit).value);
    if (!is_cut && (x - patch.frame.position) * patch.frame.axes[0] > 0.)
      return 0;
    double nearest = std::numeric_limits<double>::max();
    double left    = 0.;
    for (unsigned int i = 0; i + 1 < patch.path.size(); ++i)
      {
        const auto  &a = patch.path[i + 1], &b = patch.path[i];
        const auto   ab = b - a;
        const double s  = std::clamp((x - a) * ab / ab.norm_square(), 0., 1.);
        const Tensor<1, 3> d        = x - (a + s * ab);
        const double       distance = d.norm();
        if (distance > nearest * (1. + 1e-9))
          continue;
        if (distance < nearest * (1. - 1e-9))
          left = 0.; // else both segments of a corner count
        nearest = std::min(nearest, distance);
        left += cross_product_3d(patch.frame.axes[2], ab / ab.norm()) * d;
      }
    return left > 0. ? 1 : left < 0. ? -1 : 0;
  }

  void
  TipPatches::find_sides_of_nodes(const CellParts &parts)
  {
    for (unsigned int t = 0; t < patches_.size(); ++t)
      {
        Patch &patch = patches_[t];
        // First dof of a node, and side + 1 of a part that has it
        std::vector<std::pair<Dof, unsigned int>> mine;
        for (const auto &cell : parts.touched_cells())
          if (cell->is_locally_owned() && is_in(patch, cell))
            for (unsigned int i = 0; i < parts.n_parts(cell); ++i)
              {
                const CellPart part = parts.part(cell, i);
                const int      side = side_of(t, part, parts.is_cut(cell));
                for (unsigned int a = 0; a < mesh_.scalar_fe.n_dofs_per_cell();
                     ++a)
                  mine.emplace_back(
                    part.data->dofs[mesh_.node_dofs[spacedim * a]],
                    side + 1);
              }
        // A node on both sides, where the crack closes, has no sheet.
        std::map<Dof, std::set<unsigned int>> found;
        for (const auto &of_rank :
             Utilities::MPI::all_gather(communicator_, mine))
          for (const auto &[dof, side] : of_rank)
            found[dof].insert(side);
        for (auto &[dof, sides] : found)
          {
            sides.erase(1);
            patch.side_of_node[dof] =
              sides.size() == 1 ? static_cast<int>(*sides.begin()) - 1 : 0;
          }
      }
  }

  PartEnrichment::Share
  TipPatches::make_share(const unsigned int t,
                         const CellPart    &part,
                         const bool         is_cut) const
  {
    const Patch          &patch = patches_[t];
    const auto            nodes = mesh_.positions(part);
    PartEnrichment::Share share;
    share.functions = patch.functions;
    share.holds_tip = holds_tip(tips_[t], part);
    share.side      = side_of(t, part, is_cut);
    share.cut       = tips_[t].cut;
    share.at_end    = tips_[t].at_end;
    share.tip       = tips_[t].unit;
    if (part.cell->id() != tips_[t].cell)
      share.tip = continued_point(mesh_.scalar_fe, nodes, tips_[t].position);
    const auto at_tip = vertices_in(patch.tip_vertices, part.cell);
    share.is_near =
      std::find(at_tip.begin(), at_tip.end(), true) != at_tip.end();

    // Vertices of quadrilaterals: (0, 0), (1, 0), (0, 1), (1, 1).
    const auto chi  = vertices_in(patch.whole_vertices, part.cell);
    share.cutoff[0] = chi[0];
    share.cutoff[1] = double(chi[1]) - double(chi[0]);
    share.cutoff[2] = double(chi[2]) - double(chi[0]);
    if (chi.size() == 4)
      share.cutoff[3] =
        double(chi[3]) - double(chi[1]) - double(chi[2]) + double(chi[0]);

    if (share.holds_tip)
      share.backward =
        backward_from_tip(patch.frame,
                          surface_at(mesh_.scalar_fe, nodes, share.tip));
    for (unsigned int a = 0; a < nodes.size(); ++a)
      share.at_nodes.push_back(patch.functions->values(
        nodes[a],
        patch.side_of_node.at(part.data->dofs[mesh_.node_dofs[spacedim * a]])));
    return share;
  }

  void
  TipPatches::complete(const std::vector<Dof> &ends, CellParts &parts)
  {
    find_sides_of_nodes(parts);
    number(ends);
    for (const auto &cell : parts.touched_cells())
      for (auto &data : parts.parts(cell))
        {
          const CellPart   part(cell, &data);
          auto             enrichment = std::make_shared<PartEnrichment>();
          std::vector<Dof> dofs;
          for (unsigned int t = 0; t < patches_.size(); ++t)
            if (is_in(patches_[t], cell))
              {
                enrichment->shares.push_back(
                  make_share(t, part, parts.is_cut(cell)));
                for (unsigned int k = 0; k < ranges_[t].n_functions; ++k)
                  dofs.push_back(ranges_[t].first + k);
              }
          if (dofs.empty())
            continue;
          data.enrichment = enrichment;
          data.dofs.insert(data.dofs.end(), dofs.begin(), dofs.end());
        }
  }

  void
  TipPatches::add_to_line(const Line                &line,
                          AffineConstraints<double> &constraints) const
  {
    for (unsigned int t = 0; t < patches_.size(); ++t)
      {
        const Patch &patch = patches_[t];
        const auto   slave = patch.side_of_node.find(line.dofs[0]);
        if (slave == patch.side_of_node.end())
          continue;
        auto rest = patch.functions->values(line.position, slave->second);
        for (unsigned int a = 0; a < line.weights.size(); ++a)
          {
            const auto master = patch.side_of_node.find(line.masters[a][0]);
            const auto F =
              patch.functions->values(line.master_positions[a],
                                      master == patch.side_of_node.end() ?
                                        slave->second :
                                        master->second);
            for (unsigned int k = 0; k < rest.size(); ++k)
              rest[k] -= line.weights[a] * F[k];
          }
        const bool scalars = patch.functions->are_scalars();
        for (unsigned int k = 0; k < rest.size(); ++k)
          for (unsigned int c = 0; c < spacedim; ++c)
            if (const double entry = rest[k][scalars ? 0 : c]; entry != 0.)
              constraints.add_entry(line.dofs[c],
                                    ranges_[t].first +
                                      (scalars ? spacedim * k + c : k),
                                    entry);
      }
  }
} // namespace Nacre
