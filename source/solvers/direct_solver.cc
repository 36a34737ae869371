// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/direct_solver.h>

#include <deal.II/lac/trilinos_index_access.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <dmumps_c.h>
#include <metis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace Nacre
{
  namespace
  {
    using TrilinosMatrix = TrilinosWrappers::SparseMatrix;
    using TrilinosVector = TrilinosWrappers::MPI::Vector;

    /** Adjacency in compressed rows: neighbours of i are at start[i] ... */
    struct Graph
    {
      std::vector<idx_t> start;
      std::vector<idx_t> neighbours;
    };


    /**
     * The symmetric graph, without self-loops, of the upper triangle's
     * entries (@p rows, @p columns), counted from one.
     */
    Graph
    symmetric_graph(const unsigned int            n,
                    const std::vector<MUMPS_INT> &rows,
                    const std::vector<MUMPS_INT> &columns)
    {
      Graph graph;
      graph.start.assign(n + 1, 0);
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k] != columns[k])
          {
            ++graph.start[rows[k]];
            ++graph.start[columns[k]];
          }
      for (unsigned int i = 0; i < n; ++i)
        graph.start[i + 1] += graph.start[i];
      graph.neighbours.resize(graph.start[n]);

      std::vector<idx_t> next(graph.start.begin(), graph.start.end() - 1);
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k] != columns[k])
          {
            graph.neighbours[next[rows[k] - 1]++]    = columns[k] - 1;
            graph.neighbours[next[columns[k] - 1]++] = rows[k] - 1;
          }
      return graph;
    }


    /**
     * Nested dissection by METIS (Karypis, Kumar: SIAM J. Sci. Comput. 20
     * (1998) 359-392), which merges unknowns with the same neighbours first.
     * @p position gets the place of each unknown in the order of pivots,
     * from one.
     * @return whether METIS succeeded.
     */
    bool
    fill_reducing_order(const unsigned int            n,
                        const std::vector<MUMPS_INT> &rows,
                        const std::vector<MUMPS_INT> &columns,
                        std::vector<MUMPS_INT>       &position)
    {
      Graph graph = symmetric_graph(n, rows, columns);
      idx_t options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);

      idx_t              n_vertices = n;
      std::vector<idx_t> order(n), place(n);
      const int          status = METIS_NodeND(&n_vertices,
                                      graph.start.data(),
                                      graph.neighbours.data(),
                                      nullptr,
                                      options,
                                      order.data(),
                                      place.data());
      if (status != METIS_OK)
        return false;

      // order[k] is the unknown eliminated as the k-th.
      position.resize(n);
      for (unsigned int k = 0; k < n; ++k)
        position[order[k]] = k + 1;
      return true;
    }


    /** Pieces of all ranks, one after the other, on rank 0. */
    std::vector<MUMPS_INT>
    gather_on_host(const std::vector<MUMPS_INT> &piece, const MPI_Comm comm)
    {
      const auto counts = Utilities::MPI::all_gather(comm, int(piece.size()));
      std::vector<int> offsets(1, 0);
      for (const int count : counts)
        {
          AssertThrow(offsets.back() <= std::numeric_limits<int>::max() - count,
                      ExcMessage("The matrix has more than 2^31 entries, too "
                                 "many for the direct solver."));
          offsets.push_back(offsets.back() + count);
        }
      const bool is_host = Utilities::MPI::this_mpi_process(comm) == 0;
      std::vector<MUMPS_INT> all(is_host ? offsets.back() : 0);
      const int              ierr = MPI_Gatherv(piece.data(),
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


    /** Throw on all ranks if @p is_finite is false on any. */
    void
    check_finite(const bool         is_finite,
                 const std::string &what,
                 const MPI_Comm     comm)
    {
      AssertThrow(Utilities::MPI::min(is_finite ? 1 : 0, comm) == 1,
                  ExcMessage("The " + what +
                             " of the linear system holds an infinite or "
                             "undefined (NaN) number. Check the loads, the "
                             "material and the surface's expressions."));
    }


    bool
    is_finite(const TrilinosVector &vector)
    {
      return std::all_of(vector.begin(), vector.end(), [](const double value) {
        return std::isfinite(value);
      });
    }


    /**
     * r = b - A x and its componentwise backward error. Rows in which
     * |A||x| + |b| is zero but for round-off are measured against
     * |A_i|_1 |x|_max as well: Arioli, Demmel, Duff: SIAM J. Matrix Anal.
     * Appl. 10 (1989) 165-190, section 3.
     */
    double
    residual(TrilinosVector       &r,
             const TrilinosMatrix &matrix,
             const TrilinosVector &x,
             const TrilinosVector &b)
    {
      const Epetra_CrsMatrix &A = matrix.trilinos_matrix();
      Epetra_Vector           x_columns(A.ColMap());
      const Epetra_Vector    &x_owned = *x.trilinos_vector()(0);

      const int ierr = A.Importer() != nullptr ?
                         x_columns.Import(x_owned, *A.Importer(), Insert) :
                         x_columns.Update(1., x_owned, 0.);
      AssertThrow(ierr == 0, ExcTrilinosError(ierr));

      const double x_max = x.linfty_norm();
      const double small =
        1000. * matrix.m() * std::numeric_limits<double>::epsilon();
      double error = 0.;
      for (int i = 0; i < A.NumMyRows(); ++i)
        {
          int     length;
          double *values;
          int    *columns;
          A.ExtractMyRowView(i, length, values, columns);
          const double b_i     = b.trilinos_vector()[0][i];
          double       r_i     = b_i;
          double       scale   = std::abs(b_i);
          double       row_sum = 0.;
          for (int k = 0; k < length; ++k)
            {
              const double product = values[k] * x_columns[columns[k]];
              r_i -= product;
              scale += std::abs(product);
              row_sum += std::abs(values[k]);
            }
          r.trilinos_vector()[0][i] = r_i;
          if (scale <= small * (row_sum * x_max + std::abs(b_i)))
            scale += row_sum * x_max;
          if (r_i != 0.)
            error = std::max(error, std::abs(r_i) / scale);
        }
      return Utilities::MPI::max(error, matrix.get_mpi_communicator());
    }
  } // namespace


  /** MUMPS' state and the entries handed to it, indices from one. */
  struct DirectSolver::Implementation
  {
    explicit Implementation(const MPI_Comm communicator);
    ~Implementation();

    void
    factorize(const TrilinosMatrix &matrix);
    /** @return whether any rank's pattern differs from the last one. */
    bool
    read_entries();
    void
    analyse();
    /** @return whether there are factors, that is no pivot is zero. */
    bool
    try_factors();
    void
    substitute(TrilinosVector &x, const TrilinosVector &b);
    /** @return whether the factors are accurate and regular. */
    bool
    are_factors_good();
    /** Throw on all ranks if the last call of MUMPS failed. */
    void
    check_status() const;
    bool
    is_host() const
    {
      return Utilities::MPI::this_mpi_process(communicator) == 0;
    }

    MPI_Comm               communicator;
    DMUMPS_STRUC_C         mumps;
    const TrilinosMatrix  *matrix        = nullptr;
    bool                   is_analysed   = false;
    bool                   is_factorised = false;
    std::vector<MUMPS_INT> rows, columns;
    std::vector<double>    values;
    /** Place of each unknown in the order of pivots, on rank 0. */
    std::vector<MUMPS_INT> position;
    /** Of each rank: number of rows and first row. */
    std::vector<int> counts, offsets;
  };


  DirectSolver::Implementation::Implementation(const MPI_Comm communicator)
    : communicator(communicator)
    , mumps()
  {
    mumps.par          = 1;
    mumps.sym          = 2;
    mumps.comm_fortran = MPI_Comm_c2f(communicator);
    mumps.job          = -1;
    dmumps_c(&mumps);
    AssertThrow(mumps.infog[0] == 0, ExcMessage("MUMPS does not start."));

    const auto icntl = [this](const unsigned int number) -> MUMPS_INT & {
      return mumps.icntl[number - 1];
    };
    for (unsigned int stream = 1; stream <= 4; ++stream)
      icntl(stream) = 0; // silent
    icntl(6)  = 0;       // no column permutation
    icntl(7)  = 1;       // order given
    icntl(12) = 1;       // no compression of 2x2 pivots
    icntl(13) = 1;       // no ScaLAPACK at the root: it does not count pivots
    icntl(18) = 3;       // entries distributed
    icntl(28) = 1;       // sequential analysis
  }


  DirectSolver::Implementation::~Implementation()
  {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized)
      return;
    mumps.job = -2;
    dmumps_c(&mumps);
  }


  bool
  DirectSolver::Implementation::read_entries()
  {
    const Epetra_CrsMatrix &A = matrix->trilinos_matrix();
    AssertThrow(matrix->m() <= std::numeric_limits<MUMPS_INT>::max(),
                ExcMessage("Too many unknowns for the direct solver."));
    std::vector<MUMPS_INT> new_rows, new_columns;
    new_rows.reserve(A.NumMyNonzeros() / 2 + A.NumMyRows());
    new_columns.reserve(new_rows.capacity());
    values.clear();
    values.reserve(new_rows.capacity());

    std::vector<MUMPS_INT> column_ids(A.ColMap().NumMyElements());
    for (unsigned int j = 0; j < column_ids.size(); ++j)
      column_ids[j] = TrilinosWrappers::global_index(A.ColMap(), j) + 1;
    bool is_finite = true;
    for (int i = 0; i < A.NumMyRows(); ++i)
      {
        int             length;
        double         *row_values;
        int            *row_columns;
        const MUMPS_INT row = TrilinosWrappers::global_index(A.RowMap(), i) + 1;
        A.ExtractMyRowView(i, length, row_values, row_columns);
        for (int k = 0; k < length; ++k)
          {
            const MUMPS_INT column = column_ids[row_columns[k]];
            if (!std::isfinite(row_values[k]))
              is_finite = false;
            if (column < row || (row_values[k] == 0. && column != row))
              continue;
            new_rows.push_back(row);
            new_columns.push_back(column);
            values.push_back(row_values[k]);
          }
      }
    check_finite(is_finite, "matrix", communicator);

    const int differs = new_rows != rows || new_columns != columns;
    rows.swap(new_rows);
    columns.swap(new_columns);
    return Utilities::MPI::max(differs, communicator) == 1;
  }


  void
  DirectSolver::Implementation::check_status() const
  {
    const int error = mumps.infog[0];
    if (error >= 0)
      return;
    const std::string numbers =
      " (MUMPS: INFOG(1) = " + std::to_string(error) +
      ", INFOG(2) = " + std::to_string(mumps.infog[1]) + ").";
    const bool lacks_memory =
      error == -7 || error == -8 || error == -9 || error == -13 || error == -19;
    AssertThrow(!lacks_memory,
                ExcMessage("The direct solver has too little memory for " +
                           std::to_string(matrix->m()) +
                           " unknowns: use a coarser mesh or a lower degree" +
                           numbers));
    AssertThrow(false, ExcMessage("The direct solver failed" + numbers));
  }


  void
  DirectSolver::Implementation::factorize(const TrilinosMatrix &new_matrix)
  {
    AssertDimension(new_matrix.m(), new_matrix.n());
    is_factorised = false;
    matrix        = &new_matrix;
    if (read_entries() || !is_analysed)
      analyse();
    mumps.nnz_loc = rows.size();
    mumps.irn_loc = rows.data();
    mumps.jcn_loc = columns.data();
    mumps.a_loc   = values.data();
    // Pivots of an indefinite matrix may vanish by accident: then pivot.
    for (const double threshold : {0., 0.01})
      if (!is_factorised)
        {
          mumps.cntl[0] = threshold;
          is_factorised = try_factors() && are_factors_good();
        }
    std::vector<double>().swap(values);
    mumps.a_loc = nullptr;
    AssertThrow(is_factorised,
                ExcMessage("The matrix is singular to working precision. "
                           "Either the shell, or a part of it, is free to "
                           "move, or its cells are too thin or too much "
                           "longer than wide."));
  }


  void
  DirectSolver::Implementation::analyse()
  {
    is_analysed = false;
    counts =
      Utilities::MPI::all_gather(communicator, int(matrix->local_size()));
    offsets.assign(1, 0);
    for (const int count : counts)
      offsets.push_back(offsets.back() + count);
    Assert(counts[Utilities::MPI::this_mpi_process(communicator)] == 0 ||
             int(matrix->local_range().first) ==
               offsets[Utilities::MPI::this_mpi_process(communicator)],
           ExcMessage("Each rank's rows must be contiguous and follow those "
                      "of the rank before."));

    mumps.n                = matrix->m();
    mumps.nnz_loc          = rows.size();
    mumps.irn_loc          = rows.data();
    mumps.jcn_loc          = columns.data();
    const auto all_rows    = gather_on_host(rows, communicator);
    const auto all_columns = gather_on_host(columns, communicator);
    bool       is_ordered  = true;
    if (is_host())
      is_ordered =
        fill_reducing_order(mumps.n, all_rows, all_columns, position);
    AssertThrow(Utilities::MPI::min(int(is_ordered), communicator) == 1,
                ExcMessage("METIS could not order the unknowns of the linear "
                           "system (too little memory?)."));
    mumps.perm_in = position.data();
    mumps.job     = 1;
    dmumps_c(&mumps);
    check_status();
    is_analysed = true;
  }


  bool
  DirectSolver::Implementation::try_factors()
  {
    MUMPS_INT &percent_more = mumps.icntl[13];
    percent_more            = 20;
    for (unsigned int trial = 0; trial < 4; ++trial)
      {
        mumps.job = 2;
        dmumps_c(&mumps);
        const int error = mumps.infog[0];
        // The workspace foreseen by the analysis was too small.
        if (error != -8 && error != -9 && error != -14 && error != -15 &&
            error != -17 && error != -20)
          break;
        percent_more *= 4;
      }
    if (mumps.infog[0] == -10)
      return false;
    check_status();
    return true;
  }


  void
  DirectSolver::Implementation::substitute(TrilinosVector       &x,
                                           const TrilinosVector &b)
  {
    std::vector<double> all(is_host() ? matrix->m() : 0);
    const int n_local = counts[Utilities::MPI::this_mpi_process(communicator)];

    int ierr = MPI_Gatherv(b.trilinos_vector()[0],
                           n_local,
                           MPI_DOUBLE,
                           all.data(),
                           counts.data(),
                           offsets.data(),
                           MPI_DOUBLE,
                           0,
                           communicator);
    AssertThrowMPI(ierr);
    mumps.rhs  = all.data();
    mumps.nrhs = 1;
    mumps.lrhs = mumps.n;
    mumps.job  = 3;
    dmumps_c(&mumps);
    mumps.rhs = nullptr;
    check_status();
    ierr = MPI_Scatterv(all.data(),
                        counts.data(),
                        offsets.data(),
                        MPI_DOUBLE,
                        x.trilinos_vector()[0],
                        n_local,
                        MPI_DOUBLE,
                        0,
                        communicator);
    AssertThrowMPI(ierr);
  }


  bool
  DirectSolver::Implementation::are_factors_good()
  {
    // Round-off leaves no pivot exactly zero. Two steps of inverse iteration
    // give A^{-1} of (nearly) the eigenvector of the eigenvalue next to zero;
    // if that is zero but for round-off, the residual is as large as the
    // right-hand side, however A is scaled.
    TrilinosVector x(matrix->locally_owned_range_indices(), communicator);
    TrilinosVector b(x), r(x);
    for (const auto i : b.locally_owned_elements())
      b[i] = 0.5 + std::fmod(0.6180339887498949 * i, 1.);
    b.compress(VectorOperation::insert);
    for (unsigned int step = 0; step < 2; ++step)
      {
        substitute(x, b);
        const double x_max = x.linfty_norm();
        if (step == 0 && std::isfinite(x_max) && x_max > 0.)
          b.equ(1. / x_max, x);
      }
    // Without pivoting the factors of an indefinite matrix may grow.
    const double error       = residual(r, *matrix, x, b);
    const bool   is_accurate = error < 1e-10 || mumps.cntl[0] > 0.;
    // Not-a-number must fail, too.
    return is_accurate && r.linfty_norm() < 0.1 * b.linfty_norm();
  }


  DirectSolver::DirectSolver(const MPI_Comm communicator)
    : implementation_(std::make_unique<Implementation>(communicator))
  {}


  DirectSolver::~DirectSolver() = default;


  void
  DirectSolver::factorize(const TrilinosWrappers::SparseMatrix &matrix)
  {
    implementation_->factorize(matrix);
  }


  void
  DirectSolver::prepare(const LinearSystem &system)
  {
    factorize(system.matrix);
  }


  std::optional<unsigned int>
  DirectSolver::n_negative_pivots() const
  {
    Assert(implementation_->is_factorised, ExcNotInitialized());
    return implementation_->mumps.infog[11];
  }


  SolveAccuracy
  DirectSolver::solve(TrilinosWrappers::MPI::Vector       &x,
                      const TrilinosWrappers::MPI::Vector &b)
  {
    Assert(implementation_->is_factorised, ExcNotInitialized());
    Assert(!x.has_ghost_elements() && !b.has_ghost_elements(),
           ExcMessage("The vectors must not have ghost elements."));
    const TrilinosMatrix &matrix = *implementation_->matrix;
    AssertDimension(x.size(), matrix.m());
    AssertDimension(b.size(), matrix.m());
    Assert(x.local_range() == matrix.local_range() &&
             b.local_range() == matrix.local_range(),
           ExcMessage("The vectors must be distributed as the matrix' rows."));
    check_finite(is_finite(b),
                 "right-hand side",
                 implementation_->communicator);

    implementation_->substitute(x, b);
    TrilinosVector r(b), dx(b), x_new(b);
    double         error = residual(r, matrix, x, b);
    SolveAccuracy  accuracy;
    for (unsigned int step = 0;
         step < 3 &&
         (step == 0 || error > 4. * std::numeric_limits<double>::epsilon());
         ++step)
      {
        implementation_->substitute(dx, r);
        if (step == 0 && x.linfty_norm() > 0.)
          accuracy.correction = dx.linfty_norm() / x.linfty_norm();
        x_new = x;
        x_new += dx;
        const double new_error = residual(r, matrix, x_new, b);
        if (!(new_error < error))
          break;
        x.swap(x_new);
        const bool halved = new_error <= 0.5 * error;
        error             = new_error;
        if (!halved)
          break;
      }
    accuracy.backward_error = error;
    return accuracy;
  }
} // namespace Nacre
