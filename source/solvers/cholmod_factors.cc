// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/sparse_rows.h>
#include <nacre/solvers/symmetric_factors.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <limits>

namespace Nacre
{
  namespace
  {
    /** CHOLMOD's functions for one type of index. */
    template <typename Index>
    struct Cholmod;

    template <>
    struct Cholmod<int>
    {
      static constexpr auto start           = cholmod_start;
      static constexpr auto finish          = cholmod_finish;
      static constexpr auto allocate_sparse = cholmod_allocate_sparse;
      static constexpr auto free_sparse     = cholmod_free_sparse;
      static constexpr auto allocate_dense  = cholmod_allocate_dense;
      static constexpr auto free_dense      = cholmod_free_dense;
      static constexpr auto analyze_p       = cholmod_analyze_p;
      static constexpr auto free_factor     = cholmod_free_factor;
      static constexpr auto super_numeric   = cholmod_super_numeric;
      static constexpr auto super_lsolve    = cholmod_super_lsolve;
      static constexpr auto super_ltsolve   = cholmod_super_ltsolve;
    };

    template <>
    struct Cholmod<SuiteSparse_long>
    {
      static constexpr auto start           = cholmod_l_start;
      static constexpr auto finish          = cholmod_l_finish;
      static constexpr auto allocate_sparse = cholmod_l_allocate_sparse;
      static constexpr auto free_sparse     = cholmod_l_free_sparse;
      static constexpr auto allocate_dense  = cholmod_l_allocate_dense;
      static constexpr auto free_dense      = cholmod_l_free_dense;
      static constexpr auto analyze_p       = cholmod_l_analyze_p;
      static constexpr auto free_factor     = cholmod_l_free_factor;
      static constexpr auto super_numeric   = cholmod_l_super_numeric;
      static constexpr auto super_lsolve    = cholmod_l_super_lsolve;
      static constexpr auto super_ltsolve   = cholmod_l_super_ltsolve;
    };


    /**
     * Switches threads off while it lives. CHOLMOD starts four to copy blocks,
     * whatever OMP_NUM_THREADS says, and these cost more than they save.
     */
    class NoThreads
    {
    public:
      NoThreads()
        : max_active_levels_(omp_get_max_active_levels())
      {
        omp_set_max_active_levels(0);
      }

      ~NoThreads()
      {
        omp_set_max_active_levels(max_active_levels_);
      }

    private:
      const int max_active_levels_;
    };


    /** L L^T = P A P^T; @p Index is the type of CHOLMOD's indices. */
    template <typename Index>
    class CholmodFactors
    {
    public:
      using Matrix = SymmetricFactors::Matrix;

      CholmodFactors()
      {
        Library::start(&common_);
        common_.print                      = 0;
        common_.nmethods                   = 1;
        common_.method[0].ordering         = CHOLMOD_GIVEN;
        common_.supernodal                 = CHOLMOD_SUPERNODAL;
        common_.quick_return_if_not_posdef = 1;
      }

      CholmodFactors(const CholmodFactors &) = delete;
      CholmodFactors &
      operator=(const CholmodFactors &) = delete;

      ~CholmodFactors()
      {
        Library::free_dense(&work_, &common_);
        Library::free_dense(&x_, &common_);
        Library::free_factor(&factor_, &common_);
        Library::finish(&common_);
      }

      void
      analyse(const Matrix           &matrix,
              const NonzeroEntries   &pattern,
              const std::vector<int> &place);

      bool
      factorize(const Matrix &matrix, const NonzeroEntries &pattern);

      void
      substitute(double *x, const double *b);

      /** Bytes of the factors. */
      double
      memory() const
      {
        return 8. * factor_->xsize + 1. * sizeof(Index) * factor_->ssize;
      }

      /** CHOLMOD's status; negative ones are errors. */
      int
      status() const
      {
        return common_.status;
      }

    private:
      using Library = Cholmod<Index>;

      /** P A P^T's lower triangle by columns; null for lack of memory. */
      cholmod_sparse *
      permuted_matrix(const Matrix &matrix, const NonzeroEntries &pattern);

      cholmod_common  common_;
      cholmod_factor *factor_ = nullptr;
      /** A right-hand side in the factors' order, and CHOLMOD's workspace. */
      cholmod_dense *x_    = nullptr;
      cholmod_dense *work_ = nullptr;
    };


    template <typename Index>
    void
    CholmodFactors<Index>::analyse(const Matrix           &matrix,
                                   const NonzeroEntries   &pattern,
                                   const std::vector<int> &place)
    {
      const SparseRows  A(matrix);
      const std::size_t n       = matrix.m();
      cholmod_sparse   *entries = Library::allocate_sparse(n,
                                                         n,
                                                         pattern.n_upper(),
                                                         0,
                                                         1,
                                                         1,
                                                         CHOLMOD_PATTERN,
                                                         &common_);
      if (entries == nullptr)
        return;
      // Column i of the upper triangle is row i of the lower one.
      Index *const start = static_cast<Index *>(entries->p);
      Index *const rows  = static_cast<Index *>(entries->i);
      Index        k     = 0;
      for (std::size_t i = 0; i < n; ++i)
        {
          start[i]                  = k;
          const SparseRows::Row row = A[i];
          for (unsigned int l = 0; l < row.length; ++l)
            {
              const std::size_t j = A.global_column(row.columns[l]);
              if (j < i && pattern.contains(row.values[l]))
                rows[k++] = j;
            }
          rows[k++] = i;
        }
      start[n] = k;

      std::vector<Index> order(n);
      for (std::size_t i = 0; i < n; ++i)
        order[place[i]] = i;
      factor_ = Library::analyze_p(entries, order.data(), nullptr, 0, &common_);
      const int status = common_.status;
      Library::free_sparse(&entries, &common_);
      common_.status = status;
      if (status < 0)
        return;
      x_    = Library::allocate_dense(n, 1, n, CHOLMOD_REAL, &common_);
      work_ = Library::allocate_dense(factor_->maxesize,
                                      1,
                                      factor_->maxesize,
                                      CHOLMOD_REAL,
                                      &common_);
    }


    template <typename Index>
    cholmod_sparse *
    CholmodFactors<Index>::permuted_matrix(const Matrix         &matrix,
                                           const NonzeroEntries &pattern)
    {
      const SparseRows      A(matrix);
      const Index           n      = matrix.m();
      const Index *const    order  = static_cast<Index *>(factor_->Perm);
      cholmod_sparse *const result = Library::allocate_sparse(n,
                                                              n,
                                                              pattern.n_upper(),
                                                              0,
                                                              1,
                                                              -1,
                                                              CHOLMOD_REAL,
                                                              &common_);
      if (result == nullptr)
        return nullptr;

      std::vector<int> place(n), column_place(A.n_columns());
      for (Index k = 0; k < n; ++k)
        place[order[k]] = k;
      for (unsigned int j = 0; j < A.n_columns(); ++j)
        column_place[j] = place[A.global_column(j)];

      Index *const  start   = static_cast<Index *>(result->p);
      Index *const  rows    = static_cast<Index *>(result->i);
      double *const entries = static_cast<double *>(result->x);
      Index         end     = 0;
      for (Index k = 0; k < n; ++k)
        {
          start[k]                     = end;
          const SparseRows::Row stored = A[order[k]];
          // The diagonal first, stored or not.
          double &diagonal = entries[end];
          diagonal         = 0.;
          rows[end++]      = k;
          for (unsigned int l = 0; l < stored.length; ++l)
            {
              const int row = column_place[stored.columns[l]];
              if (row > k && pattern.contains(stored.values[l]))
                {
                  rows[end]      = row;
                  entries[end++] = stored.values[l];
                }
              else if (row == k)
                diagonal = stored.values[l];
            }
        }
      start[n] = end;
      return result;
    }


    template <typename Index>
    bool
    CholmodFactors<Index>::factorize(const Matrix         &matrix,
                                     const NonzeroEntries &pattern)
    {
      const NoThreads no_threads;
      cholmod_sparse *permuted = permuted_matrix(matrix, pattern);
      if (permuted == nullptr)
        return false;
      double shift[2] = {0., 0.};
      Library::super_numeric(permuted, nullptr, shift, factor_, &common_);
      const int status = common_.status;
      Library::free_sparse(&permuted, &common_);
      common_.status = status;
      return status == CHOLMOD_OK;
    }


    template <typename Index>
    void
    CholmodFactors<Index>::substitute(double *x, const double *b)
    {
      const NoThreads    no_threads;
      const Index *const order    = static_cast<Index *>(factor_->Perm);
      double *const      permuted = static_cast<double *>(x_->x);
      for (std::size_t k = 0; k < factor_->n; ++k)
        permuted[k] = b[order[k]];
      const bool is_solved =
        Library::super_lsolve(factor_, x_, work_, &common_) &&
        Library::super_ltsolve(factor_, x_, work_, &common_);
      AssertThrow(is_solved,
                  ExcMessage("The direct solver failed (CHOLMOD: status " +
                             std::to_string(common_.status) + ")."));
      for (std::size_t k = 0; k < factor_->n; ++k)
        x[order[k]] = permuted[k];
    }


    /**
     * The factors with int as index, or with long if there are too many
     * entries.
     */
    class Cholesky : public SymmetricFactors
    {
    public:
      void
      analyse(const Matrix           &matrix,
              const NonzeroEntries   &pattern,
              const std::vector<int> &place) override
      {
        n_ = matrix.m();
        long_.reset();
        short_     = std::make_unique<CholmodFactors<int>>();
        int status = CHOLMOD_TOO_LARGE;
        if (pattern.n_upper() < std::numeric_limits<int>::max())
          {
            short_->analyse(matrix, pattern, place);
            status = short_->status();
          }
        if (status == CHOLMOD_TOO_LARGE)
          {
            short_.reset();
            long_ = std::make_unique<CholmodFactors<SuiteSparse_long>>();
            long_->analyse(matrix, pattern, place);
            status = long_->status();
          }
        check_status(status);
      }

      bool
      factorize(const Matrix &matrix, const NonzeroEntries &pattern) override
      {
        const bool is_done = short_ ? short_->factorize(matrix, pattern) :
                                      long_->factorize(matrix, pattern);
        check_status(short_ ? short_->status() : long_->status());
        return is_done;
      }

      void
      substitute(Vector &x, const Vector &b) override
      {
        short_ ? short_->substitute(x.begin(), b.begin()) :
                 long_->substitute(x.begin(), b.begin());
      }

      unsigned int
      n_negative_pivots() const override
      {
        return 0;
      }

      double
      memory() const override
      {
        return short_ ? short_->memory() : long_->memory();
      }

    private:
      void
      check_status(const int status) const
      {
        if (status >= 0)
          return;
        const std::string number =
          " (CHOLMOD: status " + std::to_string(status) + ").";
        if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE)
          throw_lack_of_memory(n_, number);
        AssertThrow(false, ExcMessage("The direct solver failed" + number));
      }

      std::size_t                                       n_ = 0;
      std::unique_ptr<CholmodFactors<int>>              short_;
      std::unique_ptr<CholmodFactors<SuiteSparse_long>> long_;
    };
  } // namespace


  std::unique_ptr<SymmetricFactors>
  make_cholmod_factors()
  {
    return std::make_unique<Cholesky>();
  }
} // namespace Nacre
