// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/sparse_rows.h>

#include <deal.II/lac/trilinos_index_access.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace Nacre
{
  namespace
  {
    using Int = TrilinosWrappers::types::int_type;

    void
    check(const int error)
    {
      AssertThrow(error >= 0, ExcTrilinosError(error));
    }

    /** The map of rows or columns with the global numbers @p ids. */
    Epetra_Map
    make_map(const std::vector<Int> &ids, const Epetra_Comm &communicator)
    {
      return Epetra_Map(static_cast<Int>(-1),
                        static_cast<int>(ids.size()),
                        ids.data(),
                        0,
                        communicator);
    }

    std::shared_ptr<const Epetra_CrsMatrix>
    copy_rows(const Epetra_CrsMatrix &matrix, const IndexSet &indices)
    {
      const auto map =
        make_map({indices.begin(), indices.end()}, matrix.Comm());
      auto rows = std::make_shared<Epetra_CrsMatrix>(Copy, map, 0);
      check(rows->Import(matrix, Epetra_Import(map, matrix.RowMap()), Insert));
      check(rows->FillComplete(matrix.DomainMap(), matrix.RangeMap()));
      return rows;
    }

    /** The entries of @p own at the columns of @p matrix. */
    template <typename EpetraVector>
    EpetraVector
    import_columns(const Epetra_CrsMatrix &matrix, const EpetraVector &own)
    {
      EpetraVector result(matrix.ColMap());
      if (matrix.Importer() != nullptr)
        check(result.Import(own, *matrix.Importer(), Insert));
      else
        std::copy(own.Values(), own.Values() + own.MyLength(), result.Values());
      return result;
    }

    /**
     * Tell the @p graph, which shares its data with its copies, that its rows
     * ascend, or Trilinos would sort them again.
     */
    void
    mark_sorted(const Epetra_CrsGraph &graph)
    {
      struct SortedGraph : public Epetra_CrsGraph
      {
        explicit SortedGraph(const Epetra_CrsGraph &other)
          : Epetra_CrsGraph(other)
        {
          SetSorted(true);
        }
      };
      const SortedGraph sorted(graph);
    }
  } // namespace

  SparseRows::SparseRows(const Matrix &matrix)
    : matrix_(&matrix.trilinos_matrix())
  {
    set_arrays();
  }

  SparseRows::SparseRows(const Matrix &matrix, const IndexSet &rows)
    : copy_(copy_rows(matrix.trilinos_matrix(), rows))
    , matrix_(copy_.get())
  {
    set_arrays();
  }

  void
  SparseRows::set_arrays()
  {
    check(matrix_->ExtractCrsDataPointers(starts_, columns_, values_));
  }

  unsigned int
  SparseRows::n_rows() const
  {
    return matrix_->NumMyRows();
  }

  unsigned int
  SparseRows::n_columns() const
  {
    return matrix_->NumMyCols();
  }

  SparseRows::Dof
  SparseRows::global_row(const unsigned int i) const
  {
    return TrilinosWrappers::global_index(matrix_->RowMap(), i);
  }

  SparseRows::Dof
  SparseRows::global_column(const unsigned int j) const
  {
    return TrilinosWrappers::global_index(matrix_->ColMap(), j);
  }

  int
  SparseRows::local_column(const Dof column) const
  {
    return matrix_->ColMap().LID(static_cast<Int>(column));
  }

  std::vector<double>
  SparseRows::diagonal() const
  {
    std::vector<double> result(n_rows(), 0.);
    for (unsigned int i = 0; i < n_rows(); ++i)
      {
        const Row row  = (*this)[i];
        const int mine = local_column(global_row(i));
        for (unsigned int k = 0; k < row.length; ++k)
          if (row.columns[k] == mine)
            result[i] = row.values[k];
      }
    return result;
  }

  std::vector<int>
  SparseRows::of_columns(const std::vector<int> &own) const
  {
    AssertDimension(own.size(), n_rows());
    const Epetra_IntVector rows(Copy,
                                matrix_->RowMap(),
                                const_cast<int *>(own.data()));
    const auto             columns = import_columns(*matrix_, rows);
    return {columns.Values(), columns.Values() + columns.MyLength()};
  }

  std::vector<double>
  SparseRows::of_columns(const Vector &x) const
  {
    AssertDimension(x.locally_owned_size(), n_rows());
    const Epetra_Vector &rows    = *x.trilinos_vector()(0);
    const auto           columns = import_columns(*matrix_, rows);
    return {columns.Values(), columns.Values() + columns.MyLength()};
  }

  void
  make_sparse_rows(const MPI_Comm                              communicator,
                   const IndexSet                             &owned,
                   const std::vector<types::global_dof_index> &ghosts,
                   const std::vector<int>                     &starts,
                   const std::function<void(int *)>           &write_columns,
                   TrilinosWrappers::SparseMatrix             &matrix)
  {
    AssertDimension(starts.size(), owned.n_elements() + 1);
    const Epetra_Map row_map = owned.make_trilinos_map(communicator, false);
    std::vector<Int> column_ids(owned.begin(), owned.end());
    column_ids.insert(column_ids.end(), ghosts.begin(), ghosts.end());
    const Epetra_Map column_map = make_map(column_ids, row_map.Comm());

    // The values are never touched.
    Epetra_CrsMatrix rows(Copy, row_map, column_map, 0, true);
    auto            &indices = rows.ExpertExtractIndices();
    indices.Resize(starts.back());
    write_columns(indices.Values());
    auto &offsets = rows.ExpertExtractIndexOffset();
    offsets.Resize(starts.size());
    std::copy(starts.begin(), starts.end(), offsets.Values());
    rows.ExpertExtractValues() = new double[starts.back()];
    check(rows.ExpertStaticFillComplete(row_map, row_map));
    mark_sorted(rows.Graph());
    matrix.reinit(rows, false);
  }
} // namespace Nacre
