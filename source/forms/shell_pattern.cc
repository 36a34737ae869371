// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/shell_pattern.h>
#include <nacre/solvers/sparse_rows.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace Nacre
{
  namespace
  {
    using Dof  = types::global_dof_index;
    using Dofs = std::vector<Dof>;

    template <typename T>
    void
    sort_unique(std::vector<T> &values)
    {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    }

    /** Dofs start, start + 1, ... of one vertex, edge or cell. */
    struct Block
    {
      Dof          start;
      unsigned int length;

      bool
      operator<(const Block &other) const
      {
        return start < other.start;
      }

      bool
      operator==(const Block &other) const
      {
        return start == other.start;
      }
    };

    /** Blocks of this rank's parts and ghosts, and which of them couple. */
    class CoupledBlocks
    {
    public:
      CoupledBlocks(const Discretization            &discretization,
                    const AffineConstraints<double> &constraints)
        : discretization_(discretization)
        , constraints_(constraints)
      {
        collect_blocks();
        couple_parts();
      }

      const std::vector<Block> &
      blocks() const
      {
        return blocks_;
      }

      /**
       * The free dofs, ascending, to which this rank's cells and their edges
       * couple the block of number @p row.
       */
      void
      coupled_dofs(const unsigned int row, Dofs &dofs) const
      {
        dofs.clear();
        for (auto entry = couplings_.begin(row); entry != couplings_.end(row);
             ++entry)
          {
            const Block &block = blocks_[entry->column()];
            for (Dof dof = block.start; dof < block.start + block.length; ++dof)
              if (!constraints_.is_constrained(dof))
                dofs.push_back(dof);
          }
      }

    private:
      /** Call @p use with each dof on which eliminated ones of these depend. */
      template <typename Function>
      void
      for_each_master(const Dofs &dofs, const Function &use) const
      {
        for (const Dof dof : dofs)
          if (constraints_.is_constrained(dof))
            for (const auto &entry : *constraints_.get_constraint_entries(dof))
              use(entry.first);
      }

      /**
       * Whether nodes of the line have other copies in one of its cells than in
       * others, so that its dofs aren't those of one block everywhere.
       */
      bool
      is_split(const CellPart &part, const unsigned int line) const
      {
        const auto &split = discretization_.split_nodes();
        if (split.is_empty())
          return false;
        const auto &fe = part.cell->get_fe();
        Dofs        dofs(fe.n_dofs_per_cell());
        part.cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < fe.n_dofs_per_line(); ++k)
          if (split.has(dofs[fe.get_first_line_index() +
                             line * fe.n_dofs_per_line() + k]))
            return true;
        return false;
      }

      /** Append the blocks of the cell's dofs: consecutive numbers. */
      void
      append_blocks(const CellPart     &part,
                    Dofs               &dofs,
                    std::vector<Block> &blocks) const
      {
        const auto &fe     = part.cell->get_fe();
        const auto  append = [&](const unsigned int first,
                                const unsigned int length,
                                const bool         is_split = false) {
          // Edges may be numbered backwards.
          std::sort(dofs.begin() + first, dofs.begin() + first + length);
          for (unsigned int k = 0; k < length; ++k)
            if (k > 0 && !is_split &&
                dofs[first + k] == dofs[first + k - 1] + 1)
              ++blocks.back().length;
            else
              blocks.push_back({dofs[first + k], 1});
        };
        for (unsigned int v = 0; v < fe.reference_cell().n_vertices(); ++v)
          append(v * fe.n_dofs_per_vertex(), fe.n_dofs_per_vertex());
        for (unsigned int l = 0; l < part.cell->n_lines(); ++l)
          append(fe.get_first_line_index() + l * fe.n_dofs_per_line(),
                 fe.n_dofs_per_line(),
                 is_split(part, l));
        append(fe.get_first_quad_index(), fe.n_dofs_per_quad());
        // Those of each tip's functions
        if (part.enrichment() == nullptr)
          return;
        unsigned int first = fe.n_dofs_per_cell();
        for (const auto &share : part.enrichment()->shares)
          {
            append(first, share.n_functions());
            first += share.n_functions();
          }
      }

      void
      collect_blocks()
      {
        Dofs dofs, masters;
        for (const CellPart &part : discretization_.relevant_parts())
          {
            discretization_.get_dof_indices(part, dofs);
            for_each_master(dofs,
                            [&](const Dof dof) { masters.push_back(dof); });
            append_blocks(part, dofs, blocks_);
          }
        sort_unique(blocks_);

        // Eliminated dofs of ghosts may depend on dofs beyond the ghosts.
        std::vector<Block> others;
        for (const Dof dof : masters)
          {
            const unsigned int b = last_block_up_to(dof);
            if (b == numbers::invalid_unsigned_int ||
                dof >= blocks_[b].start + blocks_[b].length)
              others.push_back({dof, 1});
          }
        blocks_.insert(blocks_.end(), others.begin(), others.end());
        sort_unique(blocks_);
      }

      /** The last block that starts at the dof or before; invalid if none. */
      unsigned int
      last_block_up_to(const Dof dof) const
      {
        const auto next =
          std::upper_bound(blocks_.begin(), blocks_.end(), Block{dof, 0});
        return next == blocks_.begin() ? numbers::invalid_unsigned_int :
                                         next - blocks_.begin() - 1;
      }

      /** Numbers of the blocks on which the part's dofs depend, ascending. */
      std::vector<Dof>
      blocks_of(const CellPart &part) const
      {
        Dofs dofs;
        discretization_.get_dof_indices(part, dofs);
        std::vector<Block> blocks;
        append_blocks(part, dofs, blocks);
        std::vector<Dof> numbers;
        for (const auto &block : blocks)
          numbers.push_back(last_block_up_to(block.start));
        for_each_master(dofs, [&](const Dof dof) {
          numbers.push_back(last_block_up_to(dof));
        });
        sort_unique(numbers);
        return numbers;
      }

      /** Couple the blocks of each part of this rank with its neighbours'. */
      void
      couple_parts()
      {
        std::vector<std::vector<Dof>> numbers(discretization_.n_part_indices());
        for (const CellPart &part : discretization_.relevant_parts())
          numbers[part.index()] = blocks_of(part);

        couplings_.reinit(blocks_.size(), blocks_.size());
        std::vector<Dof> columns;
        for (const CellPart &part : discretization_.relevant_parts())
          {
            const bool is_mine = part.cell->is_locally_owned();
            const auto append  = [&](const CellPart &other) {
              if (is_mine || other.cell->is_locally_owned())
                columns.insert(columns.end(),
                               numbers[other.index()].begin(),
                               numbers[other.index()].end());
            };
            columns.clear();
            append(part);
            for_each_neighbor(part, append);
            sort_unique(columns);
            for (const Dof row : numbers[part.index()])
              couplings_.add_entries(row, columns.begin(), columns.end(), true);
          }
      }

      /** Call @p use with each part beyond an edge of the @p part. */
      template <typename Function>
      void
      for_each_neighbor(const CellPart &part, const Function &use) const
      {
        const auto      &cell = part.cell;
        const CellParts &cuts = discretization_.cell_parts();
        for (const auto face : cell->face_indices())
          {
            if (cell->at_boundary(face))
              continue;
            if (cuts.has_pieces(cell, face))
              {
                for (const auto &piece : cuts.pieces_between(cell, face))
                  if (piece.sides[0].part.index() == part.index())
                    use(piece.sides[1].part);
              }
            else if (cell->neighbor(face)->is_active())
              use(cuts.part(cell->neighbor(face)));
            else
              for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
                use(cuts.part(cell->neighbor_child_on_subface(face, s)));
          }
      }

      const Discretization            &discretization_;
      const AffineConstraints<double> &constraints_;
      std::vector<Block>               blocks_;
      DynamicSparsityPattern           couplings_; // of numbers of blocks
    };

    /**
     * Fill @p result with the columns of owned rows that other ranks know: a
     * block's are in some of its rows, since they may know a part of it.
     */
    void
    receive_columns(const Discretization   &discretization,
                    const CoupledBlocks    &pattern,
                    DynamicSparsityPattern &result)
    {
      const IndexSet &owned = discretization.locally_owned_dofs();
      IndexSet        rows  = owned;
      for (const auto &block : pattern.blocks())
        if (!owned.is_element(block.start))
          rows.add_index(block.start);
      result.reinit(owned.size(), owned.size(), rows);
      Dofs columns;
      for (unsigned int b = 0; b < pattern.blocks().size(); ++b)
        if (!owned.is_element(pattern.blocks()[b].start))
          {
            pattern.coupled_dofs(b, columns);
            result.add_entries(pattern.blocks()[b].start,
                               columns.begin(),
                               columns.end(),
                               true);
          }
      SparsityTools::distribute_sparsity_pattern(result,
                                                 owned,
                                                 discretization.communicator(),
                                                 rows);
    }

    /** Columns of the rows of this rank's blocks, one block after another. */
    class BlockRows
    {
    public:
      BlockRows(const Discretization            &discretization,
                const AffineConstraints<double> &constraints)
        : pattern_(discretization, constraints)
        , owned_(discretization.locally_owned_dofs())
      {
        if (Utilities::MPI::n_mpi_processes(discretization.communicator()) > 1)
          receive_columns(discretization, pattern_, received_);
      }

      /** Call @p use(block, columns) for each; columns ascend. */
      template <typename Function>
      void
      for_each(const Function &use) const
      {
        Dofs columns;
        for (unsigned int b = 0; b < pattern_.blocks().size(); ++b)
          {
            const auto &block = pattern_.blocks()[b];
            if (!owned_.is_element(block.start))
              continue;
            pattern_.coupled_dofs(b, columns);
            append_received(block, columns);
            use(block, columns);
          }
      }

    private:
      void
      append_received(const Block &block, Dofs &columns) const
      {
        if (received_.empty())
          return;
        const auto n_known = columns.size();
        for (Dof dof = block.start; dof < block.start + block.length; ++dof)
          for (unsigned int k = 0; k < received_.row_length(dof); ++k)
            columns.push_back(received_.column_number(dof, k));
        if (columns.size() > n_known)
          sort_unique(columns);
      }

      CoupledBlocks          pattern_;
      const IndexSet        &owned_;
      DynamicSparsityPattern received_; // on several ranks
    };

    /** This rank's columns come first, those of other ranks follow. */
    class LocalColumns
    {
    public:
      LocalColumns(const IndexSet &owned, Dofs &&ghosts)
        : first_(owned.n_elements() > 0 ? owned.nth_index_in_set(0) : Dof(0))
        , end_(first_ + owned.n_elements())
        , ghosts_(std::move(ghosts))
      {
        sort_unique(ghosts_);
      }

      int
      operator()(const Dof dof) const
      {
        return dof >= first_ && dof < end_ ?
                 dof - first_ :
                 end_ - first_ +
                   (std::lower_bound(ghosts_.begin(), ghosts_.end(), dof) -
                    ghosts_.begin());
      }

      const Dofs &
      ghosts() const
      {
        return ghosts_;
      }

    private:
      const Dof first_;
      const Dof end_;
      Dofs      ghosts_;
    };

    /** Write the columns of all rows; @p starts of the rows in @p indices. */
    void
    write_columns(BlockRows                       &rows,
                  const AffineConstraints<double> &constraints,
                  const LocalColumns              &local_column,
                  const int *const                 starts,
                  int *const                       indices)
    {
      rows.for_each([&](const Block &block, const Dofs &columns) {
        const int *done = nullptr;
        for (unsigned int k = 0; k < block.length; ++k)
          {
            const int row   = local_column(block.start + k);
            int      *begin = indices + starts[row];
            if (constraints.is_constrained(block.start + k))
              *begin = row;
            else if (done != nullptr)
              std::copy(done, done + columns.size(), begin);
            else
              {
                std::transform(columns.begin(),
                               columns.end(),
                               begin,
                               std::cref(local_column));
                if (!local_column.ghosts().empty())
                  std::sort(begin, begin + columns.size());
                done = begin;
              }
          }
      });
    }
  } // namespace

  void
  make_shell_pattern(const Discretization            &discretization,
                     const AffineConstraints<double> &constraints,
                     TrilinosWrappers::SparseMatrix  &matrix)
  {
    const IndexSet &owned = discretization.locally_owned_dofs();
    BlockRows       rows(discretization, constraints);

    // Starts of the rows, and columns of other ranks.
    std::vector<int> starts(owned.n_elements() + 1);
    Dofs             ghosts;
    rows.for_each([&](const Block &block, const Dofs &columns) {
      for (unsigned int k = 0; k < block.length; ++k)
        starts[owned.index_within_set(block.start + k) + 1] =
          constraints.is_constrained(block.start + k) ? 1 : columns.size();
      for (const Dof column : columns)
        if (!owned.is_element(column))
          ghosts.push_back(column);
    });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    const LocalColumns local_column(owned, std::move(ghosts));

    make_sparse_rows(
      discretization.communicator(),
      owned,
      local_column.ghosts(),
      starts,
      [&](int *const columns) {
        write_columns(rows, constraints, local_column, starts.data(), columns);
      },
      matrix);
  }
} // namespace Nacre
