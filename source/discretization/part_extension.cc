// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/part_extension.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe.h>

#include <deal.II/grid/grid_tools.h>

#include <sstream>

namespace Nacre
{
  Point<dim>
  continued_point(const FiniteElement<dim, spacedim> &fe,
                  const std::vector<Point<spacedim>> &nodes,
                  const Point<spacedim>              &target)
  {
    Point<dim> unit = fe.reference_cell().template barycenter<dim>();
    for (unsigned int iteration = 0; iteration < 50; ++iteration)
      {
        Tensor<1, spacedim>                  difference = target;
        std::array<Tensor<1, spacedim>, dim> tangents;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          {
            const Tensor<1, spacedim> X(nodes[a]);
            const auto                gradient = fe.shape_grad(a, unit);
            difference -= fe.shape_value(a, unit) * X;
            for (unsigned int alpha = 0; alpha < dim; ++alpha)
              tangents[alpha] += gradient[alpha] * X;
          }
        const double     a_11 = tangents[0] * tangents[0];
        const double     a_22 = tangents[1] * tangents[1];
        const double     a_12 = tangents[0] * tangents[1];
        const double     b_1  = tangents[0] * difference;
        const double     b_2  = tangents[1] * difference;
        const double     det  = a_11 * a_22 - a_12 * a_12;
        const Point<dim> step((a_22 * b_1 - a_12 * b_2) / det,
                              (a_11 * b_2 - a_12 * b_1) / det);
        unit += step;
        if (step.norm() < 1e-14)
          break;
      }
    return unit;
  }

  PartExtension::PartExtension(const MeshNodes     &mesh,
                               const double         smallest_part,
                               const PartNumbering &numbering,
                               CellParts           &parts)
    : mesh_(mesh)
    , smallest_part_(smallest_part)
    , n_dofs_(numbering.n_dofs())
    , split_nodes_(numbering.split_nodes())
    , parts_(parts)
  {
    find_roots();
    make_lines(numbering);
    exchange_nodes();
  }

  void
  PartExtension::find_roots()
  {
    roots_.resize(parts_.n_indices());
    for (const auto &cell : parts_.touched_cells())
      for (const auto &part : parts_.parts(cell))
        if (is_good(part))
          {
            Root &root    = roots_[part.index];
            root.is_known = true;
            root.cell     = cell->id();
            root.part     = part.number;
            root.dofs     = part.dofs;
            root.nodes    = mesh_.positions(CellPart(cell, &part));
          }
    const auto communicator = mesh_.dof_handler.get_communicator();
    // Not from the cell of a tip that is open, unless there is no other.
    for (const bool crosses_split_nodes : {false, true})
      while (Utilities::MPI::max(ask_neighbors(crosses_split_nodes) ? 1 : 0,
                                 communicator) == 1)
        exchange_roots();
    std::string message;
    for (const auto &cell : parts_.touched_cells())
      if (cell->is_locally_owned() && message.empty())
        for (const auto &part : parts_.parts(cell))
          if (!roots_[part.index].is_known)
            {
              std::ostringstream text;
              text << "Cuts/Cuts: they cut out a piece that is small against "
                      "the cells around the point ("
                   << cell->center() << "): no part of it has a fraction of "
                   << smallest_part_
                   << " of a cell (Cuts/Smallest part). Refine the mesh there, "
                      "or take the piece away (Cuts/Remove).";
              message = text.str();
            }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(communicator, message))
      AssertThrow(of_rank.empty(), ExcMessage(of_rank));
  }

  bool
  PartExtension::ask_neighbors(const bool crosses_split_nodes)
  {
    std::vector<std::pair<unsigned int, Root>> found;
    for (const auto &cell : parts_.touched_cells())
      {
        if (!cell->is_locally_owned())
          continue;
        std::vector<double> longest(parts_.n_parts(cell), 0.);
        std::vector<Root>   best(longest.size());
        for (const auto face : cell->face_indices())
          if (!cell->at_boundary(face) && parts_.has_pieces(cell, face))
            for (const auto &piece : parts_.pieces_between(cell, face))
              {
                const auto &[mine, other] = piece.sides;
                if (!crosses_split_nodes &&
                    (split_nodes_.is_at(mine.part.cell, mine.face) ||
                     split_nodes_.is_at(other.part.cell, other.face)))
                  continue;
                const Root  &root = roots_[other.part.index()];
                const auto   k    = mine.part.data->number;
                const double length =
                  std::abs(mine.interval[1] - mine.interval[0]);
                if (roots_[mine.part.index()].is_known || !root.is_known)
                  continue;
                // Of pieces that are equal but for round-off, the lowest.
                const bool equals = std::abs(length - longest[k]) < 1e-9;
                if (equals ? root.cell < best[k].cell : length > longest[k])
                  {
                    longest[k] = length;
                    best[k]    = root;
                  }
              }
        for (unsigned int k = 0; k < best.size(); ++k)
          if (best[k].is_known)
            found.emplace_back(parts_.parts(cell)[k].index, best[k]);
      }
    for (const auto &[index, root] : found)
      roots_[index] = root;
    return !found.empty();
  }

  void
  PartExtension::exchange_roots()
  {
    if (Utilities::MPI::n_mpi_processes(mesh_.dof_handler.get_communicator()) ==
        1)
      return;
    GridTools::exchange_cell_data_to_ghosts<std::vector<Root>>(
      mesh_.dof_handler,
      [&](
        const CellPart::Cell &cell) -> std_cxx17::optional<std::vector<Root>> {
        if (!parts_.is_cut(cell))
          return {};
        std::vector<Root> message;
        for (const auto &part : parts_.parts(cell))
          message.push_back(roots_[part.index]);
        return message;
      },
      [&](const CellPart::Cell &cell, const std::vector<Root> &message) {
        for (unsigned int i = 0; i < message.size(); ++i)
          roots_[parts_.parts(cell)[i].index] = message[i];
      });
  }

  void
  PartExtension::make_lines(const PartNumbering &numbering)
  {
    for (const auto &members : numbering.copies())
      {
        const Root *root    = nullptr;
        bool        follows = true;
        for (const auto &member : members)
          {
            const PartData &part = parts_.parts(member.cell)[member.part];
            follows &= !is_good(part);
            const Root &candidate = roots_[part.index];
            if (root == nullptr ||
                std::make_pair(candidate.cell, candidate.part) <
                  std::make_pair(root->cell, root->part))
              root = &candidate;
          }
        if (!follows)
          continue;
        const PartNode &first = members.front();
        const PartData &part  = parts_.parts(first.cell)[first.part];
        const auto      unit =
          continued_point(mesh_.scalar_fe,
                          root->nodes,
                          mesh_.positions(CellPart(first.cell))[first.node]);
        Line            line;
        Point<spacedim> position;
        for (unsigned int c = 0; c < spacedim; ++c)
          line.dofs[c] = part.dofs[mesh_.node_dofs[spacedim * first.node + c]];
        for (unsigned int a = 0; a < root->nodes.size(); ++a)
          {
            const double weight = mesh_.scalar_fe.shape_value(a, unit);
            position += weight * root->nodes[a];
            if (std::abs(weight) < 1e-14)
              continue;
            line.weights.push_back(weight);
            line.masters.emplace_back();
            line.master_positions.push_back(root->nodes[a]);
            for (unsigned int c = 0; c < spacedim; ++c)
              line.masters.back()[c] =
                root->dofs[mesh_.node_dofs[spacedim * a + c]];
          }
        line.position = position;
        lines_.push_back(line);
        for (const auto &member : members)
          {
            PartData &data = parts_.parts(member.cell)[member.part];
            if (data.nodes.empty())
              data.nodes = mesh_.positions(CellPart(member.cell));
            data.nodes[member.node] = position;
          }
      }
  }

  void
  PartExtension::exchange_nodes()
  {
    if (Utilities::MPI::n_mpi_processes(mesh_.dof_handler.get_communicator()) ==
        1)
      return;
    using Message = std::vector<std::vector<Point<spacedim>>>;
    GridTools::exchange_cell_data_to_ghosts<Message>(
      mesh_.dof_handler,
      [&](const CellPart::Cell &cell) -> std_cxx17::optional<Message> {
        if (!parts_.is_cut(cell))
          return {};
        Message message;
        for (const auto &part : parts_.parts(cell))
          message.push_back(part.nodes);
        return message;
      },
      [&](const CellPart::Cell &cell, const Message &message) {
        for (unsigned int i = 0; i < message.size(); ++i)
          parts_.parts(cell)[i].nodes = message[i];
      });
  }

  IndexSet
  PartExtension::masters_of_all_ranks() const
  {
    std::vector<Dof> masters;
    for (const auto &line : lines_)
      for (const auto &node : line.masters)
        masters.insert(masters.end(), node.begin(), node.end());
    IndexSet all(n_dofs_);
    for (auto &of_rank :
         Utilities::MPI::all_gather(mesh_.dof_handler.get_communicator(),
                                    masters))
      {
        std::sort(of_rank.begin(), of_rank.end());
        all.add_indices(of_rank.begin(), of_rank.end());
      }
    all.compress();
    return all;
  }

  void
  PartExtension::add_to(AffineConstraints<double> &constraints,
                        const TipPatches *const    tips) const
  {
    for (const auto &line : lines_)
      {
        if (constraints.is_constrained(line.dofs[0]))
          continue;
        for (unsigned int c = 0; c < spacedim; ++c)
          {
            constraints.add_line(line.dofs[c]);
            for (unsigned int a = 0; a < line.weights.size(); ++a)
              constraints.add_entry(line.dofs[c],
                                    line.masters[a][c],
                                    line.weights[a]);
          }
        if (tips != nullptr)
          tips->add_to_line(line, constraints);
      }
  }
} // namespace Nacre
