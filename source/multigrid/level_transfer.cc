// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/discretization/discretization.h>
#include <nacre/multigrid/level_transfer.h>

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/shared_tria.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <deal.II/grid/cell_id.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <map>

namespace Nacre
{
  namespace
  {
    using Mesh          = parallel::TriangulationBase<dim, spacedim>;
    using cell_iterator = Triangulation<dim, spacedim>::cell_iterator;
    using Dof           = types::global_dof_index;
    /** A linear combination of dofs. */
    using Line = std::vector<std::pair<Dof, double>>;

    const unsigned int no_child = numbers::invalid_unsigned_int;

    /** The active cell of @p mesh that is the cell @p id or holds it. */
    cell_iterator
    find_active(const Mesh &mesh, const CellId &id)
    {
      auto cell =
        mesh.create_cell_iterator(CellId(id.get_coarse_cell_id(), {}));
      for (const auto child : id.get_child_indices())
        {
          if (cell->is_active())
            break;
          cell = cell->child(child);
        }
      return cell;
    }


    /** Finds the rank that owns a cell of a mesh. */
    class CellOwners
    {
    public:
      explicit CellOwners(const Mesh &mesh)
        : mesh_(mesh)
        , shared_(
            dynamic_cast<
              const parallel::shared::Triangulation<dim, spacedim> *>(&mesh))
      {
        std::vector<CellId> first;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            if (const CellId id = cell->id(); first.empty() || id < first[0])
              first.assign(1, id);
        const auto firsts =
          Utilities::MPI::all_gather(mesh.get_communicator(), first);
        for (unsigned int rank = 0; rank < firsts.size(); ++rank)
          if (!firsts[rank].empty())
            {
              firsts_.push_back(firsts[rank][0]);
              ranks_.push_back(rank);
            }
      }

      /** The owner of the active cell that is the cell @p id or holds it. */
      unsigned int
      operator()(const CellId &id) const
      {
        if (shared_ != nullptr)
          {
            const auto         cell = find_active(mesh_, id);
            const unsigned int k    = cell->active_cell_index();
            return shared_->with_artificial_cells() ?
                     shared_->get_true_subdomain_ids_of_cells()[k] :
                     cell->subdomain_id();
          }
        // p4est orders cells as their ids, a cell before its descendants.
        const auto next = std::upper_bound(firsts_.begin(), firsts_.end(), id);
        Assert(next != firsts_.begin(), ExcInternalError());
        return ranks_[next - firsts_.begin() - 1];
      }

    private:
      const Mesh                                                 &mesh_;
      const parallel::shared::Triangulation<dim, spacedim> *const shared_;
      std::vector<CellId>                                         firsts_;
      std::vector<unsigned int>                                   ranks_;
    };


    /** Dofs of the active cell of @p coarse that is or holds the cell @p id. */
    std::vector<Dof>
    active_dofs(const Discretization &coarse, const CellId &id, bool &is_same)
    {
      const auto cell = find_active(coarse.triangulation(), id);
      is_same         = (cell->level() == int(id.get_child_indices().size()));
      const DoFHandler<dim, spacedim>::active_cell_iterator dof_cell(
        &coarse.triangulation(),
        cell->level(),
        cell->index(),
        &coarse.dof_handler());
      std::vector<Dof> dofs(coarse.node_dofs().size());
      dof_cell->get_dof_indices(dofs);
      return dofs;
    }


    /** Where each rank's range of dofs begins, and the number of dofs. */
    std::vector<Dof>
    first_dofs(const Discretization &discretization)
    {
      const auto counts = Utilities::MPI::all_gather(
        discretization.communicator(),
        discretization.locally_owned_dofs().n_elements());
      std::vector<Dof> first(1, 0);
      for (const auto count : counts)
        first.push_back(first.back() + count);
      return first;
    }


    unsigned int
    owner_of(const Dof i, const std::vector<Dof> &first)
    {
      return std::upper_bound(first.begin(), first.end(), i) - first.begin() -
             1;
    }


    /** Constrained dofs among those of other ranks, expressed by others. */
    std::map<Dof, Line>
    constrained_lines(const std::vector<Dof>          &wanted,
                      const Discretization            &coarse,
                      const AffineConstraints<double> &constraints)
    {
      const auto                               comm  = coarse.communicator();
      const auto                               first = first_dofs(coarse);
      std::map<unsigned int, std::vector<Dof>> questions;
      for (const Dof i : wanted)
        questions[owner_of(i, first)].push_back(i);
      std::map<unsigned int, std::map<Dof, Line>> answers;
      for (const auto &[rank, dofs] :
           Utilities::MPI::some_to_some(comm, questions))
        {
          auto &lines = answers[rank];
          for (const Dof i : dofs)
            if (constraints.is_constrained(i))
              lines[i] = *constraints.get_constraint_entries(i);
        }
      std::map<Dof, Line> result;
      for (auto &[rank, lines] : Utilities::MPI::some_to_some(comm, answers))
        result.insert(lines.begin(), lines.end());
      return result;
    }


    /**
     * The embedding of a cell's shape functions into those of its children;
     * deal.II has that of triangles in the plane only.
     */
    std::vector<FullMatrix<double>>
    prolongation_matrices(const FiniteElement<dim, spacedim> &fe)
    {
      std::vector<FullMatrix<double>> matrices;
      const auto n_children = GeometryInfo<dim>::max_children_per_cell;
      if (fe.reference_cell() == ReferenceCells::Quadrilateral)
        for (unsigned int child = 0; child < n_children; ++child)
          matrices.push_back(fe.get_prolongation_matrix(child));
      else
        {
          const FE_SimplexP<dim> plane_fe(fe.degree);
          for (unsigned int child = 0; child < n_children; ++child)
            matrices.push_back(plane_fe.get_prolongation_matrix(child));
        }
      return matrices;
    }


    /**
     * Values at the nodes of a cell from those at the nodes of a child of it;
     * rows of nodes outside the child are zero. deal.II's restriction of
     * triangles is a projection: there, each node of the cell is one of a
     * child, at which the other shape functions of the cell vanish.
     */
    FullMatrix<double>
    interpolation_matrix(const FiniteElement<dim, spacedim> &fe,
                         const unsigned int                  child)
    {
      if (fe.reference_cell() == ReferenceCells::Quadrilateral)
        return fe.get_restriction_matrix(child);
      FullMatrix<double>       R(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
      const FullMatrix<double> P = prolongation_matrices(fe)[child];
      for (unsigned int a = 0; a < R.m(); ++a)
        for (unsigned int b = 0; b < R.n(); ++b)
          R(b, a) = std::abs(P(a, b) - 1.) < 1e-10 ? 1. : 0.;
      return R;
    }


    /** Add up the terms of equal dofs, leave out zeros. */
    void
    simplify(Line &line)
    {
      std::sort(line.begin(), line.end());
      unsigned int n = 0;
      for (unsigned int k = 0; k < line.size(); ++k)
        if (n > 0 && line[n - 1].first == line[k].first)
          line[n - 1].second += line[k].second;
        else
          line[n++] = line[k];
      line.resize(n);
      line.erase(std::remove_if(line.begin(),
                                line.end(),
                                [](const auto &term) {
                                  return std::abs(term.second) < 1e-14;
                                }),
                 line.end());
    }


    /** The nodes of @p to by those of @p from, on the same cell. */
    FullMatrix<double>
    same_cell_matrix(const Discretization &to, const Discretization &from)
    {
      const auto        &to_fe   = to.scalar_fe();
      const auto        &from_fe = from.scalar_fe();
      FullMatrix<double> matrix(to_fe.n_dofs_per_cell(),
                                from_fe.n_dofs_per_cell());
      if (to_fe == from_fe)
        for (unsigned int a = 0; a < matrix.m(); ++a)
          matrix(a, a) = 1.;
      else
        to_fe.get_interpolation_matrix(from_fe, matrix);
      return matrix;
    }
  } // namespace


  LevelTransfer::LevelTransfer(
    const Discretization            &fine,
    const AffineConstraints<double> &fine_constraints,
    const Discretization            &coarse,
    const AffineConstraints<double> &coarse_constraints)
    : fine_(fine)
    , coarse_(coarse)
  {
    find_coarse_cells();
    build(fine_constraints, coarse_constraints);
  }


  void
  LevelTransfer::find_coarse_cells()
  {
    // A cell of another rank: its place among mine, and what I ask for.
    using Question = std::pair<unsigned int, CellId>;
    using Answer   = std::pair<unsigned int, std::pair<bool, std::vector<Dof>>>;
    const CellOwners   owners(coarse_.triangulation());
    const auto         comm = fine_.communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);

    std::map<unsigned int, std::vector<Question>> questions;
    for (const auto &cell : fine_.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const CellId       id    = cell->id();
          const unsigned int owner = owners(id);
          // The last child index is needed only if the cell has a parent.
          const auto path = id.get_child_indices();
          CoarseCell found;
          found.child = path.size() == 0 ? no_child : path[path.size() - 1];
          if (owner == me)
            {
              bool is_same;
              found.dofs = active_dofs(coarse_, id, is_same);
              if (is_same)
                found.child = no_child;
            }
          else
            questions[owner].emplace_back(coarse_cells_.size(), id);
          coarse_cells_.push_back(found);
        }

    std::map<unsigned int, std::vector<Answer>> answers;
    for (const auto &[rank, list] :
         Utilities::MPI::some_to_some(comm, questions))
      for (const auto &[place, id] : list)
        {
          bool       is_same;
          const auto dofs = active_dofs(coarse_, id, is_same);
          answers[rank].emplace_back(place, std::make_pair(is_same, dofs));
        }
    for (const auto &[rank, list] : Utilities::MPI::some_to_some(comm, answers))
      for (const auto &[place, answer] : list)
        {
          coarse_cells_[place].dofs = answer.second;
          if (answer.first)
            coarse_cells_[place].child = no_child;
        }
  }


  void
  LevelTransfer::build(const AffineConstraints<double> &fine_constraints,
                       const AffineConstraints<double> &coarse_constraints)
  {
    // Lines of constrained coarse dofs that this rank doesn't know.
    std::vector<Dof> unknown;
    for (const auto &cell : coarse_cells_)
      for (const Dof j : cell.dofs)
        if (!coarse_.locally_relevant_dofs().is_element(j))
          unknown.push_back(j);
    std::sort(unknown.begin(), unknown.end());
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    const auto foreign_lines =
      constrained_lines(unknown, coarse_, coarse_constraints);
    const auto add = [&](Line &line, const Dof j, const double weight) {
      const Line *entries = nullptr;
      if (!coarse_.locally_relevant_dofs().is_element(j))
        {
          const auto found = foreign_lines.find(j);
          if (found != foreign_lines.end())
            entries = &found->second;
        }
      else if (coarse_constraints.is_constrained(j))
        entries = coarse_constraints.get_constraint_entries(j);
      if (entries == nullptr)
        line.emplace_back(j, weight);
      else
        for (const auto &[k, factor] : *entries)
          line.emplace_back(k, weight * factor);
    };

    const IndexSet   &owned = fine_.locally_owned_dofs();
    std::vector<Line> lines(owned.n_elements());
    std::vector<bool> is_done(lines.size(), false);
    std::vector<Dof>  dofs(fine_.node_dofs().size());
    const auto       &node_dofs        = fine_.node_dofs();
    const auto       &coarse_node_dofs = coarse_.node_dofs();
    const auto        same             = same_cell_matrix(fine_, coarse_);
    const auto        children    = prolongation_matrices(fine_.scalar_fe());
    auto              coarse_cell = coarse_cells_.begin();
    for (const auto &cell : fine_.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const FullMatrix<double> &P = coarse_cell->child == no_child ?
                                          same :
                                          children[coarse_cell->child];
          cell->get_dof_indices(dofs);
          for (unsigned int a = 0; a < P.m(); ++a)
            for (unsigned int c = 0; c < spacedim; ++c)
              {
                const Dof i = dofs[node_dofs[spacedim * a + c]];
                if (!owned.is_element(i) || fine_constraints.is_constrained(i))
                  continue;
                const auto row = owned.index_within_set(i);
                if (is_done[row])
                  continue;
                is_done[row] = true;
                for (unsigned int b = 0; b < P.n(); ++b)
                  if (std::abs(P(a, b)) > 1e-13)
                    add(lines[row],
                        coarse_cell->dofs[coarse_node_dofs[spacedim * b + c]],
                        P(a, b));
                simplify(lines[row]);
              }
          ++coarse_cell;
        }

    std::vector<Dof> ghosts;
    row_start_.assign(1, 0);
    for (const Line &line : lines)
      {
        row_start_.push_back(row_start_.back() + line.size());
        for (const auto &term : line)
          if (!coarse_.locally_owned_dofs().is_element(term.first))
            ghosts.push_back(term.first);
      }
    std::sort(ghosts.begin(), ghosts.end());
    IndexSet ghost_set(coarse_.n_dofs());
    ghost_set.add_indices(ghosts.begin(), ghosts.end());
    coarse_vector_.reinit(coarse_.locally_owned_dofs(),
                          ghost_set,
                          coarse_.communicator());
    columns_.reserve(row_start_.back());
    weights_.reserve(row_start_.back());
    for (const Line &line : lines)
      for (const auto &[j, weight] : line)
        {
          columns_.push_back(
            coarse_vector_.get_partitioner()->global_to_local(j));
          weights_.push_back(weight);
        }
  }


  void
  LevelTransfer::prolongate_and_add(Vector &fine, const Vector &coarse) const
  {
    coarse_vector_.zero_out_ghost_values();
    std::copy(coarse.begin(), coarse.end(), coarse_vector_.begin());
    coarse_vector_.update_ghost_values();
    const double *values = coarse_vector_.begin();
    for (std::size_t i = 0; i + 1 < row_start_.size(); ++i)
      {
        double sum = 0.;
        for (std::size_t k = row_start_[i]; k < row_start_[i + 1]; ++k)
          sum += weights_[k] * values[columns_[k]];
        fine.begin()[i] += sum;
      }
  }


  void
  LevelTransfer::restrict_to(Vector &coarse, const Vector &fine) const
  {
    coarse_vector_.zero_out_ghost_values();
    coarse_vector_ = 0.;
    double *values = coarse_vector_.begin();
    for (std::size_t i = 0; i + 1 < row_start_.size(); ++i)
      for (std::size_t k = row_start_[i]; k < row_start_[i + 1]; ++k)
        values[columns_[k]] += weights_[k] * fine.begin()[i];
    coarse_vector_.compress(VectorOperation::add);
    std::copy(coarse_vector_.begin(), coarse_vector_.end(), coarse.begin());
  }


  TrilinosWrappers::MPI::Vector
  LevelTransfer::interpolate(const TrilinosWrappers::MPI::Vector &fine) const
  {
    const auto                    comm      = coarse_.communicator();
    const IndexSet               &owned     = coarse_.locally_owned_dofs();
    const auto                    first     = first_dofs(coarse_);
    const auto                   &node_dofs = fine_.node_dofs();
    const auto                   &coarse_node_dofs = coarse_.node_dofs();
    const auto                    same = same_cell_matrix(coarse_, fine_);
    TrilinosWrappers::MPI::Vector own_values(owned, comm);
    std::map<unsigned int, std::vector<std::pair<Dof, double>>> foreign;

    std::vector<FullMatrix<double>> matrices;
    for (unsigned int child = 0; child < 4; ++child)
      matrices.push_back(interpolation_matrix(fine_.scalar_fe(), child));
    std::vector<Dof> dofs(node_dofs.size());
    auto             coarse_cell = coarse_cells_.begin();
    for (const auto &cell : fine_.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const bool  is_same = (coarse_cell->child == no_child);
          const auto &R       = is_same ? same : matrices[coarse_cell->child];
          cell->get_dof_indices(dofs);
          for (unsigned int b = 0; b < R.m(); ++b)
            {
              double row_sum = 0.;
              for (unsigned int a = 0; a < R.n(); ++a)
                row_sum += std::abs(R(b, a));
              if (!is_same && row_sum < 0.5)
                continue;
              for (unsigned int c = 0; c < spacedim; ++c)
                {
                  double value = 0.;
                  for (unsigned int a = 0; a < R.n(); ++a)
                    value += R(b, a) * fine(dofs[node_dofs[spacedim * a + c]]);
                  const Dof j =
                    coarse_cell->dofs[coarse_node_dofs[spacedim * b + c]];
                  if (owned.is_element(j))
                    own_values(j) = value;
                  else
                    foreign[owner_of(j, first)].emplace_back(j, value);
                }
            }
          ++coarse_cell;
        }
    for (const auto &[rank, values] :
         Utilities::MPI::some_to_some(comm, foreign))
      for (const auto &[j, value] : values)
        own_values(j) = value;
    own_values.compress(VectorOperation::insert);

    TrilinosWrappers::MPI::Vector result(owned,
                                         coarse_.locally_relevant_dofs(),
                                         comm);
    result = own_values;
    return result;
  }
} // namespace Nacre
