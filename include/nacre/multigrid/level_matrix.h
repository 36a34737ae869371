// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#ifndef nacre_multigrid_level_matrix_h
#define nacre_multigrid_level_matrix_h

#include <nacre/base/types.h>
#include <nacre/solvers/row_patterns.h>

#include <deal.II/base/index_set.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace Nacre
{
  /**
   * Rows of a distributed matrix for smoothers: the own rows, read where they
   * are, and copies of some rows of other ranks.
   *
   * A product gathers the entries of the vector once for all rows of the same
   * pattern, and the rest are dense dot products.
   *
   * Local indices are those of vectors of partitioner(): own entries first,
   * then the ghosts, which are all columns of all rows kept.
   */
  class LevelMatrix
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    /**
     * Read @p matrix, which must stay alive and unchanged unless copy_values()
     * follows. Collective.
     * @param further_rows rows of other ranks to copy
     */
    void
    reinit(const TrilinosWrappers::SparseMatrix &matrix,
           const IndexSet                       &further_rows);

    /**
     * Copy the values, so that the matrix may be destroyed. This saves its
     * column numbers, a third of its memory.
     */
    void
    copy_values();

    const std::shared_ptr<const Utilities::MPI::Partitioner> &
    partitioner() const
    {
      return partitioner_;
    }

    unsigned int
    n_owned() const
    {
      return n_owned_;
    }

    /** Number of local indices. */
    unsigned int
    n_local() const
    {
      return rows_.size();
    }

    /** Rows of the same pattern have the same columns. */
    unsigned int
    pattern(const unsigned int i) const
    {
      return rows_[i].pattern;
    }

    /** Number of entries of the row with local index @p i, 0 if not kept. */
    unsigned int
    row_length(const unsigned int i) const
    {
      return patterns_.length(rows_[i].pattern);
    }

    const double *
    row_values(const unsigned int i) const
    {
      return rows_[i].values;
    }

    /** Write the local columns of the row @p i to @p columns. */
    void
    get_columns(const unsigned int i, std::vector<unsigned int> &columns) const;

    /** Whether all columns of the row @p i are this rank's. */
    bool
    is_interior(const unsigned int i) const;

    double
    diagonal(const unsigned int i) const
    {
      return diagonal_[i];
    }

    /**
     * products[k] = (A x)_{i_k} for the @p n rows @p i, which should be sorted;
     * @p x are the local entries of a vector.
     */
    void
    multiply_rows(const unsigned int  n,
                  const unsigned int *i,
                  const double       *x,
                  double             *products) const;

    /** r = b - A x for the own rows; the ghosts of @p x must be up to date. */
    void
    residual(Vector &r, const Vector &x, const Vector &b) const;

    /**
     * The same, and the componentwise backward error
     * max_i |r|_i / (|A||x| + |b|)_i; rows whose denominator is round-off add
     * |A_i|_1 |x|_max (Arioli, Demmel, Duff: SIAM J. Matrix Anal. Appl. 10
     * (1989) 165-190, section 3). Collective.
     */
    double
    residual_and_error(Vector &r, const Vector &x, const Vector &b) const;

  private:
    struct Row
    {
      const double *values  = nullptr;
      unsigned int  pattern = RowPatterns::empty;
    };

    /** Keep the rows of @p matrix, too. */
    void
    add_rows(const SparseRows &matrix);

    /** Set gathered_ for the rows of a pattern. */
    void
    gather(const unsigned int pattern, const double *x) const;

    std::optional<SparseRows>                          further_rows_;
    std::shared_ptr<const Utilities::MPI::Partitioner> partitioner_;

    unsigned int        n_owned_ = 0;
    std::vector<Row>    rows_;
    RowPatterns         patterns_;
    std::vector<double> values_; // if copied
    std::vector<double> diagonal_;
    /** The entries of a vector at the columns of a row. */
    mutable AlignedVector<double> gathered_;
  };
} // namespace Nacre

#endif
