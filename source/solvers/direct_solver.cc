// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Nacre authors

#include <nacre/solvers/direct_solver.h>
#include <nacre/solvers/elimination_order.h>
#include <nacre/solvers/sparse_rows.h>
#include <nacre/solvers/symmetric_factors.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

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
      const SparseRows A(matrix);
      const auto       x_columns = A.of_columns(x);
      const double     x_max     = x.linfty_norm();
      const double     small =
        1000. * matrix.m() * std::numeric_limits<double>::epsilon();
      double error = 0.;
      for (unsigned int i = 0; i < A.n_rows(); ++i)
        {
          const SparseRows::Row row = A[i];

          const double b_i     = b.begin()[i];
          double       r_i     = b_i;
          double       scale   = std::abs(b_i);
          double       row_sum = 0.;
          for (unsigned int k = 0; k < row.length; ++k)
            {
              const double product = row.values[k] * x_columns[row.columns[k]];
              r_i -= product;
              scale += std::abs(product);
              row_sum += std::abs(row.values[k]);
            }
          r.begin()[i] = r_i;
          if (scale <= small * (row_sum * x_max + std::abs(b_i)))
            scale += row_sum * x_max;
          if (r_i != 0.)
            error = std::max(error, std::abs(r_i) / scale);
        }
      return Utilities::MPI::max(error, matrix.get_mpi_communicator());
    }
  } // namespace


  void
  check_regular(const bool is_regular)
  {
    AssertThrow(is_regular,
                ExcMessage("The matrix is singular to working precision. "
                           "Either the shell, or a part of it, is free to "
                           "move, or its cells are too thin or too much "
                           "longer than wide."));
  }


  struct DirectSolver::Implementation
  {
    /** Ways to factors, from the quickest to the most robust one. */
    enum Method
    {
      cholesky,
      ldlt,
      pivoted_ldlt,
      none
    };

    explicit Implementation(const MPI_Comm communicator)
      : communicator(communicator)
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      , first_method(quickest_method())
    {}

    /** @return whether it is regular, or, if it has to be, definite. */
    bool
    factorize(const TrilinosMatrix &matrix, const bool definite_only);
    /** Discard analysis and factors if the nonzero entries have changed. */
    void
    take_pattern(const TrilinosMatrix &matrix);
    /** Have an analysis for @p new_method. */
    void
    analyse(const TrilinosMatrix &matrix, const Method new_method);
    /** @return whether the factors are accurate and regular. */
    bool
    are_factors_good(const TrilinosMatrix &matrix);

    /** MUMPS' factors of definite matrices are those without pivoting. */
    Method
    quickest_method() const
    {
      return n_ranks == 1 ? cholesky : ldlt;
    }

    const MPI_Comm        communicator;
    const unsigned int    n_ranks;
    const TrilinosMatrix *matrix        = nullptr;
    bool                  is_factorised = false;
    unsigned int          n_analyses    = 0;
    NonzeroEntries        pattern;
    /** Of each unknown in the order of pivots, on rank 0. */
    std::vector<int> place;
    bool             is_ordered = false;
    /**
     * The method that is tried first: that of the last matrix unless it failed.
     */
    Method                            first_method;
    Method                            method = none;
    std::unique_ptr<SymmetricFactors> factors;
  };


  void
  DirectSolver::Implementation::take_pattern(const TrilinosMatrix &new_matrix)
  {
    NonzeroEntries new_pattern(new_matrix);
    const int      differs = !is_ordered || !(new_pattern == pattern);
    if (Utilities::MPI::max(differs, communicator) == 0)
      return;
    factors.reset();
    method       = none;
    is_ordered   = false;
    first_method = quickest_method();
    pattern      = std::move(new_pattern);
    place        = elimination_order(new_matrix);
    is_ordered   = true;
  }


  void
  DirectSolver::Implementation::analyse(const TrilinosMatrix &new_matrix,
                                        const Method          new_method)
  {
    if (method == new_method)
      return;
    factors.reset(); // before the next ones need memory
    method  = none;
    factors = (new_method == cholesky) ?
                make_cholmod_factors() :
                make_mumps_factors(communicator, new_method == pivoted_ldlt);
    factors->analyse(new_matrix, pattern, place);
    ++n_analyses;
    method = new_method;
  }


  bool
  DirectSolver::Implementation::factorize(const TrilinosMatrix &new_matrix,
                                          const bool            definite_only)
  {
    AssertDimension(new_matrix.m(), new_matrix.n());
    is_factorised = false;
    matrix        = &new_matrix;
    take_pattern(new_matrix);
    // The quickest method takes all matrices that are definite.
    const int first = definite_only ? quickest_method() : first_method;
    const int end   = definite_only ? first + 1 : none;
    for (int m = first; m != end && !is_factorised; ++m)
      {
        analyse(new_matrix, static_cast<Method>(m));
        is_factorised = factors->factorize(new_matrix, pattern) &&
                        are_factors_good(new_matrix);
      }
    // After an indefinite matrix the next one is likely to be indefinite, too.
    if (is_factorised)
      first_method =
        factors->n_negative_pivots() == 0 ? quickest_method() : method;
    return is_factorised;
  }


  bool
  DirectSolver::Implementation::are_factors_good(const TrilinosMatrix &matrix)
  {
    // Round-off leaves no pivot exactly zero. Two steps of inverse iteration
    // give A^{-1} of (nearly) the eigenvector of the eigenvalue next to zero;
    // if that is zero but for round-off, the residual is as large as the
    // right-hand side, however A is scaled.
    TrilinosVector x(matrix.locally_owned_range_indices(), communicator);
    TrilinosVector b(x), r(x);
    for (const auto i : b.locally_owned_elements())
      b[i] = 0.5 + std::fmod(0.6180339887498949 * i, 1.);
    b.compress(VectorOperation::insert);
    for (unsigned int step = 0; step < 2; ++step)
      {
        factors->substitute(x, b);
        const double x_max = x.linfty_norm();
        if (step == 0 && std::isfinite(x_max) && x_max > 0.)
          b.equ(1. / x_max, x);
      }
    // Without pivoting the factors of an indefinite matrix may grow.
    const double error       = residual(r, matrix, x, b);
    const bool   is_accurate = error < 1e-10 || method == pivoted_ldlt;
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
    check_regular(try_factorize(matrix));
  }


  bool
  DirectSolver::try_factorize(const TrilinosWrappers::SparseMatrix &matrix,
                              const bool definite_only)
  {
    return implementation_->factorize(matrix, definite_only);
  }


  bool
  DirectSolver::try_prepare(const LinearSystem &system)
  {
    return try_factorize(system.matrix, system.definite_only);
  }


  void
  DirectSolver::substitute(TrilinosWrappers::MPI::Vector       &x,
                           const TrilinosWrappers::MPI::Vector &b) const
  {
    Assert(implementation_->is_factorised, ExcNotInitialized());
    implementation_->factors->substitute(x, b);
  }


  double
  DirectSolver::factor_memory(const TrilinosWrappers::SparseMatrix &matrix)
  {
    implementation_->take_pattern(matrix);
    if (implementation_->method == Implementation::none)
      implementation_->analyse(matrix, implementation_->first_method);
    return 1e-9 * implementation_->factors->memory();
  }


  unsigned int
  DirectSolver::n_analyses() const
  {
    return implementation_->n_analyses;
  }


  std::optional<unsigned int>
  DirectSolver::n_negative_pivots() const
  {
    Assert(implementation_->is_factorised, ExcNotInitialized());
    return implementation_->factors->n_negative_pivots();
  }


  void
  DirectSolver::substitute(TrilinosWrappers::MPI::Vector       &x,
                           const TrilinosWrappers::MPI::Vector &b)
  {
    Assert(implementation_->is_factorised, ExcNotInitialized());
    implementation_->factors->substitute(x, b);
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

    SymmetricFactors &factors = *implementation_->factors;
    factors.substitute(x, b);
    TrilinosVector r(b), dx(b), x_new(b);
    double         error = residual(r, matrix, x, b);
    SolveAccuracy  accuracy;
    for (unsigned int step = 0;
         step < 3 &&
         (step == 0 || error > 4. * std::numeric_limits<double>::epsilon());
         ++step)
      {
        factors.substitute(dx, r);
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
