// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_solvers_sparse_rows_h
#define nacre_solvers_sparse_rows_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <functional>
#include <memory>
#include <vector>

class Epetra_CrsMatrix;

namespace Nacre
{
  using namespace dealii;

  /**
   * The rows of a distributed sparse matrix that this rank holds, as arrays.
   * Assembly, smoothers and factors need them, since deal.II's iterators are
   * too slow. Columns have local numbers, this rank's first, in the order of
   * its rows.
   *
   * This class and make_sparse_rows() alone know the library behind
   * TrilinosWrappers, Epetra. Whoever replaces it changes this file only.
   */
  class SparseRows
  {
  public:
    using Matrix = TrilinosWrappers::SparseMatrix;
    using Vector = TrilinosWrappers::MPI::Vector;
    using Dof    = types::global_dof_index;

    /** One row; its columns are local numbers. */
    struct Row
    {
      unsigned int length;
      const int   *columns;
      double      *values;
    };

    /** Those of @p matrix, which must stay alive and keep its pattern. */
    explicit SparseRows(const Matrix &matrix);

    /** A copy of the @p rows of @p matrix, maybe of other ranks; collective. */
    SparseRows(const Matrix &matrix, const IndexSet &rows);

    unsigned int
    n_rows() const;

    /** Number of different columns of all rows. */
    unsigned int
    n_columns() const;

    Row
    operator[](const unsigned int i) const
    {
      return {static_cast<unsigned int>(starts_[i + 1] - starts_[i]),
              columns_ + starts_[i],
              values_ + starts_[i]};
    }

    Dof
    global_row(const unsigned int i) const;

    Dof
    global_column(const unsigned int j) const;

    /** Negative if no row has the @p column. */
    int
    local_column(const Dof column) const;

    /** Entries on the diagonal of square rows, 0 where none is stored. */
    std::vector<double>
    diagonal() const;

    /**
     * Of each local column the number that its rank has in @p own, one for
     * each of its rows. Collective.
     */
    std::vector<int>
    of_columns(const std::vector<int> &own) const;

    /** Entries of the distributed vector @p x at the columns; collective. */
    std::vector<double>
    of_columns(const Vector &x) const;

  private:
    void
    set_arrays();

    /** The copied rows; null if the rows are read where they are. */
    std::shared_ptr<const Epetra_CrsMatrix> copy_;
    const Epetra_CrsMatrix                 *matrix_;
    int                                    *starts_  = nullptr;
    int                                    *columns_ = nullptr;
    double                                 *values_  = nullptr;
  };

  /**
   * Give the square @p matrix rows of known columns; values are zero.
   * Trilinos' own insertion would copy and sort every row once more.
   * Collective.
   * @param owned this rank's rows, consecutive
   * @param ghosts ascending columns of other ranks; the first has the local
   *   number owned.n_elements()
   * @param starts of each row in the list of columns, and its length
   * @param write_columns writes the list of local columns, each row ascending
   */
  void
  make_sparse_rows(const MPI_Comm                              communicator,
                   const IndexSet                             &owned,
                   const std::vector<types::global_dof_index> &ghosts,
                   const std::vector<int>                     &starts,
                   const std::function<void(int *)>           &write_columns,
                   TrilinosWrappers::SparseMatrix             &matrix);
} // namespace Nacre

#endif
