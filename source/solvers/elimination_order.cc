// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/elimination_order.h>
#include <nacre/solvers/row_patterns.h>

#include <deal.II/base/mpi.h>

#include <amd.h>
#include <metis.h>

#include <limits>
#include <unordered_map>

namespace Nacre
{
  namespace
  {
    /** Pieces of all ranks, one after the other, on rank 0. */
    std::vector<int>
    gather_on_host(const std::vector<int> &piece, const MPI_Comm comm)
    {
      const auto counts = Utilities::MPI::all_gather(comm, int(piece.size()));
      std::vector<int> offsets(1, 0);
      for (const int count : counts)
        {
          AssertThrow(offsets.back() <= std::numeric_limits<int>::max() - count,
                      ExcMessage("The linear system is too large for the "
                                 "direct solver."));
          offsets.push_back(offsets.back() + count);
        }
      const bool       is_host = Utilities::MPI::this_mpi_process(comm) == 0;
      std::vector<int> all(is_host ? offsets.back() : 0);
      const int        ierr = MPI_Gatherv(piece.data(),
                                   piece.size(),
                                   MPI_INT,
                                   all.data(),
                                   counts.data(),
                                   offsets.data(),
                                   MPI_INT,
                                   0,
                                   comm);
      AssertThrowMPI(ierr);
      return all;
    }


    /** A graph in compressed rows: neighbours of v are at start[v] ... */
    struct Graph
    {
      std::vector<idx_t> start = {0};
      std::vector<idx_t> neighbours;
      /** Unknowns of each vertex. */
      std::vector<idx_t> weights;
    };


    /**
     * The vertices in the order of elimination: nested dissection by METIS
     * (Karypis, Kumar: SIAM J. Sci. Comput. 20 (1998) 359-392), or, for small
     * graphs, approximate minimum degree (Amestoy, Davis, Duff: ACM Trans.
     * Math. Softw. 30 (2004) 381-388). Empty if that failed.
     */
    std::vector<idx_t>
    eliminate(Graph &graph, const bool is_small)
    {
      idx_t              n = graph.weights.size();
      std::vector<idx_t> order(n), place(n);
      if (n == 0)
        return order;
      bool is_done;
      if (is_small)
        is_done = amd_order(n,
                            graph.start.data(),
                            graph.neighbours.data(),
                            order.data(),
                            nullptr,
                            nullptr) >= AMD_OK;
      else
        {
          idx_t options[METIS_NOPTIONS];
          METIS_SetDefaultOptions(options);
          options[METIS_OPTION_COMPRESS] = 0; // it is
          is_done                        = METIS_NodeND(&n,
                                 graph.start.data(),
                                 graph.neighbours.data(),
                                 graph.weights.data(),
                                 options,
                                 order.data(),
                                 place.data()) == METIS_OK;
        }
      if (!is_done)
        order.clear();
      return order;
    }


    /**
     * The representative of each row of this rank, the first row of the same
     * pattern, as global indices.
     */
    std::vector<int>
    representatives(const SparseRows &A)
    {
      std::vector<int> result;
      std::vector<int> of_pattern(A.n_rows() + 1, -1);
      for (const unsigned int pattern : RowPatterns().add(A))
        {
          int &first = of_pattern[pattern];
          if (first < 0)
            first = A.global_row(result.size());
          result.push_back(first);
        }
      return result;
    }


    /**
     * Of each representative of this rank: itself, the number of
     * representatives next to it, and these.
     */
    std::vector<int>
    neighbourhoods(const SparseRows &A, const std::vector<int> &own)
    {
      const std::vector<int>       column_vertices = A.of_columns(own);
      std::unordered_map<int, int> last_seen;
      std::vector<int>             number(A.n_columns());
      for (unsigned int j = 0; j < A.n_columns(); ++j)
        number[j] =
          last_seen.emplace(column_vertices[j], last_seen.size()).first->second;
      std::vector<int> mark(last_seen.size(), -1);

      std::vector<int> result;
      for (std::size_t i = 0; i < own.size(); ++i)
        if (own[i] == static_cast<int>(A.global_row(i)))
          {
            const SparseRows::Row row  = A[i];
            const std::size_t     head = result.size();
            result.push_back(own[i]);
            result.push_back(0);
            for (unsigned int k = 0; k < row.length; ++k)
              {
                const int j = row.columns[k];
                if (mark[number[j]] != static_cast<int>(i) &&
                    column_vertices[j] != own[i])
                  {
                    mark[number[j]] = i;
                    result.push_back(column_vertices[j]);
                  }
              }
            result[head + 1] = result.size() - head - 2;
          }
      return result;
    }


    /**
     * @param representative of each unknown
     * @param pieces neighbourhoods() of all ranks
     * @param[out] vertex of each unknown that is a representative
     */
    Graph
    collect_graph(const std::vector<int> &representative,
                  const std::vector<int> &pieces,
                  std::vector<int>       &vertex)
    {
      Graph graph;
      vertex.assign(representative.size(), 0);
      for (std::size_t k = 0; k < pieces.size(); k += 2 + pieces[k + 1])
        {
          vertex[pieces[k]] = graph.weights.size();
          graph.weights.push_back(0);
        }
      for (const int r : representative)
        ++graph.weights[vertex[r]];
      graph.start.reserve(graph.weights.size() + 1);
      graph.neighbours.reserve(1 + pieces.size() - 2 * graph.weights.size());
      for (std::size_t k = 0; k < pieces.size(); k += 2 + pieces[k + 1])
        {
          for (int l = 0; l < pieces[k + 1]; ++l)
            graph.neighbours.push_back(vertex[pieces[k + 2 + l]]);
          graph.start.push_back(graph.neighbours.size());
        }
      return graph;
    }
  } // namespace


  std::vector<int>
  elimination_order(const TrilinosWrappers::SparseMatrix &matrix)
  {
    const SparseRows A(matrix);
    const MPI_Comm   comm    = matrix.get_mpi_communicator();
    const bool       is_host = Utilities::MPI::this_mpi_process(comm) == 0;

    const auto own            = representatives(A);
    const auto pieces         = gather_on_host(neighbourhoods(A, own), comm);
    const auto representative = gather_on_host(own, comm);

    // Minimum degree is quicker and gives no more fill for small graphs, but
    // leaves less to do in parallel.
    std::vector<int> vertex, place;
    bool             is_ordered = true;
    if (is_host)
      {
        Graph      graph = collect_graph(representative, pieces, vertex);
        const bool is_small =
          graph.weights.size() <
          (Utilities::MPI::n_mpi_processes(comm) == 1 ? 3000 : 500);
        const auto order = eliminate(graph, is_small);
        is_ordered       = (order.size() == graph.weights.size());

        std::vector<int> next(order.size());
        int              n_before = 0;
        for (const int v : order)
          {
            next[v] = n_before;
            n_before += graph.weights[v];
          }
        place.resize(representative.size());
        if (is_ordered)
          for (std::size_t i = 0; i < place.size(); ++i)
            place[i] = next[vertex[representative[i]]]++;
      }
    AssertThrow(Utilities::MPI::min(int(is_ordered), comm) == 1,
                ExcMessage("METIS could not order the unknowns of the linear "
                           "system (too little memory?)."));
    return place;
  }
} // namespace Nacre
