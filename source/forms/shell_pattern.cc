// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/forms/shell_pattern.h>
#include <nacre/solvers/sparse_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace Nacre
{
  namespace
  {
    using Dof  = types::global_dof_index;
    using Dofs = std::vector<Dof>;

    /** Lists of numbers, one after another: [k] from starts[k] on. */
    struct Lists
    {
      std::vector<unsigned int> starts = {0};
      std::vector<unsigned int> entries;

      /** End the list that was appended to entries. */
      void
      close()
      {
        starts.push_back(entries.size());
      }

      ArrayView<const unsigned int>
      operator[](const unsigned int k) const
      {
        return {entries.data() + starts[k], starts[k + 1] - starts[k]};
      }
    };

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
        collect_cells();
        invert_cells();
        marks_.assign(blocks_.size(), 0);
        for (const auto &block : blocks_)
          {
            bool is_free = true;
            for (unsigned int k = 0; k < block.length; ++k)
              is_free &= !constraints_.is_constrained(block.start + k);
            is_free_.push_back(is_free);
          }
      }

      const std::vector<Block> &
      blocks() const
      {
        return blocks_;
      }

      /** Number of the block that holds the @p dof. */
      unsigned int
      block_of(const Dof dof) const
      {
        const unsigned int block = last_block_up_to(dof);
        Assert(is_in(dof, block), ExcInternalError());
        return block;
      }

      /**
       * The blocks, ascending, to which this rank's cells and their edges
       * couple the @p block.
       */
      void
      coupled_blocks(const unsigned int         block,
                     std::vector<unsigned int> &result)
      {
        result.clear();
        ++n_calls_; // marks this call's result: a block may come twice
        const auto add_blocks = [&](const unsigned int cell) {
          for (const unsigned int b : cell_blocks_[cell])
            if (marks_[b] != n_calls_)
              {
                marks_[b] = n_calls_;
                result.push_back(b);
              }
        };
        for (const unsigned int cell : block_cells_[block])
          {
            if (is_mine_[cell])
              add_blocks(cell);
            for (const unsigned int neighbor : neighbors_[cell])
              if (is_mine_[cell] || is_mine_[neighbor])
                add_blocks(neighbor);
          }
        std::sort(result.begin(), result.end());
      }

      /** The free dofs of @p blocks. */
      void
      free_dofs(const std::vector<unsigned int> &blocks, Dofs &dofs) const
      {
        dofs.clear();
        for (const unsigned int b : blocks)
          if (is_free_[b])
            {
              const auto size = dofs.size();
              dofs.resize(size + blocks_[b].length);
              std::iota(dofs.begin() + size, dofs.end(), blocks_[b].start);
            }
          else
            for (unsigned int k = 0; k < blocks_[b].length; ++k)
              if (!constraints_.is_constrained(blocks_[b].start + k))
                dofs.push_back(blocks_[b].start + k);
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
      append_blocks(const FiniteElement<dim, spacedim> &fe,
                    const CellPart                     &part,
                    Dofs                               &dofs,
                    std::vector<Block>                 &blocks) const
      {
        const auto append = [&](const unsigned int first,
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
        const auto &fe = discretization_.dof_handler().get_fe();
        Dofs        dofs, masters;
        for (const CellPart &part : discretization_.relevant_parts())
          {
            discretization_.get_dof_indices(part, dofs);
            for_each_master(dofs,
                            [&](const Dof dof) { masters.push_back(dof); });
            append_blocks(fe, part, dofs, blocks_);
          }
        sort_blocks();

        // Eliminated dofs of ghosts may depend on dofs beyond the ghosts.
        std::vector<Block> others;
        for (const Dof dof : masters)
          if (!is_in(dof, last_block_up_to(dof)))
            others.push_back({dof, 1});
        blocks_.insert(blocks_.end(), others.begin(), others.end());
        sort_blocks();
      }

      void
      sort_blocks()
      {
        std::sort(blocks_.begin(), blocks_.end());
        blocks_.erase(std::unique(blocks_.begin(), blocks_.end()),
                      blocks_.end());
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

      bool
      is_in(const Dof dof, const unsigned int block) const
      {
        return block != numbers::invalid_unsigned_int &&
               dof < blocks_[block].start + blocks_[block].length;
      }

      /** Blocks and neighbours of each part. */
      void
      collect_cells()
      {
        const auto        &fe    = discretization_.dof_handler().get_fe();
        const auto         parts = discretization_.relevant_parts();
        Dofs               dofs;
        std::vector<Block> blocks;
        place_.assign(discretization_.n_part_indices(), 0);
        for (unsigned int k = 0; k < parts.size(); ++k)
          place_[parts[k].index()] = k;
        for (const CellPart &part : parts)
          {
            is_mine_.push_back(part.cell->is_locally_owned());
            blocks.clear();
            discretization_.get_dof_indices(part, dofs);
            append_blocks(fe, part, dofs, blocks);
            for (const auto &block : blocks)
              cell_blocks_.entries.push_back(block_of(block.start));
            for_each_master(dofs, [&](const Dof dof) {
              cell_blocks_.entries.push_back(block_of(dof));
            });
            append_neighbors(part);
            cell_blocks_.close();
            neighbors_.close();
          }
      }

      void
      append_neighbors(const CellPart &part)
      {
        const auto      &cell   = part.cell;
        const CellParts &cuts   = discretization_.cell_parts();
        const auto       append = [&](const CellPart &neighbor) {
          if (!neighbor.cell->is_artificial())
            neighbors_.entries.push_back(place_[neighbor.index()]);
        };
        for (const auto face : cell->face_indices())
          {
            if (cell->at_boundary(face))
              continue;
            if (cuts.has_pieces(cell, face))
              {
                for (const auto &piece : cuts.pieces_between(cell, face))
                  if (piece.sides[0].part.index() == part.index())
                    append(piece.sides[1].part);
              }
            else if (cell->neighbor(face)->is_active())
              append(cuts.part(cell->neighbor(face)));
            else
              for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
                append(cuts.part(cell->neighbor_child_on_subface(face, s)));
          }
      }

      /** block_cells_ from cell_blocks_. */
      void
      invert_cells()
      {
        auto &starts = block_cells_.starts;
        starts.assign(blocks_.size() + 1, 0);
        for (const unsigned int b : cell_blocks_.entries)
          ++starts[b + 1];
        for (unsigned int b = 0; b < blocks_.size(); ++b)
          starts[b + 1] += starts[b];
        auto next = starts;
        block_cells_.entries.resize(cell_blocks_.entries.size());
        for (unsigned int cell = 0; cell < is_mine_.size(); ++cell)
          for (const unsigned int b : cell_blocks_[cell])
            block_cells_.entries[next[b]++] = cell;
      }

      const Discretization            &discretization_;
      const AffineConstraints<double> &constraints_;
      std::vector<Block>               blocks_;
      std::vector<bool>                is_free_; // no dof of it constrained
      std::vector<bool>                is_mine_; // by relevant part
      std::vector<unsigned int>        place_;   // by CellPart::index()
      Lists                            cell_blocks_;
      Lists                            neighbors_;
      Lists                            block_cells_;
      std::vector<unsigned int>        marks_;
      unsigned int                     n_calls_ = 0;
    };

    /** Columns that other ranks know, by the first dof of this rank's block. */
    std::map<Dof, Dofs>
    exchange_columns(const Discretization &discretization,
                     CoupledBlocks        &pattern)
    {
      const MPI_Comm  communicator = discretization.communicator();
      const IndexSet &owned        = discretization.locally_owned_dofs();
      // First dofs of all ranks; numbers of ranks without any don't matter.
      const Dofs ends = Utilities::MPI::all_gather(
        communicator,
        static_cast<Dof>(owned.n_elements() == 0 ?
                           0 :
                           owned.nth_index_in_set(owned.n_elements() - 1) + 1));
      const auto owner = [&](const Dof dof) {
        unsigned int rank = 0;
        while (dof >= ends[rank])
          ++rank;
        return rank;
      };
      std::map<unsigned int, Dofs> messages;
      std::vector<unsigned int>    coupled;
      Dofs                         columns;
      for (unsigned int b = 0; b < pattern.blocks().size(); ++b)
        {
          const Dof start = pattern.blocks()[b].start;
          if (owned.is_element(start))
            continue;
          pattern.coupled_blocks(b, coupled);
          pattern.free_dofs(coupled, columns);
          if (columns.empty())
            continue;
          Dofs &message = messages[owner(start)];
          message.push_back(start);
          message.push_back(columns.size());
          message.insert(message.end(), columns.begin(), columns.end());
        }
      std::map<Dof, Dofs> result;
      for (const auto &[rank, message] :
           Utilities::MPI::some_to_some(communicator, messages))
        for (auto entry = message.begin(); entry != message.end();)
          {
            // A master beyond the ghosts comes alone, not as its whole block.
            const auto &block  = pattern.blocks()[pattern.block_of(entry[0])];
            const auto  length = entry[1];
            Dofs       &list   = result[block.start];
            list.insert(list.end(), entry + 2, entry + 2 + length);
            entry += 2 + length;
          }
      for (auto &[start, list] : result)
        {
          std::sort(list.begin(), list.end());
          list.erase(std::unique(list.begin(), list.end()), list.end());
        }
      return result;
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
          foreign_ = exchange_columns(discretization, pattern_);
      }

      /** Call @p use(block, columns) for each; columns ascend. */
      template <typename Function>
      void
      for_each(const Function &use)
      {
        Dofs columns, joint;
        for (unsigned int b = 0; b < pattern_.blocks().size(); ++b)
          {
            const auto &block = pattern_.blocks()[b];
            if (!owned_.is_element(block.start))
              continue;
            pattern_.coupled_blocks(b, coupled_);
            pattern_.free_dofs(coupled_, columns);
            const auto foreign = foreign_.find(block.start);
            if (foreign != foreign_.end())
              {
                joint.clear();
                std::set_union(columns.begin(),
                               columns.end(),
                               foreign->second.begin(),
                               foreign->second.end(),
                               std::back_inserter(joint));
                columns.swap(joint);
              }
            use(block, columns);
          }
      }

    private:
      CoupledBlocks             pattern_;
      const IndexSet           &owned_;
      std::map<Dof, Dofs>       foreign_;
      std::vector<unsigned int> coupled_;
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
        std::sort(ghosts_.begin(), ghosts_.end());
        ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()),
                      ghosts_.end());
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
