// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/base/joined_numbers.h>
#include <nacre/postprocess/refinement_marking.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    /**
     * The indicators of at least the largest threshold whose cells' @p amount,
     * summed over the ranks, reaches @p target: found by bisection, since no
     * rank knows all of them.
     */
    template <typename Amount>
    std::vector<bool>
    mark(const std::vector<double> &indicators,
         const double               target,
         const Amount              &amount,
         const MPI_Comm             communicator)
    {
      const double mine =
        indicators.empty() ?
          0. :
          *std::max_element(indicators.begin(), indicators.end());
      const double maximum = Utilities::MPI::max(mine, communicator);

      std::vector<bool> marked(indicators.size(), false);
      if (maximum == 0.)
        return marked;
      const auto reaches = [&](const double threshold) {
        double sum = 0.;
        for (const double indicator : indicators)
          if (indicator >= threshold)
            sum += amount(indicator);
        return Utilities::MPI::sum(sum, communicator) >= target;
      };
      double lower = 0., upper = maximum;
      if (reaches(upper))
        lower = upper;
      for (unsigned int k = 0; k < 200 && upper - lower > 1e-8 * upper; ++k)
        {
          const double middle               = 0.5 * (lower + upper);
          (reaches(middle) ? lower : upper) = middle;
        }
      for (unsigned int cell = 0; cell < indicators.size(); ++cell)
        marked[cell] =
          indicators[cell] > 0. && indicators[cell] >= (1. - 1e-6) * lower;
      return marked;
    }

    using Mesh = parallel::TriangulationBase<dim, spacedim>;

    /** Send the flags of a rank's cells to those that have them as ghosts. */
    void
    send_to_ghosts(const Mesh &mesh, std::vector<bool> &flags)
    {
      using Cell = Mesh::active_cell_iterator;
      GridTools::exchange_cell_data_to_ghosts<unsigned int>(
        mesh,
        [&](const Cell &cell) -> std_cxx17::optional<unsigned int> {
          return flags[cell->active_cell_index()] ? 1u : 0u;
        },
        [&](const Cell &cell, const unsigned int flag) {
          flags[cell->active_cell_index()] = (flag == 1u);
        });
    }

    /** Cells near to cuts; of one set if their cuts are joined on this rank. */
    class CutSurroundings
    {
    public:
      explicit CutSurroundings(const Discretization &discretization)
        : mesh_(discretization.triangulation())
        , is_near_(mesh_.n_active_cells(), false)
        , sets_(mesh_.n_active_cells())
      {
        for (const auto &cell :
             discretization.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            is_near_[cell->active_cell_index()] =
              discretization.cell_parts().is_near_cut(cell);
        add_cells_with_tip_functions(discretization);
        send_to_ghosts(mesh_, is_near_);
        const unsigned int        none = numbers::invalid_unsigned_int;
        std::vector<unsigned int> near_vertex(mesh_.n_vertices(), none);
        for_each_cell([&](const auto &cell, const unsigned int k) {
          if (is_near_[k])
            for (const auto v : cell->vertex_indices())
              {
                auto &first = near_vertex[cell->vertex_index(v)];
                if (first == none)
                  first = k;
                sets_.join(first, k);
              }
        });
      }

      /** Mark all of each set of which one is; returns whether any was. */
      bool
      mark_sets(std::vector<bool> &marked)
      {
        std::vector<bool> is_marked(marked.size(), false);
        for (unsigned int k = 0; k < marked.size(); ++k)
          if (is_near_[k] && marked[k])
            is_marked[sets_.set_of(k)] = true;
        return mark_if(marked, [&](const auto &, const unsigned int k) {
          return is_near_[k] && is_marked[sets_.set_of(k)];
        });
      }

      /** Mark cells that touch others of a quarter of their size. */
      bool
      balance(std::vector<bool> &marked)
      {
        std::vector<int> level(mesh_.n_vertices(), 0);
        for_each_cell([&](const auto &cell, const unsigned int k) {
          for (const auto v : cell->vertex_indices())
            {
              int &at_vertex = level[cell->vertex_index(v)];
              at_vertex = std::max(at_vertex, cell->level() + int(marked[k]));
            }
        });
        return mark_if(marked, [&](const auto &cell, const unsigned int) {
          for (const auto v : cell->vertex_indices())
            if (level[cell->vertex_index(v)] > cell->level() + 1)
              return true;
          return false;
        });
      }

    private:
      /** Functions of tips ask for one size, and for one cell more. */
      void
      add_cells_with_tip_functions(const Discretization &discretization)
      {
        if (!discretization.has_tip_functions())
          return;
        std::vector<bool> is_theirs(mesh_.n_vertices(), false);
        for (const CellPart &part : discretization.relevant_parts())
          if (part.enrichment() != nullptr)
            for (const auto v : part.cell->vertex_indices())
              is_theirs[part.cell->vertex_index(v)] = true;
        for_each_cell([&](const auto &cell, const unsigned int k) {
          for (const auto v : cell->vertex_indices())
            if (is_theirs[cell->vertex_index(v)])
              is_near_[k] = true;
        });
      }

      template <typename Function>
      void
      for_each_cell(const Function &use) const
      {
        for (const auto &cell : mesh_.active_cell_iterators())
          if (!cell->is_artificial())
            use(cell, cell->active_cell_index());
      }

      template <typename Condition>
      bool
      mark_if(std::vector<bool> &marked, const Condition &condition) const
      {
        bool has_marked = false;
        for_each_cell([&](const auto &cell, const unsigned int k) {
          if (cell->is_locally_owned() && !marked[k] && condition(cell, k))
            has_marked = marked[k] = true;
        });
        return has_marked;
      }

      const Mesh       &mesh_;
      std::vector<bool> is_near_;
      JoinedNumbers     sets_;
    };
  } // namespace

  std::vector<bool>
  RefinementMarking::bulk(const std::vector<double> &indicators,
                          const double               fraction,
                          const MPI_Comm             communicator)
  {
    double sum = 0.;
    for (const double indicator : indicators)
      sum += indicator;
    // Round-off of the sum must not call for the last cell.
    const double target =
      (1. - 1e-12) * fraction * Utilities::MPI::sum(sum, communicator);
    return mark(
      indicators,
      target,
      [](const double indicator) { return indicator; },
      communicator);
  }

  std::vector<bool>
  RefinementMarking::fixed_fraction(const std::vector<double>     &indicators,
                                    const double                   fraction,
                                    const types::global_cell_index n_cells,
                                    const MPI_Comm                 communicator)
  {
    return mark(
      indicators,
      std::max(1., std::round(fraction * n_cells)),
      [](const double) { return 1.; },
      communicator);
  }

  void
  RefinementMarking::add_cells_along_cuts(const Discretization &discretization,
                                          std::vector<bool>    &marked)
  {
    if (discretization.cell_parts().is_empty())
      return;
    const auto     &mesh = discretization.triangulation();
    CutSurroundings surroundings(discretization);
    bool            has_changed = true;
    while (has_changed)
      {
        send_to_ghosts(mesh, marked);
        has_changed = surroundings.mark_sets(marked);
        has_changed |= surroundings.balance(marked);
        has_changed = Utilities::MPI::max(has_changed ? 1 : 0,
                                          mesh.get_communicator()) == 1;
      }
  }
} // namespace Nacre
